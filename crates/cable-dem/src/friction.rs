//! Friction between cable and duct, per metre of cable.

use crate::CableError;
use crate::error::{not_negative, positive};

/// How friction follows slip.
///
/// The slip Δs = ΔD − Δu of the duct past the cable over a step changes the friction f \[N/m\] on the cable, positive
/// toward growing x; |f| never exceeds the limit q = μ_d N′. Every law is monotone in Δs, so that an implicit step minimises
/// a convex energy.
///
/// | law | f after the step | source |
/// |---|---|---|
/// | Coulomb | ±q while slipping, anything between while stuck | Popov, Contact Mechanics and Friction, 2010, §10.2 |
/// | elastic-plastic | clamp(f + (q b/2) Δs, −q, q) | the sheath shears, then slips: Kashiro et al., Figure 10 |
/// | sigmoid | q (1 − e^(−bΔs))/(1 + e^(−bΔs)) = q tanh(bΔs/2) | Kashiro et al., Equation (2) |
///
/// The shape factor b \[1/m\] is Kashiro et al.'s: both of the latter start with the slope q b/2, and Coulomb's law is
/// the limit b → ∞. The sigmoid has no memory: Δs is the slip within one step of time, so that at rest it is a dashpot
/// with reference speed 2/(bΔt), stored force leaks away, and the answer depends on Δt ([`crate::SigmoidLeak`]).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum FrictionLaw {
    /// Rigid until it slips.
    Coulomb,
    /// Linear elastic with slope q b/2 until it slips, with memory.
    ElasticPlastic {
        /// b \[1/m\].
        shape_factor: f64,
    },
    /// A smooth function of the slip within one time step, without memory.
    Sigmoid {
        /// b \[1/m\].
        shape_factor: f64,
    },
}

impl FrictionLaw {
    /// The law's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Coulomb => "coulomb",
            Self::ElasticPlastic { .. } => "elastic-plastic",
            Self::Sigmoid { .. } => "sigmoid",
        }
    }

    /// Shape factor b \[1/m\]; infinite for Coulomb's law.
    pub fn shape_factor(self) -> f64 {
        match self {
            Self::Coulomb => f64::INFINITY,
            Self::ElasticPlastic { shape_factor } | Self::Sigmoid { shape_factor } => shape_factor,
        }
    }

    /// Whether friction remembers earlier slip, so that stored force stays.
    pub fn has_memory(self) -> bool {
        !matches!(self, Self::Sigmoid { .. })
    }
}

/// A friction law with its limit q = μ_d N′ per metre of cable; [`FrictionLaw`] has the equations.
///
/// ```
/// use cable_dem::{Friction, FrictionLaw};
///
/// // μ_d = 0.25 under 108.8 N/m; the sheath shears by q/1e8 N/m² before it slips.
/// let q = 0.25 * 108.8;
/// let friction = Friction::new(FrictionLaw::ElasticPlastic { shape_factor: 2e8 / q }, q)?;
/// assert!((friction.after_slip(0.0, 1e-7) - 10.0).abs() < 1e-9);
/// assert_eq!(friction.after_slip(0.0, 1e-3), q);
/// # Ok::<(), cable_dem::CableError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    law: FrictionLaw,
    limit: f64,
}

impl Friction {
    /// `law` with the largest friction `limit_per_metre` q = μ_d N′ \[N/m\]; 0 is a frictionless duct.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the limit is finite and not negative, the shape factor finite and positive.
    pub fn new(law: FrictionLaw, limit_per_metre: f64) -> Result<Self, CableError> {
        let limit = not_negative("friction limit", limit_per_metre)?;
        if law != FrictionLaw::Coulomb {
            let shape_factor = law.shape_factor();
            positive("shape_factor", shape_factor)?;
        }
        Ok(Self { law, limit })
    }

    /// The law.
    pub fn law(self) -> FrictionLaw {
        self.law
    }

    /// q, the largest friction \[N/m\].
    pub fn limit(self) -> f64 {
        self.limit
    }

    /// Refuses a law without memory for a `solver` whose steps begin and end at rest.
    pub(crate) fn check_memory(self, solver: &'static str) -> Result<(), CableError> {
        if self.law.has_memory() {
            return Ok(());
        }
        let law = self.law.name();
        Err(CableError::NoRest { solver, law })
    }

    /// The same with memory: the sigmoid becomes the elastic-plastic law with its slope and limit.
    pub(crate) fn with_memory(self) -> Self {
        let law = match self.law {
            FrictionLaw::Sigmoid { shape_factor } => FrictionLaw::ElasticPlastic { shape_factor },
            law => law,
        };
        Self { law, ..self }
    }

    /// Shear compliance γ = 2/(q b) \[m²/N\] of the stuck contact: slip per friction. 0 for Coulomb's law, infinite
    /// without friction.
    pub fn compliance(self) -> f64 {
        if self.limit == 0.0 {
            return f64::INFINITY;
        }
        2.0 / (self.limit * self.law.shape_factor())
    }

    /// Friction after the duct has slipped by `slip` \[m\] past the cable, from `friction` \[N/m\] before.
    ///
    /// Coulomb's law leaves friction undetermined while stuck; without slip it stays as it was.
    pub fn after_slip(self, friction: f64, slip: f64) -> f64 {
        self.after_slip_within(friction, slip, self.limit)
    }

    /// The same where another `limit` \[N/m\] holds: the slope q b/2 stays.
    pub(crate) fn after_slip_within(self, friction: f64, slip: f64, limit: f64) -> f64 {
        match self.law {
            FrictionLaw::Coulomb if slip == 0.0 => friction.clamp(-limit, limit),
            FrictionLaw::Coulomb => limit.copysign(slip),
            FrictionLaw::ElasticPlastic { shape_factor } => {
                // Unlike `clamp` this does not panic where the limit is no number.
                (friction + 0.5 * self.limit * shape_factor * slip)
                    .max(-limit)
                    .min(limit)
            }
            FrictionLaw::Sigmoid { shape_factor } => {
                let steepness = if limit == self.limit {
                    1.0
                } else {
                    self.limit / limit
                };
                limit * (0.5 * shape_factor * steepness * slip).tanh()
            }
        }
    }
}
