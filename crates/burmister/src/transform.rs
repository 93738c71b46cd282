//! The Hankel transform of the remainder at many radii, with an error estimate that is checked against what was asked.
//!
//! The error of a value is the sum of: the cut Chebyshev series of every panel, the rule that integrates it against the
//! Bessel function, the wavenumbers left out beyond the last panel, and rounding. It is compared with the largest
//! displacement seen at this depth, over the asked radii and a few of the transform's own: a lower bound of the peak, so
//! that the check errs on the safe side. Panels are refined until the check holds, or the answer is an error.

use std::f64::consts::TAU;

use ground_field::{Displacement, GroundError, SurfaceLoad};

use crate::MODEL;
use crate::oscillatory::{Integrals, Prepared};
use crate::panel::{NODES, Panel, Panels};
use crate::remainder::Remainder;
use crate::statistics::Statistics;

const ROUNDS: usize = 5;
/// Wavenumbers after which refinement gives up.
const MAX_WAVENUMBERS: usize = 100_000;
/// Panels one expects; the tolerance is shared among them.
const EXPECTED_PANELS: f64 = 30.0;
/// Extensions of the wavenumber range, by a quarter each.
const MAX_EXTENSIONS: usize = 12;
/// Longest range considered at first, in units of 1/(decay length): e^−60 is far below rounding.
const LONGEST: f64 = 60.0;

/// Displacements of one remainder under one load.
pub(crate) struct Transform<'a> {
    pub remainder: &'a Remainder,
    pub load: SurfaceLoad,
    pub depth: f64,
    pub accuracy: f64,
    /// Radii at which the peak is looked for.
    pub probes: Vec<f64>,
}

/// A displacement with its error, radial and vertical.
type Bounded = (Displacement, (f64, f64));

impl Transform<'_> {
    /// Displacements at `radii`, in their order.
    ///
    /// # Errors
    ///
    /// [`GroundError::Singular`] where the field has no finite value, [`GroundError::Accuracy`] where the estimate is not below
    /// the asked accuracy.
    pub fn run(&self, radii: &[f64]) -> Result<(Vec<Displacement>, Statistics), GroundError> {
        let closed = self.closed_forms(radii)?;
        let mut statistics = Statistics::default();
        if self.remainder.vanishes || self.load.force() == 0.0 || radii.is_empty() {
            return Ok((closed.into_iter().map(|(value, _)| value).collect(), statistics));
        }

        let mut end = self.first_end();
        let mut panels = Panels::new(self.remainder, end);
        // First a rough picture, from which the peak is read.
        let (rough, hidden) = (panels.total(Panel::size), panels.total(Panel::cut));
        if !(rough.0 + rough.1 + hidden.0 + hidden.1).is_finite() {
            return Err(self.inaccurate((f64::INFINITY, radii[0])));
        }
        let mut peak = (0.0, 0.0);
        let mut tolerance = times(1e-3, rough);
        panels.refine(self.remainder, tolerance, MAX_WAVENUMBERS);
        let known = self.closed_forms(&self.probes)?;
        let probed = (&*self.probes, &*known);
        let probes = self.evaluate(&panels, (0.0, 0.0), tolerance, probed, &mut statistics);
        raise(&mut peak, &probes);

        // Of the error: for the cut series, as much for their integration, the rest for the tail and rounding.
        let mut share = 0.25;
        let mut worst = (f64::INFINITY, 0.0);
        for _ in 0..ROUNDS {
            let unit = TAU / self.load.force() * self.accuracy;
            tolerance = (goal(peak.0 * unit, tolerance.0), goal(peak.1 * unit, tolerance.1));
            let tail = self.extend(&mut panels, &mut end, tolerance);
            let each = times(share / EXPECTED_PANELS, tolerance);
            panels.refine(self.remainder, each, MAX_WAVENUMBERS);
            let each = times(share / panels.list.len() as f64, tolerance);
            let round = self.evaluate(&panels, tail, each, (radii, &closed), &mut statistics);
            raise(&mut peak, &round);

            worst = (0.0, 0.0);
            for ((_, error), &radius) in round.iter().zip(radii) {
                let relative = share_of(error.0, peak.0).max(share_of(error.1, peak.1));
                if relative >= worst.0 {
                    worst = (relative, radius);
                }
            }
            statistics.wavenumbers = panels.solved;
            statistics.panels = panels.list.len();
            statistics.estimated_error = worst.0;
            if worst.0 <= self.accuracy {
                return match round.iter().position(|(value, _)| !value.is_finite()) {
                    Some(i) => Err(self.singular(radii[i])),
                    None => Ok((round.into_iter().map(|(value, _)| value).collect(), statistics)),
                };
            }
            if panels.solved + 2 * NODES > MAX_WAVENUMBERS {
                break;
            }
            let again = self.evaluate(&panels, tail, each, probed, &mut statistics);
            raise(&mut peak, &again);
            share *= 0.1;
        }
        Err(self.inaccurate(worst))
    }

    /// The error that remains and the radius of it, as an error.
    fn inaccurate(&self, (reached, radius): (f64, f64)) -> GroundError {
        GroundError::Accuracy {
            model: MODEL,
            asked: self.accuracy,
            reached,
            radius,
            depth: self.depth,
        }
    }

    /// Closed forms at the radii, with their rounding error.
    fn closed_forms(&self, radii: &[f64]) -> Result<Vec<Bounded>, GroundError> {
        let closed = |&radius: &f64| match self.remainder.closed_form(self.load, radius) {
            Ok(closed) if closed.0.is_finite() => Ok(closed),
            _ => Err(self.singular(radius)),
        };
        radii.iter().map(closed).collect()
    }

    fn singular(&self, radius: f64) -> GroundError {
        GroundError::Singular {
            model: MODEL,
            radius,
            depth: self.depth,
        }
    }

    /// A guess where the transform has decayed: compared with its own size near 1/(decay length), for want of the peak.
    fn first_end(&self) -> f64 {
        let unit = 1.0 / self.remainder.decay_length;
        let mut size = (0.0_f64, 0.0_f64);
        for wavenumber in [0.25, 0.5, 1.0, 2.0].map(|x| x * unit) {
            let sample = self.remainder.field(wavenumber);
            size.0 = size.0.max(wavenumber * sample.0.abs());
            size.1 = size.1.max(wavenumber * sample.1.abs());
        }
        let decayed = |x: f64| {
            let tail = self.tail(x * unit);
            tail.0 <= 0.02 * self.accuracy * size.0 && tail.1 <= 0.02 * self.accuracy * size.1
        };
        let (mut low, mut high) = (1.0, LONGEST);
        while high - low > 1.0 {
            let middle = 0.5 * (low + high);
            if decayed(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        high * unit
    }

    /// Lengthens the range until what lies beyond is below a part of `tolerance`; returns what lies beyond.
    fn extend(&self, panels: &mut Panels, end: &mut f64, tolerance: (f64, f64)) -> (f64, f64) {
        let mut tail = self.tail(*end);
        for _ in 0..MAX_EXTENSIONS {
            if tail.0 <= 0.1 * tolerance.0 && tail.1 <= 0.1 * tolerance.1 {
                break;
            }
            panels.list.push(Panel::new(self.remainder, *end, 1.25 * *end));
            panels.solved += NODES;
            *end *= 1.25;
            tail = self.tail(*end);
        }
        tail
    }

    /// Integral of the transform's decaying end beyond `wavenumber`, from its values just before: what is left after
    /// rounding, over the decay length, with a factor 2 for the powers of m beside the exponential.
    fn tail(&self, wavenumber: f64) -> (f64, f64) {
        let (scale, mut tail) = (2.0 / self.remainder.decay_length, (0.0_f64, 0.0_f64));
        // Three places, lest a zero of the disc's factor passes for decay.
        for wavenumber in [1.0, 0.98, 0.95].map(|part| part * wavenumber) {
            let sample = self.remainder.sample(wavenumber);
            let noise = self.remainder.rounding(wavenumber);
            tail.0 = tail.0.max(scale * (sample.0.abs() - noise.0).max(0.0));
            tail.1 = tail.1.max(scale * (sample.1.abs() - noise.1).max(0.0));
        }
        tail
    }

    fn evaluate(
        &self,
        panels: &Panels,
        tail: (f64, f64),
        tolerance: (f64, f64),
        (radii, closed): (&[f64], &[Bounded]),
        statistics: &mut Statistics,
    ) -> Vec<Bounded> {
        let mut fixed = panels.total(Panel::cut);
        let noise = panels.total(|panel| panel.noise);
        fixed = (fixed.0 + noise.0 + tail.0, fixed.1 + noise.1 + tail.1);
        let mut sums = vec![Integrals::default(); radii.len()];
        for panel in &panels.list {
            let size = panel.size();
            if size.0 <= tolerance.0 && size.1 <= tolerance.1 {
                fixed = (fixed.0 + size.0, fixed.1 + size.1);
                continue;
            }
            let mut prepared = Prepared::new(panel, tolerance);
            fixed = (fixed.0 + prepared.trimmed.0, fixed.1 + prepared.trimmed.1);
            for (sum, &radius) in sums.iter_mut().zip(radii) {
                if sum.error.0.is_infinite() {
                    continue; // given up
                }
                sum.add(prepared.integrate(radius));
            }
        }
        statistics.bessel_pairs += sums.iter().map(|sum| sum.bessel).sum::<usize>();
        let unit = self.load.force() / TAU;
        let bounded = |((sum, &radius), &(closed, noise)): ((&Integrals, &f64), &Bounded)| {
            let mut rest = Displacement {
                radial: sum.radial,
                vertical: sum.vertical,
            };
            let mut error = (
                unit * (fixed.0 + sum.error.0) + noise.0,
                unit * (fixed.1 + sum.error.1) + noise.1,
            );
            // On the axis nothing moves aside.
            if radius == 0.0 {
                (rest.radial, error.0) = (0.0, 0.0);
            }
            (closed + rest * unit, error)
        };
        sums.iter().zip(radii).zip(closed).map(bounded).collect()
    }
}

fn times(factor: f64, pair: (f64, f64)) -> (f64, f64) {
    (factor * pair.0, factor * pair.1)
}

/// Raises `peak` to the largest value that is certain after its error.
fn raise(peak: &mut (f64, f64), round: &[Bounded]) {
    for (value, error) in round {
        peak.0 = peak.0.max(value.radial.abs() - error.0);
        peak.1 = peak.1.max(value.vertical.abs() - error.1);
    }
}

/// The error as a share of the peak; infinite for what is not a number, or where no peak is certain.
fn share_of(error: f64, peak: f64) -> f64 {
    if error == 0.0 {
        0.0
    } else if peak > 0.0 && error.is_finite() {
        error / peak
    } else {
        f64::INFINITY
    }
}

/// The tolerance a peak asks for; a thousandth of the last one where no peak was certain yet.
fn goal(wanted: f64, last: f64) -> f64 {
    if wanted > 0.0 { wanted } else { 1e-3 * last }
}
