//! The Hankel transform of the remainder at many radii, with an error estimate that is checked against what was asked.
//!
//! The error of a value is the sum of: the cut Chebyshev series of every panel, the rule that integrates it against the
//! Bessel function, the wavenumbers left out beyond the last panel, and rounding. It is compared with the largest
//! displacement seen at this depth, over the asked radii and a few of the transform's own: a lower bound of the peak, so
//! that the check errs on the safe side. Panels are refined until the check holds, or the answer is an error.

use std::f64::consts::TAU;

use ground_field::{Displacement, GroundError, SurfaceLoad};

use crate::MODEL;
use crate::image::Bounded;
use crate::oscillatory::{Integrals, Prepared};
use crate::panel::{NODES, Panel, Panels, is_within};
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

impl Transform<'_> {
    /// Displacements at `radii`, in their order.
    ///
    /// # Errors
    ///
    /// [`GroundError::Singular`] if the field has no finite value, [`GroundError::Accuracy`] if the estimate is not below
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
        if !(rough + hidden).is_finite() {
            return Err(self.inaccurate((f64::INFINITY, radii[0])));
        }
        let mut peak = Displacement::ZERO;
        let mut tolerance = rough * 1e-3;
        panels.refine(self.remainder, tolerance, MAX_WAVENUMBERS);
        let known = self.closed_forms(&self.probes)?;
        let probed = (&*self.probes, &*known);
        let probes = self.evaluate(&panels, Displacement::ZERO, tolerance, probed, &mut statistics);
        raise(&mut peak, &probes);

        // Of the error: for the cut series, as much for their integration, the rest for the tail and rounding.
        let mut share = 0.25;
        let mut worst = (f64::INFINITY, 0.0);
        for _ in 0..ROUNDS {
            let unit = TAU / self.load.force() * self.accuracy;
            tolerance = (peak * unit).zip(tolerance, goal);
            let tail = self.extend(&mut panels, &mut end, tolerance);
            let each = tolerance * (share / EXPECTED_PANELS);
            panels.refine(self.remainder, each, MAX_WAVENUMBERS);
            let each = tolerance * (share / panels.list.len() as f64);
            let round = self.evaluate(&panels, tail, each, (radii, &closed), &mut statistics);
            raise(&mut peak, &round);

            worst = (0.0, 0.0);
            for ((_, error), &radius) in round.iter().zip(radii) {
                let shares = error.zip(peak, share_of);
                let relative = shares.radial.max(shares.vertical);
                if relative >= worst.0 {
                    worst = (relative, radius);
                }
            }
            statistics.wavenumbers = panels.solved;
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
        let sizes = [0.25, 0.5, 1.0, 2.0].map(|x| {
            let wavenumber = x * unit;
            self.remainder.field(wavenumber).map(f64::abs) * wavenumber
        });
        let size = largest(sizes);
        let decayed = |x: f64| is_within(self.tail(x * unit), size * (0.02 * self.accuracy));
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
    fn extend(&self, panels: &mut Panels, end: &mut f64, tolerance: Displacement) -> Displacement {
        let mut tail = self.tail(*end);
        for _ in 0..MAX_EXTENSIONS {
            if is_within(tail, tolerance * 0.1) {
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
    /// rounding, over the decay length, with a factor 2 for the powers of m before the exponential.
    fn tail(&self, wavenumber: f64) -> Displacement {
        // Three places, lest a zero of the disc's factor passes for decay.
        largest([1.0, 0.98, 0.95].map(|part| {
            let sample = self.remainder.sample(part * wavenumber);
            let noise = self.remainder.rounding(part * wavenumber);
            (sample.map(f64::abs) - noise) * (2.0 / self.remainder.decay_length)
        }))
    }

    fn evaluate(
        &self,
        panels: &Panels,
        tail: Displacement,
        tolerance: Displacement,
        (radii, closed): (&[f64], &[Bounded]),
        statistics: &mut Statistics,
    ) -> Vec<Bounded> {
        let mut fixed = panels.total(Panel::cut) + panels.total(|panel| panel.noise) + tail;
        let mut sums = vec![Integrals::default(); radii.len()];
        for panel in &panels.list {
            let size = panel.size();
            if is_within(size, tolerance) {
                fixed += size;
                continue;
            }
            let mut prepared = Prepared::new(panel, tolerance);
            fixed += prepared.trimmed;
            for (sum, &radius) in sums.iter_mut().zip(radii) {
                if sum.error.radial.is_infinite() {
                    continue; // given up
                }
                sum.add(prepared.integrate(radius));
            }
        }
        statistics.bessel_pairs += sums.iter().map(|sum| sum.bessel).sum::<usize>();
        let unit = self.load.force() / TAU;
        let bounded = |((sum, &radius), &(closed, noise)): ((&Integrals, &f64), &Bounded)| {
            let mut rest = sum.sum * unit;
            let mut error = (fixed + sum.error) * unit + noise;
            // On the axis nothing moves aside.
            if radius == 0.0 {
                (rest.radial, error.radial) = (0.0, 0.0);
            }
            (closed + rest, error)
        };
        sums.iter().zip(radii).zip(closed).map(bounded).collect()
    }
}

/// The larger of all components, none below zero.
fn largest<const N: usize>(values: [Displacement; N]) -> Displacement {
    let larger = |most: Displacement, value| most.zip(value, f64::max);
    values.into_iter().fold(Displacement::ZERO, larger)
}

/// Raises `peak` to the largest value that is certain after its error.
fn raise(peak: &mut Displacement, round: &[Bounded]) {
    for (value, error) in round {
        *peak = peak.zip(value.map(f64::abs) - *error, f64::max);
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
