//! Piecewise Chebyshev representation of the remainder's transform over the wavenumber.
//!
//! The layered system is solved only at the nodes of the panels, a few hundred times for all radii together. A panel
//! whose last coefficients are too large is halved. So panels grade themselves toward m = 0 and toward every scale the
//! ground has (1/thickness, 1/bending length, 1/contact radius). One thing coefficients cannot tell: what happens below a panel's first
//! node. The lowest panel is halved until it is shorter than the inverse of every length of the ground, or too short to matter.

use std::sync::OnceLock;

use ground_field::Displacement;

use crate::remainder::Remainder;

/// Chebyshev nodes a panel.
pub(crate) const NODES: usize = 20;
/// Coefficients at the end of a panel's series that are taken as the size of what was cut off.
const LAST: usize = 3;

/// One component's Chebyshev coefficients.
pub(crate) type Series = [f64; NODES];

/// An interval of the wavenumber with the transform's Chebyshev series on it.
#[derive(Debug, Clone)]
pub(crate) struct Panel {
    pub from: f64,
    pub to: f64,
    pub radial: Series,
    pub vertical: Series,
    /// Rounding error of the two integrals.
    pub noise: Displacement,
    /// What the samples may have missed of either integral.
    pub hidden: f64,
}

/// Chebyshev nodes of the first kind and what is linear in the values there.
pub(crate) struct Basis {
    pub nodes: [f64; NODES],
    /// `cosines[k][i]` = `T_k`(node i): the discrete transform.
    pub cosines: [[f64; NODES]; NODES],
    /// Derivative of the interpolating polynomial at the nodes: the sum of column j times value j (column by column, so that
    /// the inner loop has no chain of additions).
    pub derivative: [[f64; NODES]; NODES],
    /// Value of the interpolating polynomial at −1 and at 1.
    pub ends: [[f64; NODES]; 2],
}

pub(crate) fn basis() -> &'static Basis {
    static BASIS: OnceLock<Basis> = OnceLock::new();
    BASIS.get_or_init(|| {
        let angle = |i: usize| std::f64::consts::PI * (i as f64 + 0.5) / NODES as f64;
        let cosines: [[f64; NODES]; NODES] =
            std::array::from_fn(|k| std::array::from_fn(|i| (k as f64 * angle(i)).cos()));
        // Weights of term k in the series of the values: with T_k' = k sin(kθ)/sin θ they give the derivative, with
        // T_k(±1) = (±1)^k the ends.
        let share = |k: usize| if k == 0 { 1.0 } else { 2.0 } / NODES as f64;
        let slope = |k: usize, i: usize| k as f64 * (k as f64 * angle(i)).sin() / angle(i).sin();
        let sum = |of: &dyn Fn(usize) -> f64| (0..NODES).map(of).sum::<f64>();
        Basis {
            nodes: cosines[1],
            cosines,
            derivative: std::array::from_fn(|j| {
                std::array::from_fn(|i| sum(&|k| share(k) * cosines[k][j] * slope(k, i)))
            }),
            ends: std::array::from_fn(|end| {
                let sign = |k: usize| if end == 0 && k % 2 == 1 { -1.0 } else { 1.0 };
                std::array::from_fn(|j| sum(&|k| share(k) * cosines[k][j] * sign(k)))
            }),
        }
    })
}

/// d/dt of the polynomial with these values at the nodes, at the nodes.
pub(crate) fn derivative_of(values: &Series) -> Series {
    let mut slope = [0.0; NODES];
    for (column, value) in basis().derivative.iter().zip(values) {
        for (slope, weight) in slope.iter_mut().zip(column) {
            *slope += weight * value;
        }
    }
    slope
}

pub(crate) fn dot(one: &Series, other: &Series) -> f64 {
    one.iter().zip(other).map(|(a, b)| a * b).sum()
}

/// Series of the polynomial with these values at the nodes.
pub(crate) fn series_of(values: &Series) -> Series {
    let basis = basis();
    std::array::from_fn(|k| dot(values, &basis.cosines[k]) * if k == 0 { 1.0 } else { 2.0 } / NODES as f64)
}

/// Value of the first `terms` terms at `t` in [−1, 1], by Clenshaw's recurrence.
fn evaluate(series: &[f64], t: f64) -> f64 {
    let (mut upper, mut lower) = (0.0, 0.0);
    for &c in series.iter().skip(1).rev() {
        (upper, lower) = (c + 2.0 * t * upper - lower, upper);
    }
    series[0] + t * upper - lower
}

impl Panel {
    pub fn new(remainder: &Remainder, from: f64, to: f64) -> Self {
        let (middle, half) = (0.5 * (to + from), 0.5 * (to - from));
        let mut radial = [0.0; NODES];
        let mut vertical = [0.0; NODES];
        for (i, node) in basis().nodes.iter().enumerate() {
            let sample = remainder.sample(middle + half * node);
            (radial[i], vertical[i]) = (sample.radial, sample.vertical);
        }
        let early = remainder.rounding(middle - 0.8 * half);
        let noise = early.zip(remainder.rounding(middle), f64::max);
        Self {
            from,
            to,
            radial: series_of(&radial),
            vertical: series_of(&vertical),
            noise: noise * (2.0 * half),
            hidden: if from == 0.0 { remainder.hidden(to) } else { 0.0 },
        }
    }

    pub fn width(&self) -> f64 {
        self.to - self.from
    }

    /// Value of both series' first `terms` terms at `wavenumber`.
    pub fn at(&self, wavenumber: f64, terms: usize) -> Displacement {
        let local = (2.0 * wavenumber - self.from - self.to) / self.width();
        self.of_series(|series| evaluate(&series[..terms], local))
    }

    fn of_series(&self, of: impl Fn(&Series) -> f64) -> Displacement {
        Displacement {
            radial: of(&self.radial),
            vertical: of(&self.vertical),
        }
    }

    /// Error of the integrals of (radial J1, vertical J0) over the panel from the cut of the series and what no sample saw: |J| ≤ 1.
    pub fn cut(&self) -> Displacement {
        let last = |s: &Series| s[NODES - LAST..].iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        self.of_series(|series| last(series) * self.width() + self.hidden)
    }

    /// Bound of the integrals' absolute values.
    pub fn size(&self) -> Displacement {
        self.of_series(|series| series.iter().map(|c| c.abs()).sum::<f64>() * self.width())
    }

    /// Number of terms after which the rest of both series adds less than the tolerances to the integrals, and what it adds.
    pub fn trimmed(&self, tolerance: Displacement) -> (usize, Displacement) {
        let mut rest = Displacement::ZERO;
        let mut terms = NODES;
        while terms > 1 {
            let next = rest + self.of_series(|series| series[terms - 1].abs() * self.width());
            if next.radial > tolerance.radial || next.vertical > tolerance.vertical {
                break;
            }
            rest = next;
            terms -= 1;
        }
        (terms, rest)
    }
}

/// Whether both components keep their limits.
pub(crate) fn is_within(value: Displacement, limit: Displacement) -> bool {
    value.radial <= limit.radial && value.vertical <= limit.vertical
}

/// Panels that cover the wavenumbers from 0 to where the transform has decayed.
#[derive(Debug, Clone)]
pub(crate) struct Panels {
    pub list: Vec<Panel>,
    /// Wavenumbers solved so far.
    pub solved: usize,
}

impl Panels {
    /// Coarse panels on [0, `end`], halved toward 0 a few times.
    pub fn new(remainder: &Remainder, end: f64) -> Self {
        let mut list = Vec::new();
        let mut to = end;
        for _ in 0..3 {
            list.push(Panel::new(remainder, 0.5 * to, to));
            to *= 0.5;
        }
        list.push(Panel::new(remainder, 0.0, to));
        let solved = list.len() * NODES;
        Self { list, solved }
    }

    /// Halves panels until each one's cut is below `tolerance` or below its rounding error, or `limit` wavenumbers are
    /// solved.
    pub fn refine(&mut self, remainder: &Remainder, tolerance: Displacement, limit: usize) {
        let mut open = std::mem::take(&mut self.list);
        while let Some(panel) = open.pop() {
            let good = is_within(panel.cut(), tolerance.zip(panel.noise, f64::max));
            let middle = 0.5 * (panel.from + panel.to);
            let divisible = panel.from < middle && middle < panel.to;
            if good || !divisible || self.solved + 2 * NODES > limit {
                self.list.push(panel);
            } else {
                open.push(Panel::new(remainder, panel.from, middle));
                open.push(Panel::new(remainder, middle, panel.to));
                self.solved += 2 * NODES;
            }
        }
    }

    pub fn total(&self, of: impl Fn(&Panel) -> Displacement) -> Displacement {
        let parts = self.list.iter().map(of);
        parts.fold(Displacement::ZERO, |sum, part| sum + part)
    }
}
