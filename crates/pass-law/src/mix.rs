//! Mixed traffic: several vehicles, each with its share of the passes, in both directions.
//!
//! Where friction varies slowly from pass to pass, the order of the vehicles does not matter and their advances add up,
//! G(f̄) = Σ share_v · G_v(f̄). Opposing traffic advances by −G(−f̄); equal shares of both cancel at f̄ = 0.

use crate::AdvanceLaw;
use crate::LawError;
use crate::error::checked;

/// Advance per pass of mixed traffic.
#[derive(Debug, Clone, PartialEq)]
pub struct MixedLaw {
    parts: Vec<(f64, AdvanceLaw)>,
    saturation: f64,
}

impl MixedLaw {
    /// Vehicles with their shares of the passes: any positive weights. All laws must be those of the same cable.
    ///
    /// # Errors
    ///
    /// [`LawError::InvalidParameter`] unless there is a vehicle, all shares are positive and all laws share one
    /// friction limit.
    pub fn new(parts: Vec<(f64, AdvanceLaw)>) -> Result<Self, LawError> {
        checked("vehicles", parts.len() as f64, "at least one", |v| v > 0.0)?;
        let limit = parts[0].1.friction_limit();
        for (share, law) in &parts {
            checked("share", *share, "finite and positive", |v| v > 0.0)?;
            checked(
                "friction limit",
                law.friction_limit(),
                "the same for all vehicles",
                |v| v == limit,
            )?;
        }
        let total: f64 = parts.iter().map(|part| part.0).sum();
        let mut law = Self {
            parts: parts
                .into_iter()
                .map(|(share, law)| (share / total, law))
                .collect(),
            saturation: 0.0,
        };
        law.saturation = law.find_saturation();
        Ok(law)
    }

    /// Mean advance per pass \[m\] at a locked `friction` \[N/m\], and its slope \[m²/N\].
    pub fn advance(&self, friction: f64) -> (f64, f64) {
        self.parts
            .iter()
            .fold((0.0, 0.0), |(value, slope), (share, law)| {
                let (v, s) = law.advance(friction);
                (value + share * v, slope + share * s)
            })
    }

    /// Lag of the mean advance \[m\] (see [`AdvanceLaw::lag`]): to first order in the gradient of the friction the vehicles' lags
    /// count by the slopes of their advances.
    pub fn lag(&self, friction: f64) -> f64 {
        let (skew, slope) = self.parts.iter().fold((0.0, 0.0), |(skew, slope), (share, law)| {
            let part = share * law.advance(friction).1;
            (skew + part * law.lag(friction), slope + part)
        });
        if slope < 0.0 { skew / slope } else { 0.0 }
    }

    /// G(0) \[m\], positive toward growing x.
    pub fn free_advance(&self) -> f64 {
        self.parts
            .iter()
            .map(|(share, law)| share * law.free_advance())
            .sum()
    }

    /// f* \[N/m\]: the locked friction at which the mean advance vanishes, with the sign of the advance before.
    pub fn saturation(&self) -> f64 {
        self.saturation
    }

    /// q \[N/m\].
    pub fn friction_limit(&self) -> f64 {
        self.parts[0].1.friction_limit()
    }

    /// Largest longitudinal displacement of the duct under any of the vehicles \[m\].
    pub fn peak_longitudinal(&self) -> f64 {
        self.parts
            .iter()
            .map(|(_, law)| law.peak_longitudinal())
            .fold(0.0, f64::max)
    }

    /// The vehicles' laws with their shares, which add up to 1.
    pub fn parts(&self) -> &[(f64, AdvanceLaw)] {
        &self.parts
    }

    /// Locked friction \[N/m\] that all tables cover.
    pub fn domain(&self) -> (f64, f64) {
        self.parts
            .iter()
            .fold((f64::NEG_INFINITY, f64::INFINITY), |(low, high), (_, law)| {
                (low.max(law.domain().0), high.min(law.domain().1))
            })
    }

    /// The locked friction nearest to none at which nothing advances, by bisection.
    fn find_saturation(&self) -> f64 {
        if let [(_, law)] = self.parts.as_slice() {
            return law.saturation();
        }
        // What is only the tables' error is no advance.
        if self.free_advance().abs() <= crate::advance::NO_ADVANCE * self.peak_longitudinal() {
            return 0.0;
        }
        let sign = self.free_advance().signum();
        let (mut low, mut high) = (0.0, self.friction_limit());
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if sign * self.advance(sign * middle).0 > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        sign * 0.5 * (low + high)
    }
}
