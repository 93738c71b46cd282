//! The advance per pass of one vehicle, G(f̄), tabulated.
//!
//! G depends on the locked friction f̄ alone. It falls with f̄ and crosses zero at f*, the locked friction of the saturated
//! duct. The table is refined by bisection until the cell problem, solved at the middle of every piece, agrees with the
//! monotone interpolant. Both directions of traffic have a table of their own; for the mirror image of a vehicle,
//! [`AdvanceLaw::opposed`], it is −G(−f̄).
//!
//! Assumes a friction law with memory, uniform duct and ground, and friction that varies slowly along the duct.

use cable_dem::{CableError, DuctedCable};
use ground_field::DuctMotion;

use crate::cell::Cell;
use crate::error::checked;
use crate::table::Table;
use crate::{LawError, Resolution};

/// An advance below this share of the duct's largest displacement counts as none; every advance is less by it.
pub(crate) const NO_ADVANCE: f64 = 1e-4;
/// f* is found to this share of q.
const ROOT_ACCURACY: f64 = 5e-5;
/// Largest locked friction that is tried, as a share of q.
const LARGEST: f64 = 0.98;
/// The table goes on beyond f* by this share of q.
const MARGIN: f64 = 0.04;
/// Pieces are not bisected below this share of q: with Coulomb's law the cell's nodes show through there.
const FINEST: f64 = 0.03;
/// The lag is tabulated at this many points.
const LAG_POINTS: usize = 7;
/// Longest lag, in depths.
const LONGEST_LAG: f64 = 8.0;
/// Where G falls by less than this share of the peak displacement over q, it has no lag.
const FLAT: f64 = 1e-3;
/// A cell's estimated error may be this many times the table's accuracy.
const UNSETTLED: f64 = 5.0;

/// What a table cost.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct LawStatistics {
    /// Passes over cells.
    pub cell_passes: usize,
    /// Nodes of the table.
    pub nodes: usize,
    /// Largest estimated error of a cell's advance \[m\].
    pub cell_error: f64,
}

/// G(f̄) of one vehicle on one cable.
#[derive(Debug, Clone, PartialEq)]
pub struct AdvanceLaw {
    table: Table,
    lag: Table,
    limit: f64,
    peak: f64,
    free_advance: f64,
    saturation: f64,
    statistics: LawStatistics,
}

impl AdvanceLaw {
    /// The law of the vehicle whose duct motion is `motion`, for `cable`'s stiffness and friction; its length, ends and
    /// clamps do not matter. Tabulated from no friction to a little past f*.
    ///
    /// # Errors
    ///
    /// [`LawError::Cable`] with [`CableError::UnsupportedLaw`] for friction without memory, and for what the solver refuses;
    /// [`LawError::CellUnsettled`] where a cell is too short for the vehicle's effect.
    pub fn new(cable: &DuctedCable, motion: &DuctMotion, resolution: Resolution) -> Result<Self, LawError> {
        let draft = Draft::new(cable, motion, resolution)?;
        let (from, to) = (draft.saturation.min(0.0), draft.saturation.max(0.0));
        draft.tabulate(from, to)
    }

    /// As [`AdvanceLaw::new`], tabulated at least between the locked frictions `from` and `to` \[N/m\], as far as
    /// ±0.98 q.
    ///
    /// # Errors
    ///
    /// As for [`AdvanceLaw::new`]; [`LawError::InvalidParameter`] unless `from` ≤ 0 ≤ `to`.
    pub fn between(
        cable: &DuctedCable,
        motion: &DuctMotion,
        resolution: Resolution,
        from: f64,
        to: f64,
    ) -> Result<Self, LawError> {
        checked("from", from, "finite and not positive", |v| v <= 0.0)?;
        checked("to", to, "finite and not negative", |v| v >= 0.0)?;
        let draft = Draft::new(cable, motion, resolution)?;
        let (from, to) = (from.min(draft.saturation), to.max(draft.saturation));
        draft.tabulate(from, to)
    }

    /// Advance per pass \[m\] at a locked `friction` \[N/m\], positive toward growing x, and its slope \[m²/N\]. Outside the
    /// table it goes on in a straight line.
    pub fn advance(&self, friction: f64) -> (f64, f64) {
        self.table.at(friction)
    }

    /// Lag ℓ(f̄) \[m\], positive toward growing x: where friction varies along the duct, the advance a follows
    /// G with a memory of what the vehicle passed before, a + ℓ ∂a/∂x = G(f̄).
    pub fn lag(&self, friction: f64) -> f64 {
        let (low, high) = self.lag.domain();
        self.lag.at(friction.clamp(low, high)).0
    }

    /// G(0) \[m\]: the movement per pass of a cable that nothing holds.
    pub fn free_advance(&self) -> f64 {
        self.free_advance
    }

    /// f* \[N/m\], with the sign of the traffic's direction; 0 where nothing advances.
    pub fn saturation(&self) -> f64 {
        self.saturation
    }

    /// q \[N/m\].
    pub fn friction_limit(&self) -> f64 {
        self.limit
    }

    /// Largest longitudinal displacement of the duct \[m\].
    pub fn peak_longitudinal(&self) -> f64 {
        self.peak
    }

    /// Least and greatest locked friction \[N/m\] of the table.
    pub fn domain(&self) -> (f64, f64) {
        self.table.domain()
    }

    /// The table: locked friction \[N/m\] and advance \[m\], ascending.
    pub fn nodes(&self) -> &[[f64; 2]] {
        self.table.nodes()
    }

    /// What the table cost.
    pub fn statistics(&self) -> LawStatistics {
        self.statistics
    }

    /// The same vehicle coming the opposite way: −G(−f̄).
    #[must_use]
    pub fn opposed(&self) -> Self {
        let mirrored = |table: &Table, sign: f64| {
            Table::new(
                table
                    .nodes()
                    .iter()
                    .rev()
                    .map(|&[f, value]| [-f, sign * value])
                    .collect(),
            )
        };
        Self {
            table: mirrored(&self.table, -1.0),
            lag: mirrored(&self.lag, -1.0),
            free_advance: -self.free_advance,
            saturation: -self.saturation,
            ..self.clone()
        }
    }
}

/// A law whose saturation is known and whose table is yet to be made.
#[derive(Debug)]
pub(crate) struct Draft<'a> {
    cell: Cell<'a>,
    resolution: Resolution,
    limit: f64,
    peak: f64,
    /// Shares of q, advances and their estimated errors.
    known: Vec<[f64; 3]>,
    error: f64,
    pub saturation: f64,
}

impl<'a> Draft<'a> {
    pub fn new(
        cable: &DuctedCable,
        motion: &'a DuctMotion,
        resolution: Resolution,
    ) -> Result<Self, LawError> {
        let friction = cable.friction();
        if !friction.law().has_memory() {
            return Err(LawError::Cable(CableError::UnsupportedLaw {
                solver: "pass law",
                law: friction.law().name(),
                reason: "friction that fades at rest locks nothing in",
            }));
        }
        let mut draft = Self {
            cell: Cell::new(cable, motion, resolution)?,
            resolution,
            limit: friction.limit(),
            peak: motion.peak_longitudinal(),
            known: Vec::new(),
            error: 0.0,
            saturation: 0.0,
        };
        draft.saturation = draft.find_saturation()?;
        Ok(draft)
    }

    /// G at `share` of q, remembered.
    fn sample(&mut self, share: f64) -> Result<f64, LawError> {
        if let Some(known) = self.known.iter().find(|node| node[0] == share) {
            return Ok(known[1]);
        }
        let advance = self.cell.advance(share * self.limit)?;
        // What is only the solver's tolerance must not add up over millions of passes.
        let floor = NO_ADVANCE * self.peak;
        let value = advance.value - advance.value.clamp(-floor, floor);
        self.known.push([share, value, advance.error]);
        Ok(value)
    }

    /// Fails where the cell was too short for one of the shares in use.
    fn check_settled(&mut self, nodes: &[[f64; 2]]) -> Result<(), LawError> {
        let used = |known: &&[f64; 3]| nodes.iter().any(|node| node[0] == known[0]);
        for &[share, _, change] in self.known.iter().filter(used) {
            if change > UNSETTLED * self.resolution.accuracy() * self.peak {
                return Err(LawError::CellUnsettled {
                    share,
                    change,
                    length: self.cell.length(),
                });
            }
            self.error = self.error.max(change);
        }
        Ok(())
    }

    /// f* by the Illinois variant of the false position.
    fn find_saturation(&mut self) -> Result<f64, LawError> {
        if self.limit == 0.0 || self.peak == 0.0 {
            self.known.push([0.0; 3]);
            return Ok(0.0);
        }
        // Where the advance stays zero, f* is where it begins to.
        let floor = 0.01 * NO_ADVANCE * self.peak;
        let start = self.sample(0.0)?;
        if start.abs() <= floor {
            return Ok(0.0);
        }
        let sign = start.signum();
        let (mut low, mut high, mut above, mut below) = (0.0, 0.0, start.abs() - floor, 0.0);
        for step in 1..=8 {
            let share = (0.125 * f64::from(step)).min(LARGEST);
            let value = sign * self.sample(sign * share)? - floor;
            high = share;
            below = value;
            if value <= 0.0 {
                break;
            }
            (low, above) = (share, value);
        }
        if below > 0.0 {
            return Ok(sign * LARGEST * self.limit);
        }
        let (mut side, mut round) = (0, 0);
        while high - low > ROOT_ACCURACY {
            round += 1;
            let guess = if round % 4 == 0 {
                0.5 * (low + high)
            } else {
                (low * below - high * above) / (below - above)
            };
            // Not quite at an end, so that both ends close in.
            let inset = 0.02 * (high - low);
            let middle = guess.clamp(low + inset, high - inset);
            let value = sign * self.sample(sign * middle)? - floor;
            if value > 0.0 {
                (low, above) = (middle, value);
                if side == 1 {
                    below *= 0.5;
                }
                side = 1;
            } else {
                (high, below) = (middle, value);
                if side == -1 {
                    above *= 0.5;
                }
                side = -1;
            }
        }
        Ok(sign * 0.5 * (low + high) * self.limit)
    }

    /// The law with its table from `from` to `to` \[N/m\], and a little farther.
    pub fn tabulate(mut self, from: f64, to: f64) -> Result<AdvanceLaw, LawError> {
        if self.limit == 0.0 || self.peak == 0.0 {
            let zero = vec![[-1.0, 0.0], [1.0, 0.0]];
            return Ok(self.finish(zero.clone(), zero));
        }
        let from = (from / self.limit - MARGIN).max(-LARGEST);
        let to = (to / self.limit + MARGIN).min(LARGEST);
        let mut edges = vec![from, 0.0, to];
        let star = self.saturation / self.limit;
        if star != 0.0 && star > from && star < to {
            edges.push(star);
        }
        // Samples from the search for f* that do not crowd.
        edges.sort_by(f64::total_cmp);
        edges.dedup_by(|a, b| (*a - *b).abs() < 1e-3);
        let mut nodes = Vec::new();
        for &edge in &edges {
            nodes.push([edge, self.sample(edge)?]);
        }
        let mut nodes = self.refine(nodes)?;
        self.check_settled(&nodes)?;
        for node in &mut nodes {
            node[0] *= self.limit;
        }
        let lags = self.lags(&nodes)?;
        Ok(self.finish(nodes, lags))
    }

    /// Lag at a few points of the table made of `nodes`, which hold locked frictions \[N/m\] and advances.
    fn lags(&mut self, nodes: &[[f64; 2]]) -> Result<Vec<[f64; 2]>, LawError> {
        let table = Table::new(nodes.to_vec());
        let (from, to) = table.domain();
        let longest = LONGEST_LAG * self.resolution.depth();
        let flat = FLAT * self.peak / self.limit;
        (0..LAG_POINTS)
            .map(|k| {
                let friction = from + (to - from) * (k as f64 + 0.5) / LAG_POINTS as f64;
                // The table's mean slope over the width of a lag's cell: its own slope may show the cell's nodes.
                let reach = 0.02 * self.limit;
                let slope = (table.at(friction + reach).0 - table.at(friction - reach).0) / (2.0 * reach);
                if -slope < flat {
                    return Ok([friction, 0.0]);
                }
                let skew = self.cell.skew(friction, |f| table.at(f).0)?;
                Ok([friction, (-skew / slope).clamp(-longest, longest)])
            })
            .collect()
    }

    /// Bisects the pieces between `nodes` until the interpolant meets the cell in the middle of each.
    fn refine(&mut self, mut nodes: Vec<[f64; 2]>) -> Result<Vec<[f64; 2]>, LawError> {
        // Whether the piece to the right of each node still has to be looked at.
        let mut open = vec![true; nodes.len()];
        while open.contains(&true) {
            let table = Table::new(nodes.clone());
            let largest = nodes.iter().fold(0.0_f64, |m, node| m.max(node[1].abs()));
            let accuracy = self.resolution.accuracy() * largest.max(NO_ADVANCE * self.peak);
            let (mut finer, mut still_open) = (Vec::new(), Vec::new());
            for (i, &node) in nodes.iter().enumerate() {
                finer.push(node);
                let Some(next) = nodes
                    .get(i + 1)
                    .filter(|next| open[i] && next[0] - node[0] > FINEST)
                else {
                    still_open.push(false);
                    continue;
                };
                let middle = 0.5 * (node[0] + next[0]);
                let value = self.sample(middle)?;
                let unmet = (table.at(middle).0 - value).abs() > accuracy;
                finer.push([middle, value]);
                still_open.extend([unmet, unmet]);
            }
            (nodes, open) = (finer, still_open);
        }
        Ok(nodes)
    }

    fn finish(self, nodes: Vec<[f64; 2]>, lags: Vec<[f64; 2]>) -> AdvanceLaw {
        let free = self
            .known
            .iter()
            .find(|node| node[0] == 0.0)
            .map_or(0.0, |node| node[1]);
        AdvanceLaw {
            limit: self.limit,
            peak: self.peak,
            free_advance: free,
            saturation: self.saturation,
            statistics: LawStatistics {
                cell_passes: self.cell.passes,
                nodes: nodes.len(),
                cell_error: self.error,
            },
            table: Table::new(nodes),
            lag: Table::new(lags),
        }
    }
}
