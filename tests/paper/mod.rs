//! The paper's numbers: K. Kashiro et al., "Development of an Analysis Method for Power Cable Creepage Phenomenon in the
//! Duct", Furukawa Review. One file a section of it; what is asserted is what the examples compute, print and draw.
//!
//! Table 1's ground by every model is in tests/ground_models/table_1.rs, Table 3's grounds in table_3.rs beside it.

#![allow(
    clippy::duplicate_mod,
    reason = "every example brings the same module `common`"
)]

mod force;
mod ground;
mod tendencies;

/// An example, as a module: its `main` stays its own.
macro_rules! example {
    ($name:ident, $path:literal) => {
        #[allow(dead_code, reason = "main and what it prints are the example's own")]
        #[path = $path]
        mod $name;
    };
}

example!(figures_2_to_4, "../../examples/figures_2_to_4.rs");
example!(figure_6, "../../examples/figure_6.rs");
example!(figure_7, "../../examples/figure_7.rs");
example!(figure_12, "../../examples/figure_12.rs");
example!(figure_13, "../../examples/figure_13.rs");
example!(figure_14, "../../examples/figure_14.rs");
example!(load_and_deflection, "../../examples/load_and_deflection.rs");
