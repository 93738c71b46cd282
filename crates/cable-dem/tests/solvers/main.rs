//! Every solver on every test model, through one harness; the laws of nature that all of them must keep; and what each of them is known for.
//!
//! [`models`] holds problems with their exact answers, [`harness`] runs any solver on any problem.

mod agreement;
mod explicit;
mod faults;
mod friction_symmetry;
mod harness;
mod inertia;
mod models;
mod nasty_values;
mod random_scenes;
mod restart;
#[path = "../shared/mod.rs"]
mod shared;
mod sigmoid;
mod slope;
mod stiff_ends;
mod test_models;
mod work;
