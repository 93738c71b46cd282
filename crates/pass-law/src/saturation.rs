//! What a designer asks, in closed form from G.
//!
//! Saturated, friction is f* everywhere and the force grows along the duct from end to end by f* L and both ends' layers S.
//! Ends that give (springs s₀, s₁; 1/s = 0 where fixed) share it by elasticity,
//!
//! E₀ (1/s₀ + L/EA + 1/s₁) = v₁ − v₀ − (S₀ L + f* L²/2)/EA − (S₀ + f* L + S₁)/s₁,  E₁ = E₀ + S₀ + f* L + S₁,
//!
//! with E the force on an end, compression positive, and v a layer's displacement.
//!
//! On the way there, G is replaced by the straight line from G(0) to 0 at f* with the same area, ∂u/∂n = Ḡ + D ∂²u/∂x²,
//! D = 2 EA/f*² ∫ G df and Ḡ = D f*/EA: the heat equation. From a fixed end the locked zone grows as
//!
//! X(n) = 2 √(D n/π),  F(n) = f* X(n),
//!
//! (H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, 2nd ed. 1959, §2.9), and between a free and a fixed end
//!
//! F(n)/F(∞) = 1 − Σ 8/((2k+1)²π²) exp(−(2k+1)²π² D n/(4 L²))  (§3.4);
//!
//! with both ends fixed, L is half the length. The ends' layers are left out of F(n); [`crate::PassLaw::run`] has all of it.

use std::f64::consts::PI;

use cable_dem::End;

use crate::PassLaw;

/// Days of a year.
const DAYS: f64 = 365.25;
/// Terms of the series; beyond it the √n law holds to rounding.
const TERMS: u32 = 40;

/// Closed forms for one law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Saturation {
    /// f* \[N/m\].
    pub friction: f64,
    /// Saturated force on the upstream end \[N\], compression positive.
    pub upstream_force: f64,
    /// Saturated force on the downstream end \[N\], compression positive.
    pub downstream_force: f64,
    /// D, by which locked friction spreads \[m² per pass\].
    pub diffusivity: f64,
    /// Length over which it has to spread \[m\].
    length: f64,
}

impl Saturation {
    /// Length of duct X(n) \[m\] that has locked its friction after `passes`, before the front meets the other end.
    pub fn front(&self, passes: f64) -> f64 {
        2.0 * (self.diffusivity * passes.max(0.0) / PI).sqrt()
    }

    /// Force F(n) = f* X(n) \[N\] at a fixed end before the front meets the other end.
    pub fn early_force(&self, passes: f64) -> f64 {
        self.friction * self.front(passes)
    }

    /// Share of the saturated force reached after `passes`.
    pub fn share(&self, passes: f64) -> f64 {
        let time = self.diffusivity * passes.max(0.0) / (self.length * self.length);
        if time < 0.1 {
            return 2.0 * (time / PI).sqrt();
        }
        1.0 - (0..TERMS)
            .map(|k| {
                let odd = f64::from(2 * k + 1) * PI;
                8.0 / (odd * odd) * (-0.25 * odd * odd * time).exp()
            })
            .sum::<f64>()
    }

    /// Passes after which `share` of the saturated force is reached; none unless 0 ≤ share < 1.
    pub fn passes_to(&self, share: f64) -> Option<f64> {
        if !(0.0..1.0).contains(&share) || self.diffusivity <= 0.0 {
            return None;
        }
        let mut high = 1.0;
        while self.share(high) < share {
            high *= 2.0;
        }
        let mut low = 0.0;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.share(middle) < share {
                low = middle;
            } else {
                high = middle;
            }
        }
        Some(0.5 * (low + high))
    }
}

impl PassLaw {
    /// What the cable tends to; none where it does not saturate because nothing holds it, and none for cables with clamps,
    /// which need [`PassLaw::run`].
    pub fn saturation(&self) -> Option<Saturation> {
        let cable = self.cable();
        let give = |end: End| match end {
            End::Free => None,
            End::Fixed => Some(0.0),
            End::Spring(stiffness) => (stiffness > 0.0).then(|| 1.0 / stiffness),
        };
        let (first, last) = (give(cable.upstream()), give(cable.downstream()));
        if !cable.restraints().is_empty() || (first.is_none() && last.is_none()) {
            return None;
        }
        let (length, stiffness) = (cable.length(), cable.axial_stiffness());
        let friction = self.law().saturation();
        let layer =
            |layer: &crate::layer::Layer| (layer.force.at(friction).0, layer.displacement.at(friction).0);
        let ((s0, v0), (s1, v1)) = (layer(&self.upstream), layer(&self.downstream));
        let total = s0 + friction * length + s1;
        let upstream = match (first, last) {
            (None, _) => 0.0,
            (_, None) => -total,
            (Some(first), Some(last)) => {
                (v1 - v0 - (s0 * length + 0.5 * friction * length * length) / stiffness - total * last)
                    / (first + last + length / stiffness)
            }
        };
        let halves = if first.is_some() && last.is_some() {
            2.0
        } else {
            1.0
        };
        Some(Saturation {
            friction,
            upstream_force: upstream,
            downstream_force: upstream + total,
            diffusivity: self.diffusivity(),
            length: length / halves,
        })
    }

    /// Movement per pass \[m\] of a cable that nothing holds, positive toward growing x: G(0).
    pub fn free_movement_per_pass(&self) -> f64 {
        self.law().free_advance()
    }

    /// Movement in a year \[m\] of a cable that nothing holds, at this many passes a day.
    pub fn free_movement_per_year(&self, passes_per_day: f64) -> f64 {
        DAYS * passes_per_day * self.free_movement_per_pass()
    }

    /// D = 2 EA/f*² ∫ G df \[m² per pass\]; 0 where nothing advances.
    fn diffusivity(&self) -> f64 {
        let star = self.law().saturation();
        if star == 0.0 {
            return 0.0;
        }
        let pieces = 200;
        let mean = (0..pieces)
            .map(|k| {
                self.law()
                    .advance(star * (f64::from(k) + 0.5) / f64::from(pieces))
                    .0
            })
            .sum::<f64>()
            / f64::from(pieces);
        2.0 * self.cable().axial_stiffness() * mean / star
    }
}
