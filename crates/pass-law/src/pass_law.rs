//! The law on a duct: which ends, how many passes, what forces.

use cable_dem::{DuctedCable, End};
use ground_field::DuctMotion;

use crate::advance::Draft;
use crate::grid::graded;
use crate::layer::{Layer, Piece, Side};
use crate::slow::{SlowEnd, SlowProblem};
use crate::{LawError, MixedLaw, Resolution};

/// Finest spacing of points, in depths.
const FINEST_DEPTHS: f64 = 0.4;

/// What a law cost, before any evolution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Preparation {
    /// Passes over cells, for G.
    pub cell_passes: usize,
    /// Passes over short pieces, for the ends.
    pub end_passes: usize,
}

/// The homogenised law of one cable in one duct under one mix of traffic.
#[derive(Debug, Clone)]
pub struct PassLaw {
    pub(crate) cable: DuctedCable,
    pub(crate) law: MixedLaw,
    pub(crate) resolution: Resolution,
    pub(crate) upstream: Layer,
    pub(crate) downstream: Layer,
    preparation: Preparation,
}

impl PassLaw {
    /// The law of `cable` under `traffic`: the duct's motion under each vehicle, with the vehicle's share of the passes (any
    /// positive weights). The vehicles' advances and the ends' layers are computed here, once.
    ///
    /// # Errors
    ///
    /// As for [`crate::AdvanceLaw::new`] and [`MixedLaw::new`]; [`LawError::EndUnsettled`] where the layer at an end does not
    /// become steady, [`LawError::FarReaching`] where friction is so small that a vehicle's effect reaches too far.
    pub fn new(
        cable: &DuctedCable,
        traffic: &[(DuctMotion, f64)],
        resolution: Resolution,
    ) -> Result<Self, LawError> {
        for (motion, _) in traffic {
            resolution.check_reach(cable, motion.peak_longitudinal())?;
        }
        let drafts = traffic
            .iter()
            .map(|(motion, _)| Draft::new(cable, motion, resolution))
            .collect::<Result<Vec<_>, _>>()?;
        // Every table covers what the others can lock in.
        let from = drafts.iter().map(|draft| draft.saturation).fold(0.0, f64::min);
        let to = drafts.iter().map(|draft| draft.saturation).fold(0.0, f64::max);
        let parts = drafts
            .into_iter()
            .zip(traffic)
            .map(|(draft, (_, share))| Ok((*share, draft.tabulate(from, to)?)))
            .collect::<Result<Vec<_>, LawError>>()?;
        let law = MixedLaw::new(parts)?;
        let mut preparation = Preparation {
            cell_passes: law
                .parts()
                .iter()
                .map(|(_, law)| law.statistics().cell_passes)
                .sum(),
            end_passes: 0,
        };
        let (upstream, downstream) = if law.friction_limit() == 0.0 {
            (Layer::none(), Layer::none())
        } else {
            let mut piece = Piece::new(cable, traffic, resolution)?;
            let layers = layers(&mut piece, &law, cable)?;
            preparation.end_passes = piece.passes;
            layers
        };
        Ok(Self {
            cable: cable.clone(),
            law,
            resolution,
            upstream,
            downstream,
            preparation,
        })
    }

    /// Mean advance per pass of the traffic.
    pub fn law(&self) -> &MixedLaw {
        &self.law
    }

    /// The cable.
    pub fn cable(&self) -> &DuctedCable {
        &self.cable
    }

    /// What the law cost.
    pub fn preparation(&self) -> Preparation {
        self.preparation
    }

    pub(crate) fn problem(&self) -> SlowProblem {
        let limit = self.law.friction_limit();
        let end = |layer: &Layer, end: End| SlowEnd {
            stiffness: end.stiffness(),
            inset: if end.stiffness().is_none() {
                0.0
            } else {
                inset(layer, limit)
            },
            layer: layer.clone(),
        };
        let upstream = end(&self.upstream, self.cable.upstream());
        let downstream = end(&self.downstream, self.cable.downstream());
        let length = self.cable.length();
        let (first, last) = (
            upstream.inset.min(0.2 * length),
            length - downstream.inset.min(0.2 * length),
        );
        let mut breaks = vec![first, last];
        let clamps: Vec<(f64, f64)> = self
            .cable
            .restraints()
            .iter()
            .map(|r| (r.position.clamp(first, last), r.stiffness))
            .collect();
        breaks.extend(clamps.iter().map(|clamp| clamp.0));
        breaks.sort_by(f64::total_cmp);
        breaks.dedup_by(|a, b| (*a - *b).abs() < 1e-9 * length);
        let points = graded(&breaks, FINEST_DEPTHS * self.resolution.depth());
        let n = points.len() - 1;
        let weights = (0..=n)
            .map(|i| 0.5 * (points[(i + 1).min(n)] - points[i.saturating_sub(1)]))
            .collect();
        let mut springs = vec![0.0; n + 1];
        for (position, stiffness) in clamps {
            let nearest = points.partition_point(|&x| x < position - 1e-9 * length).min(n);
            springs[nearest] += stiffness;
        }
        SlowProblem {
            law: self.law.clone(),
            axial_stiffness: self.cable.axial_stiffness(),
            points,
            weights,
            springs,
            upstream,
            downstream,
        }
    }
}

/// Layers of both ends, as they are held.
fn layers(piece: &mut Piece<'_>, law: &MixedLaw, cable: &DuctedCable) -> Result<(Layer, Layer), LawError> {
    let ends = [
        (Side::Upstream, cable.upstream()),
        (Side::Downstream, cable.downstream()),
    ];
    let moving = if ends.iter().any(|(_, end)| end.stiffness().is_some()) {
        piece.moving(law)?
    } else {
        [Layer::none(), Layer::none()]
    };
    let mut layers = Vec::new();
    for ((side, end), moving) in ends.into_iter().zip(moving) {
        layers.push(match end {
            End::Free => moving,
            End::Fixed => piece.held(law, side, end)?,
            End::Spring(_) => {
                let held = piece.held(law, side, end)?;
                moving.shifted_to(&held, law.saturation())
            }
        });
    }
    let downstream = layers.pop().unwrap_or_else(Layer::none);
    let upstream = layers.pop().unwrap_or_else(Layer::none);
    Ok((upstream, downstream))
}

/// How far S falls with f̄ \[m\]: where the slow problem must end before the cable does.
fn inset(layer: &Layer, limit: f64) -> f64 {
    let steepest = (-20..=20)
        .map(|k| layer.force.at(0.05 * f64::from(k) * limit).1)
        .fold(0.0, f64::min);
    -steepest
}
