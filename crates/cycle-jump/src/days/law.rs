//! The advance of a cable against the friction that is locked in: one table, made by passes over a
//! short cable.

/// Slope of the law beyond its table, as a share of q over the table's width: it keeps a cable that
/// slides everywhere in place.
const RESIDUAL: f64 = 1e-4;
/// Minimum difference of advances \[m\]: the law falls strictly.
const MIN_DIFFERENCE: f64 = 1e-10;
/// Advances below this count as zero \[m\]: ten million of them are a tenth of a millimetre.
const STILL: f64 = 1e-11;

/// Friction f̄ \[N/m\] against which a cable advances by v \[m\] in a period of the traffic: f̄ =
/// Φ(v), falling.
///
/// Within the table it is piecewise linear. Beyond it goes straight to ±q over one more width of
/// the table and stays there: the duct slips past the cable wholly one way.
#[derive(Debug, Clone)]
pub struct LockedLaw {
    /// Advances, ascending, and Φ there.
    advance: Vec<f64>,
    friction: Vec<f64>,
    limit: f64,
    residual: f64,
    is_still: bool,
}

impl LockedLaw {
    /// Shares of q for which the advance is measured, the same both ways. More of them change
    /// nothing: with ten the forces of days differ by less than a tenth of a per cent.
    pub const SHARES: [f64; 16] = [
        -0.96, -0.9, -0.82, -0.72, -0.6, -0.45, -0.28, -0.1, 0.1, 0.28, 0.45, 0.6, 0.72, 0.82, 0.9, 0.96,
    ];

    /// The law with friction limit `limit` q \[N/m\] through `advances` \[m\], one for each of
    /// [`LockedLaw::SHARES`]: how far the middle of a cable advances in a period on which a body
    /// force −share · q acts.
    pub fn new(advances: [f64; Self::SHARES.len()], limit: f64) -> Self {
        let mut falling = advances;
        for k in 1..falling.len() {
            falling[k] = falling[k].min(falling[k - 1] - MIN_DIFFERENCE);
        }
        let (most, least) = (falling[0], falling[falling.len() - 1]);
        let width = most - least;
        let mut advance = vec![most + width];
        advance.extend(falling);
        advance.push(least - width);
        advance.reverse();
        let mut friction = vec![limit];
        friction.extend(Self::SHARES.iter().rev().map(|share| share * limit));
        friction.push(-limit);
        Self {
            advance,
            friction,
            limit,
            residual: RESIDUAL * limit / width,
            is_still: advances.iter().all(|advance| advance.abs() < STILL),
        }
    }

    /// Whether the traffic moves a cable nowhere, whatever friction is locked in: below shakedown,
    /// or without load.
    pub fn is_still(&self) -> bool {
        self.is_still
    }

    /// Φ(v) \[N/m\] on a section of the duct with another friction `limit` \[N/m\]: the same share of it.
    pub fn friction(&self, advance: f64, limit: f64) -> f64 {
        self.segment(advance).0 * (limit / self.limit)
    }

    /// Friction Φ(v) + r within ± the `limit` of the section, and minus its slope \[N/m²\].
    pub(super) fn with_defect(&self, advance: f64, defect: f64, limit: f64) -> (f64, f64) {
        let (friction, slope) = self.segment(advance);
        let relative = limit / self.limit;
        let shifted = friction * relative + defect;
        let slope = if shifted.abs() >= limit {
            0.0
        } else {
            slope * relative
        };
        let friction = shifted.clamp(-limit, limit) - self.residual * advance;
        (friction, slope + self.residual)
    }

    /// Φ(v) and minus its slope.
    fn segment(&self, v: f64) -> (f64, f64) {
        let next = self.advance.partition_point(|advance| *advance < v);
        if next == 0 || next == self.advance.len() {
            return (if next == 0 { self.limit } else { -self.limit }, 0.0);
        }
        let (a, b) = (next - 1, next);
        let slope = (self.friction[a] - self.friction[b]) / (self.advance[b] - self.advance[a]);
        (self.friction[a] - slope * (v - self.advance[a]), slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_law_falls_from_limit_to_limit_through_its_table() {
        let advances = LockedLaw::SHARES.map(|share| 10e-6 * (0.7 - share));
        let law = LockedLaw::new(advances, 30.0);
        for (share, advance) in LockedLaw::SHARES.iter().zip(advances) {
            assert!((law.friction(advance, 30.0) - 30.0 * share).abs() < 1e-9);
        }
        assert_eq!((law.friction(-1.0, 30.0), law.friction(1.0, 30.0)), (30.0, -30.0));
        let falls = (-600..600).map(|k| law.friction(1e-7 * f64::from(k), 30.0));
        assert!(
            falls
                .collect::<Vec<_>>()
                .windows(2)
                .all(|pair| pair[1] <= pair[0])
        );
        // The defect moves it, but not beyond the limit.
        let (friction, slope) = law.with_defect(0.0, 3.0, 30.0);
        assert!((friction - 24.0).abs() < 1e-9 && slope > 0.0);
        assert!((law.with_defect(0.0, 20.0, 30.0).0 - 30.0).abs() < 1e-9);
    }

    #[test]
    fn where_no_vehicle_moves_the_cable_the_law_is_that_of_friction() {
        let law = LockedLaw::new([0.0; LockedLaw::SHARES.len()], 30.0);
        assert!(
            (law.friction(-1e-7, 30.0) - 30.0).abs() < 1e-9 && (law.friction(1e-7, 30.0) + 30.0).abs() < 1e-9
        );
    }
}
