//! The energy of one pass, and what it must satisfy.

use crate::CableError;
use crate::tuning::{MAX_RETURNED, MAX_UNBALANCED};

/// Share of the work that friction could do at its limit below which the energies of a cable that hardly slips count as
/// nothing.
const NEGLIGIBLE: f64 = 0.05;

/// Energies of one pass \[J\]: changes from its start to its end, before the cable is brought to rest.
///
/// The duct does work on the cable through friction; what comes in goes into the cable's elastic and kinetic energy, into
/// the elastic shear of the contact, and into heat:
///
/// Σ w f ΔD + Σ w p Δu = Δ(½ uᵀK u) + Δ(½ vᵀM v) + Δ(½ γ Σ w f²) + Σ w f Δs,
///
/// with p the body force and Δs the slip beyond the elastic shear (all slip for the sigmoid, which stores nothing). Two laws of physics make two
/// checks that know nothing of any step limit:
///
/// - the *first law*: both sides agree, up to what the scheme itself adds or takes;
/// - the *second law*: at every node and step the heat is positive. A step too long for the friction makes nodes swing
///   from +q to −q and back, finite for ever, and friction then returns as much work as it takes: the share of heat that is
///   negative goes to one half, where a sound pass has less than a millionth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct EnergyBalance {
    /// Work of the duct on the cable through friction.
    pub duct_work: f64,
    /// Work of the force along the duct on every metre of cable: what its weight loses in height.
    pub body_work: f64,
    /// Change of the elastic energy of cable, end springs, clamps and the contact's shear.
    pub elastic: f64,
    /// Kinetic energy at the end of the pass.
    pub kinetic: f64,
    /// Heat of friction, with what it returned taken off.
    pub dissipated: f64,
    /// Heat that came out negative: work that friction returned against the second law.
    pub returned: f64,
    /// Largest kinetic energy met during the pass.
    pub peak_kinetic: f64,
    /// Elastic energy at the start of the pass.
    pub initial: f64,
    /// Work q·max|D|·L that friction at its limit would do over the duct's largest displacement: the scale below which
    /// heat is only rounding.
    pub reference: f64,
}

impl EnergyBalance {
    /// Work of the duct that is not found again \[J\]; negative where the scheme creates energy.
    pub fn residual(&self) -> f64 {
        self.duct_work + self.body_work - self.elastic - self.kinetic - self.dissipated
    }

    /// [`Self::residual`] as a share of all energy that took part.
    pub fn unbalanced_share(&self) -> f64 {
        let scale = self.initial
            + self.duct_work.abs()
            + self.body_work.abs()
            + self.elastic.abs()
            + self.peak_kinetic.max(self.kinetic)
            + self.gross_heat();
        share(self.residual().abs(), scale.max(NEGLIGIBLE * self.reference))
    }

    /// Negative heat as a share of its gross amount (or of [`Self::reference`], if greater): 0 for a sound pass, near ½
    /// for chatter.
    pub fn returned_share(&self) -> f64 {
        share(self.returned, self.gross_heat().max(self.reference))
    }

    fn gross_heat(&self) -> f64 {
        self.dissipated + 2.0 * self.returned
    }

    /// Both laws, for a scheme that neither adds nor takes energy.
    pub(crate) fn check(&self) -> Result<(), CableError> {
        let (unbalanced, returned) = (self.unbalanced_share(), self.returned_share());
        // Written so that NaN fails.
        if unbalanced <= MAX_UNBALANCED && returned <= MAX_RETURNED {
            Ok(())
        } else {
            Err(CableError::EnergyNotConserved { unbalanced, returned })
        }
    }
}

/// part/whole; 0 of nothing is nothing.
fn share(part: f64, whole: f64) -> f64 {
    if part == 0.0 { 0.0 } else { part / whole }
}
