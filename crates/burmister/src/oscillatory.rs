//! Integrals of a panel's Chebyshev series against J0(mr) and J1(mr).
//!
//! With m = c + (t + 1) ω/r, ω = r·(half width), two rules share the work:
//!
//! - **Gauss–Legendre** while the Bessel function turns few times. J(ω(t + const)) is entire of exponential type ω, so on the
//!   Bernstein ellipse of parameter e^α it is below e^(ω sinh α), and the series Σ `c_k` `T_k` below S(α) = Σ |`c_k`| e^(kα). An n-point
//!   rule is then off by at most (64/15) S(α) e^(ω sinh α − 2nα) / (1 − e^(−2α)) for every α (L. N. Trefethen, SIAM Review 50 (2008)
//!   67–87, theorem 4.5). That is a bound, not an estimate, and fixes n before anything is evaluated.
//! - **Levin's method** when it turns often (`levin`): only the ends of the panel are evaluated, however far the point.
//!
//! A panel for which neither serves (Levin's method cannot start at m = 0) is halved.

use ground_field::Displacement;

use crate::bessel::j0_j1;
use crate::gauss::{SIZES, rule_of_class};
use crate::levin::antiderivative;
use crate::panel::{NODES, Panel, Series, basis, dot};

/// Pieces of one panel for one radius: a few at every halving toward 0.
const MAX_PIECES: usize = 300;

/// The integrals over one panel, or a sum of them, for one radius.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Integrals {
    pub sum: Displacement,
    /// Bound of the rules' error.
    pub error: Displacement,
    /// Evaluations of (J0, J1).
    pub bessel: usize,
}

impl Integrals {
    /// No integral: what neither rule can do.
    const UNKNOWN: Self = Self {
        sum: Displacement::ZERO,
        error: Displacement {
            radial: f64::INFINITY,
            vertical: f64::INFINITY,
        },
        bessel: 0,
    };

    pub fn add(&mut self, other: Self) {
        self.sum += other.sum;
        self.error += other.error;
        self.bessel += other.bessel;
    }
}

/// A panel made ready for many radii.
pub(crate) struct Prepared<'a> {
    panel: &'a Panel,
    terms: usize,
    /// Tolerances of the two integrals.
    tolerance: Displacement,
    /// What trimming the series adds to the error.
    pub trimmed: Displacement,
    /// Whether any rule can meet the tolerances: the series are finite, and nothing is asked exactly.
    possible: bool,
    /// For each Gauss size the largest ω it serves; ascending, negative where it serves none.
    reach: [f64; SIZES.len()],
    /// Wavenumber and weighted transforms at the nodes of each Gauss size, once needed.
    nodes: Vec<Option<Vec<[f64; 3]>>>,
}

impl<'a> Prepared<'a> {
    pub fn new(panel: &'a Panel, tolerance: Displacement) -> Self {
        let (terms, trimmed) = panel.trimmed(tolerance);
        let reach = reach(panel, terms, tolerance);
        let size = panel.size();
        let within = |size: f64, tolerance: f64| size.is_finite() && (tolerance > 0.0 || size == 0.0);
        Self {
            possible: within(size.radial, tolerance.radial) && within(size.vertical, tolerance.vertical),
            panel,
            terms,
            tolerance,
            trimmed,
            reach,
            nodes: vec![None; SIZES.len()],
        }
    }

    /// The panel's integrals at `radius`.
    pub fn integrate(&mut self, radius: f64) -> Integrals {
        if !self.possible {
            return Integrals::UNKNOWN;
        }
        let omega = 0.5 * self.panel.width() * radius;
        if let Some(class) = self.class(omega) {
            return self.gauss_shared(class, radius);
        }
        let mut pieces = MAX_PIECES;
        self.divide(radius, (self.panel.from, self.panel.to), &mut pieces)
    }

    fn class(&self, omega: f64) -> Option<usize> {
        let class = self.reach.partition_point(|&reach| reach < omega);
        (class < SIZES.len()).then_some(class)
    }

    fn gauss_shared(&mut self, class: usize, radius: f64) -> Integrals {
        let (panel, terms) = (self.panel, self.terms);
        let nodes = self.nodes[class]
            .get_or_insert_with(|| weighted_nodes(panel, terms, panel.from, panel.to, class));
        self::sum(nodes, radius, self.tolerance)
    }

    fn divide(&self, radius: f64, (from, to): (f64, f64), pieces: &mut usize) -> Integrals {
        let omega = 0.5 * (to - from) * radius;
        if let Some(class) = self.class(omega) {
            let nodes = weighted_nodes(self.panel, self.terms, from, to, class);
            return sum(&nodes, radius, self.tolerance);
        }
        let by_levin = (from > 0.0).then(|| self.levin(radius, from, to));
        if let Some(done) = by_levin.flatten() {
            return done;
        }
        if *pieces == 0 {
            return Integrals::UNKNOWN;
        }
        *pieces -= 1;
        let middle = 0.5 * (from + to);
        let mut total = self.divide(radius, (from, middle), pieces);
        total.add(self.divide(radius, (middle, to), pieces));
        total
    }

    fn levin(&self, radius: f64, from: f64, to: f64) -> Option<Integrals> {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        let wavenumbers: Series = std::array::from_fn(|i| middle + half * basis().nodes[i]);
        let values = wavenumbers.map(|m| self.panel.at(m, self.terms));
        let (radial, vertical) = (values.map(|v| v.radial), values.map(|v| v.vertical));
        let zero = [0.0; NODES];
        let (interval, wanted) = ((half, &wavenumbers), self.tolerance);
        let (p_v, q_v, error_v) = antiderivative(radius, interval, (&vertical, &zero), wanted.vertical)?;
        let (p_r, q_r, error_r) = antiderivative(radius, interval, (&zero, &radial), wanted.radial)?;
        let (j0_to, j1_to) = j0_j1(to * radius);
        let (j0_from, j1_from) = j0_j1(from * radius);
        let ends = |p: &Series, q: &Series| {
            let [first, last] = &basis().ends;
            dot(p, last) * j0_to + dot(q, last) * j1_to - dot(p, first) * j0_from - dot(q, first) * j1_from
        };
        Some(Integrals {
            sum: Displacement {
                radial: ends(&p_r, &q_r),
                vertical: ends(&p_v, &q_v),
            },
            error: Displacement {
                radial: error_r,
                vertical: error_v,
            },
            bessel: 2,
        })
    }
}

/// For each Gauss size the largest ω for which the bound of the module's text is below `tolerance`: the best over a range of
/// ellipses. Negative for a size that is too small for the series alone.
fn reach(panel: &Panel, terms: usize, tolerance: Displacement) -> [f64; SIZES.len()] {
    const ELLIPSES: i32 = 28;
    let mut reach = [-1.0_f64; SIZES.len()];
    for step in 0..ELLIPSES {
        let alpha = 0.03 * 1.2_f64.powi(step);
        let growth = alpha.exp();
        let on_ellipse = |series: &Series| {
            let coefficients = series[..terms].iter().rev();
            coefficients.fold(0.0, |sum, c| sum * growth + c.abs())
        };
        let excess = (on_ellipse(&panel.radial) / tolerance.radial)
            .max(on_ellipse(&panel.vertical) / tolerance.vertical);
        let excess = (excess * 0.5 * panel.width() * (64.0 / 15.0) / (1.0 - 1.0 / (growth * growth))).ln();
        let sinh = alpha.sinh();
        for (reach, size) in reach.iter_mut().zip(SIZES) {
            *reach = reach.max((2.0 * size as f64 * alpha - excess) / sinh);
        }
    }
    reach
}

/// Wavenumbers and weighted transforms of the panel's series at the Gauss nodes of [from, to].
fn weighted_nodes(panel: &Panel, terms: usize, from: f64, to: f64, class: usize) -> Vec<[f64; 3]> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let weighted = |&(t, weight): &(f64, f64)| {
        let m = middle + half * t;
        let value = panel.at(m, terms) * (weight * half);
        [m, value.radial, value.vertical]
    };
    rule_of_class(class).iter().map(weighted).collect()
}

fn sum(nodes: &[[f64; 3]], radius: f64, tolerance: Displacement) -> Integrals {
    let mut sum = Displacement::ZERO;
    for &[m, radial, vertical] in nodes {
        let (j0, j1) = j0_j1(m * radius);
        sum.radial += radial * j1;
        sum.vertical += vertical * j0;
    }
    Integrals {
        sum,
        // The rule's size was chosen so that its bound is below this.
        error: tolerance,
        bessel: nodes.len(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::panel::series_of;

    /// f(m) = e^(−m/2) cos m in both components.
    fn panel(from: f64, to: f64) -> Panel {
        let values: Series = basis().nodes.map(|t| {
            let m = 0.5 * (from + to) + 0.5 * (to - from) * t;
            (-0.5 * m).exp() * m.cos()
        });
        Panel {
            from,
            to,
            radial: series_of(&values),
            vertical: series_of(&values),
            noise: Displacement::ZERO,
            hidden: 0.0,
        }
    }

    /// The same integrals by a composite rule with many points a turn.
    fn brute_force(panel: &Panel, radius: f64) -> (f64, f64) {
        let pieces = (panel.width() * radius / 20.0).ceil().max(4.0);
        let (mut radial, mut vertical) = (0.0, 0.0);
        for i in 0..pieces as usize {
            let half = 0.5 * panel.width() / pieces;
            let middle = panel.from + (2.0 * i as f64 + 1.0) * half;
            for &(t, weight) in rule_of_class(10) {
                let m = middle + half * t;
                let value = panel.at(m, NODES).radial;
                radial += half * weight * value * libm::j1(m * radius);
                vertical += half * weight * value * libm::j0(m * radius);
            }
        }
        (radial, vertical)
    }

    /// Every rule, from one turn to a hundred thousand, keeps the bound it states.
    #[test]
    fn all_radii_keep_their_bound() {
        for (from, to) in [(0.0, 2.0), (2.0, 4.0), (0.5, 1.0)] {
            let panel = panel(from, to);
            for tolerance in [1e-4, 1e-8, 1e-12] {
                let both = Displacement::ZERO.map(|_| tolerance);
                let mut prepared = Prepared::new(&panel, both);
                let mut radius = 0.0;
                while radius < 1e5 {
                    let got = prepared.integrate(radius);
                    let (radial, vertical) = brute_force(&panel, radius);
                    let allowed = |error: f64, trimmed: f64| error + trimmed + 1e-14;
                    assert!(
                        (got.sum.radial - radial).abs() <= allowed(got.error.radial, prepared.trimmed.radial),
                        "J1 {from} {to} {radius}"
                    );
                    assert!(
                        (got.sum.vertical - vertical).abs()
                            <= allowed(got.error.vertical, prepared.trimmed.vertical),
                        "J0 {from} {to} {radius}"
                    );
                    assert!(
                        got.error.radial <= 40.0 * tolerance && got.bessel <= 1200,
                        "{radius} {got:?}"
                    );
                    radius = radius * 1.7 + 0.31;
                }
            }
        }
    }
}
