//! The disc's field by brute force: the point load's formula, typed anew, integrated over the disc.
//!
//! Polar coordinates (s, ψ) about the field point's projection take the singularity away: the area element is s ds dψ. A
//! load at direction ψ pushes the point away from itself, outward by −cos ψ. Both integrals are adaptive Gauss–Legendre.

use std::f64::consts::PI;

use testkit::gauss_legendre::gauss_legendre;

/// Nodes and weights of the Gauss–Legendre rule on (−1, 1).
pub struct Rule(Vec<(f64, f64)>);

impl Rule {
    pub fn new(points: usize) -> Self {
        Self(gauss_legendre(points))
    }

    fn once(&self, f: &dyn Fn(f64) -> [f64; 2], from: f64, to: f64) -> [f64; 2] {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let mut sum = [0.0; 2];
        for (x, weight) in &self.0 {
            let value = f(middle + half * x);
            sum[0] += half * weight * value[0];
            sum[1] += half * weight * value[1];
        }
        sum
    }

    /// ∫ f, halving until both halves together agree with the whole to `tolerance`.
    pub fn integrate(&self, f: &dyn Fn(f64) -> [f64; 2], from: f64, to: f64, tolerance: f64) -> [f64; 2] {
        self.refine(f, from, to, self.once(f, from, to), tolerance, 40)
    }

    fn refine(
        &self,
        f: &dyn Fn(f64) -> [f64; 2],
        from: f64,
        to: f64,
        whole: [f64; 2],
        tolerance: f64,
        levels: u32,
    ) -> [f64; 2] {
        let middle = 0.5 * (from + to);
        let left = self.once(f, from, middle);
        let right = self.once(f, middle, to);
        let sum = [left[0] + right[0], left[1] + right[1]];
        let agreed = (0..2).all(|i| (sum[i] - whole[i]).abs() <= tolerance);
        if agreed || levels == 0 {
            return sum;
        }
        let left = self.refine(f, from, middle, left, tolerance, levels - 1);
        let right = self.refine(f, middle, to, right, tolerance, levels - 1);
        [left[0] + right[0], left[1] + right[1]]
    }
}

/// (u_r, u_z) · E/(p a) under uniform pressure p on a disc of radius 1 = a at distance r and depth z.
pub fn disc(rule: &Rule, poisson_ratio: f64, r: f64, z: f64) -> [f64; 2] {
    let nu = poisson_ratio;
    // Johnson (1985), eq. 3.18, times s for the area element.
    let kernel = |s: f64| {
        let distance = s.hypot(z);
        if distance == 0.0 {
            return [-(1.0 - 2.0 * nu), 2.0 * (1.0 - nu)];
        }
        let radial = s * z / distance.powi(3) - (1.0 - 2.0 * nu) * s / (distance * (distance + z));
        let vertical = z * z / distance.powi(3) + 2.0 * (1.0 - nu) / distance;
        [s * radial, s * vertical]
    };
    let ray = |from: f64, to: f64, cosine: f64, weight: f64| {
        let sum = rule.integrate(&kernel, from, to, 1e-14);
        [-cosine * weight * sum[0], weight * sum[1]]
    };
    let factor = (1.0 + nu) / PI;
    let sum = if r <= 1.0 {
        let direction = |psi: f64| {
            let to = -r * psi.cos() + (1.0 - (r * psi.sin()).powi(2)).max(0.0).sqrt();
            ray(0.0, to, psi.cos(), 1.0)
        };
        rule.integrate(&direction, 0.0, PI, 1e-13)
    } else {
        // Directions that meet the disc: sin ψ = sin t / r about the inward direction, |t| < π/2.
        let direction = |t: f64| {
            let sine = t.sin() / r;
            let cosine = (1.0 - sine * sine).sqrt();
            let half_chord = t.cos();
            ray(
                r * cosine - half_chord,
                r * cosine + half_chord,
                -cosine,
                half_chord / (r * cosine),
            )
        };
        rule.integrate(&direction, 0.0, PI / 2.0, 1e-13)
    };
    // Both halves of the disc are alike: twice the half, over 2π.
    [factor * sum[0], factor * sum[1]]
}
