//! Friction between cable and duct, per metre of cable.
//!
//! The slip Δs = ΔD − Δu of the duct past the cable over a step changes the friction f \[N/m\] on the cable, positive
//! toward growing x; |f| never exceeds the limit q = μ_d N′. Every law is monotone in Δs, so that an implicit step minimises
//! a convex energy.
//!
//! | law | f after the step | source |
//! |---|---|---|
//! | Coulomb | ±q while slipping, anything between while stuck | Popov, Contact Mechanics and Friction, 2010, §10.2 |
//! | elastic-plastic | clamp(f + (q b/2) Δs, −q, q) | the sheath shears, then slips: Kashiro et al., Figure 10 |
//!
//! The shape factor b \[1/m\] is Kashiro et al.'s (Equation (2)): both this law and their sigmoid
//! q (1 − e^(−bΔs))/(1 + e^(−bΔs)) start with the slope q b/2. Coulomb's law is the limit b → ∞.

use crate::CableError;
use crate::error::checked;

/// How friction follows slip.
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
}

impl FrictionLaw {
    /// The law's name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Coulomb => "coulomb",
            Self::ElasticPlastic { .. } => "elastic-plastic",
        }
    }
}

/// A friction law with its limit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Friction {
    law: FrictionLaw,
    limit: f64,
}

impl Friction {
    /// `law` with the largest friction `limit` q = μ_d N′ \[N/m\]; 0 is a frictionless duct.
    ///
    /// # Errors
    ///
    /// [`CableError::InvalidParameter`] unless the limit is finite and not negative, the shape factor finite and positive.
    pub fn new(law: FrictionLaw, limit: f64) -> Result<Self, CableError> {
        checked("friction limit", limit, "finite and not negative", |v| v >= 0.0)?;
        if let FrictionLaw::ElasticPlastic { shape_factor } = law {
            checked("shape_factor", shape_factor, "finite and positive", |v| v > 0.0)?;
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

    /// Shear compliance γ = 2/(q b) \[m²/N\] of the stuck contact: slip per friction. 0 for Coulomb's law.
    pub fn compliance(self) -> f64 {
        match self.law {
            FrictionLaw::Coulomb => 0.0,
            FrictionLaw::ElasticPlastic { shape_factor } => 2.0 / (self.limit * shape_factor),
        }
    }

    /// Friction after the duct has slipped by `slip` \[m\] past the cable, from `friction` \[N/m\] before.
    ///
    /// Coulomb's law leaves friction undetermined while stuck; without slip it stays as it was.
    pub fn after_slip(self, friction: f64, slip: f64) -> f64 {
        let q = self.limit;
        match self.law {
            FrictionLaw::Coulomb if slip == 0.0 => friction.clamp(-q, q),
            FrictionLaw::Coulomb => q.copysign(slip),
            FrictionLaw::ElasticPlastic { shape_factor } => {
                (friction + 0.5 * q * shape_factor * slip).clamp(-q, q)
            }
        }
    }
}
