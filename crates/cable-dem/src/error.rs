//! What can go wrong in the cable.

use friction_chain::ChainError;

/// Error of a cable model or of a solver.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CableError {
    /// A parameter is outside its range, or not a number.
    #[error("{name} = {value:?}: must be {allowed}")]
    InvalidParameter {
        /// The parameter's name.
        name: &'static str,
        /// What was given.
        value: f64,
        /// The allowed range, in words.
        allowed: &'static str,
    },
    /// The solver's steps begin and end at rest, which this friction law does not have.
    #[error(
        "the {solver} solver does not handle the {law} law: its friction depends on the time step and fades at rest"
    )]
    NoRest {
        /// The solver.
        solver: &'static str,
        /// The friction law.
        law: &'static str,
    },
    /// A step did not reach equilibrium within the friction bounds; no state is returned in its place.
    #[error(
        "no equilibrium {}: {violation:.1e} of the friction limit remains unbalanced",
        vehicle(*.vehicle_position)
    )]
    NoConvergence {
        /// Position of the vehicle's origin along the duct \[m\]; infinite if none is near.
        vehicle_position: f64,
        /// Largest violation of equilibrium or of the friction law, as a share of the friction limit.
        violation: f64,
    },
    /// The cable makes no chain of nodes.
    #[error(transparent)]
    Chain(#[from] ChainError),
    /// Nothing holds a cable that its own weight draws down the duct.
    #[error(
        "the cable slides out of its duct: {body_force:?} N/m along it is no less than the friction of {limit:?} N/m, and no end and no clamp holds it",
        body_force = short(*body_force),
        limit = short(*limit)
    )]
    NothingHolds {
        /// Force along the duct \[N/m\].
        body_force: f64,
        /// Friction limit \[N/m\].
        limit: f64,
    },
    /// Solvers with inertia do not follow heat.
    #[error("the cable is not as warm as it was laid: solvers with inertia do not follow that")]
    Heated,
    /// Rounding is too large relative to the friction limit for the answer to mean anything.
    #[error(
        "rounding of the elastic forces reaches {share:.1e} of the friction limit: axial stiffness {axial_stiffness:?} N at a node spacing of {spacing:?} m is too stiff for this friction",
        spacing = short(*spacing)
    )]
    Precision {
        /// Rounding error as a share of the friction limit.
        share: f64,
        /// EA \[N\].
        axial_stiffness: f64,
        /// Node spacing \[m\].
        spacing: f64,
    },
    /// The motion of the duct is not known as far as the passing vehicle needs it.
    #[error(
        "the motion of the duct reaches {reach:?} m from the vehicle, and the duct with its approach is {needed:?} m long: sample the \
         motion that far",
        reach = short(*reach),
        needed = short(*needed)
    )]
    OutOfReach {
        /// Length of the duct and approach \[m\].
        needed: f64,
        /// How far the motion is known \[m\].
        reach: f64,
    },
    /// The mesh is too coarse for the motion of the duct.
    #[error(
        "elements or steps of {longest:?} m leave out {:.0} % of the duct's peak displacement: take at least two, better six nodes a \
         depth of the duct",
        100.0 * .left_out,
        longest = short(*longest)
    )]
    CoarseMesh {
        /// The longer one of node spacing and vehicle step \[m\].
        longest: f64,
        /// Share of the peak.
        left_out: f64,
    },
    /// The passage was computed for another cable or mesh.
    #[error("the passage was computed for another mesh, axial stiffness or friction than the solver's")]
    PassageMismatch,
    /// The state belongs to another mesh.
    #[error("the state has {found} nodes where the mesh has {expected}")]
    StateMismatch {
        /// Nodes of the state.
        found: usize,
        /// Nodes of the mesh.
        expected: usize,
    },
    /// A time step beyond the explicit scheme's limit.
    #[error(
        "a time step of {time_step:.3e} s is beyond the explicit scheme's limit of {:.3e} s ({:.3e} s for the springs \
         and {:.3e} s for friction)",
        .longest[0],
        .longest[1],
        .longest[2]
    )]
    UnstableStep {
        /// The step asked for \[s\].
        time_step: f64,
        /// The longest stable step \[s\], and those of springs alone and of friction alone.
        longest: [f64; 3],
    },
    /// A pass would take more work than allowed.
    #[error(
        "a pass in steps of {time_step:.2e} s takes {node_updates:.2e} node updates; {allowed:.2e} are allowed"
    )]
    TooManySteps {
        /// Duration of a step \[s\].
        time_step: f64,
        /// Steps times nodes.
        node_updates: f64,
        /// Largest number of node updates allowed.
        allowed: f64,
    },
    /// The energy of a pass does not balance: the answer comes from the scheme, not from the cable.
    #[error(
        "energy is not conserved: {unbalanced:.1e} of it is unaccounted for, and friction returned {returned:.1e} of its heat: the time step is too long"
    )]
    EnergyNotConserved {
        /// Energy out of balance, as a share of all that took part.
        unbalanced: f64,
        /// Work that friction returned, as a share of its heat.
        returned: f64,
    },
}

impl CableError {
    /// That of a step with the vehicle at `vehicle_position` \[m\], infinite if none is near.
    pub(crate) fn of_step(error: ChainError, vehicle_position: f64) -> Self {
        match error {
            ChainError::NoEquilibrium { violation } => Self::NoConvergence {
                vehicle_position,
                violation,
            },
            error => Self::Chain(error),
        }
    }
}

/// Where the vehicle is, in words.
fn vehicle(position: f64) -> String {
    if position.is_finite() {
        format!("with the vehicle at {} m", short(position))
    } else {
        "of the cable at rest".into()
    }
}

/// `value` if it is finite and positive.
pub(crate) fn positive(name: &'static str, value: f64) -> Result<f64, CableError> {
    checked(name, value, "finite and positive", |v| v > 0.0)
}

/// `value` if it is finite and not negative.
pub(crate) fn not_negative(name: &'static str, value: f64) -> Result<f64, CableError> {
    checked(name, value, "finite and not negative", |v| v >= 0.0)
}

/// `value` if it is a number for which `holds`, or the error that says what is allowed.
pub(crate) fn checked(
    name: &'static str,
    value: f64,
    allowed: &'static str,
    holds: impl Fn(f64) -> bool,
) -> Result<f64, CableError> {
    if value.is_finite() && holds(value) {
        Ok(value)
    } else {
        Err(CableError::InvalidParameter { name, value, allowed })
    }
}

/// A number to four digits: no message needs more.
fn short(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
