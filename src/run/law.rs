//! A run by the pass law: many passes at the cost of one.

use std::thread;

use cable_dem::{DuctedCable, Order};
use ground_field::DuctMotion;
use pass_law::{Evolution, PassLaw, Resolution};

use super::passes::simulate;
use crate::answer::{
    ErrorEstimate, ErrorShares, ForceProfile, LEVEL, PassRecord, RestraintRecord, Saturation, Stage, larger,
    listed,
};
use crate::cable::cable;
use crate::ground::road::approach;
use crate::plan::{CableMethod, LAW_ERROR, Levels, Plan};
use crate::scene::{End, Scene};
use crate::shown::percent;
use crate::{Cost, Error, Progress};

/// Nodes per depth of the duct in the law's cells at a tolerance of 1 % or less, and above.
const NODES_FINE: f64 = 12.0;
const NODES_COARSE: f64 = 6.0;
/// The law's error is measured on the first passes, simulated: as many as this number of node updates (0.2 s) allows, from 12 to 200.
const CHECK_NODE_UPDATES: f64 = 1.2e7;
const CHECKED_PASSES: (u64, u64) = (12, 200);
/// A check that takes this many times as long is not made.
const MOST_CHECKS: f64 = 10.0;
/// Level of the mesh for it: twelve nodes a depth.
const CHECK_LEVEL: usize = 2;
/// Forces below this share of the last one count as nothing when errors are compared.
const SMALL_FORCE: f64 = 0.1;
/// First pass that the law resolves; the simulation gives the passes before it.
const FIRST_GOOD: u64 = 10;

/// Answer of the law.
pub struct LawRun {
    pub node_spacing: f64,
    pub vehicle_step: f64,
    pub passes: Vec<PassRecord>,
    pub saturation: Option<Saturation>,
    pub force_profile: ForceProfile,
    pub restraints: Vec<RestraintRecord>,
    pub stages: Vec<Stage>,
    pub error: ErrorEstimate,
    pub cost: Cost,
    pub warnings: Vec<String>,
}

/// Runs all passes of `plan` by the law, and looks at the cable after the passes `stages`.
pub fn run(plan: &Plan<'_>, stages: &[u64]) -> Result<LawRun, Error> {
    thread::scope(|scope| {
        let check = scope.spawn(|| first_passes(plan.scene, &plan.ground.motions));
        evolve(plan, stages, || {
            // A panic of the other thread goes on in this one.
            check
                .join()
                .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        })
    })
}

/// The first passes by simulation; `None` where even these take long.
fn first_passes(scene: &Scene, motions: &[DuctMotion]) -> Result<Option<Vec<PassRecord>>, Error> {
    let mut scene = scene.clone();
    (scene.solver.node_spacing, scene.solver.vehicle_step) = (None, None);
    let levels = Levels::new(&scene, approach(&scene, motions)?);
    let (fewest, most) = CHECKED_PASSES;
    let affordable = CHECK_NODE_UPDATES / levels.node_updates(CHECK_LEVEL, 1);
    if affordable * MOST_CHECKS < fewest as f64 {
        return Ok(None);
    }
    scene.traffic.passes = (affordable as u64).clamp(fewest, most).min(scene.traffic.passes);
    let passes = simulate(
        &scene,
        CableMethod::QuasiStatic,
        motions,
        levels.mesh(CHECK_LEVEL)?,
        &[],
        Progress::default(),
    )?;
    let records = passes.outcomes.iter().zip(1..);
    Ok(Some(
        records
            .map(|(outcome, pass)| PassRecord::new(pass, outcome))
            .collect(),
    ))
}

/// The law, held against the first passes that `checked` brings.
fn evolve(
    plan: &Plan<'_>,
    stages: &[u64],
    checked: impl FnOnce() -> Result<Option<Vec<PassRecord>>, Error>,
) -> Result<LawRun, Error> {
    let scene = plan.scene;
    let motions = &plan.ground.motions;
    let cable = cable(scene)?;
    let traffic = traffic(scene, motions);
    let nodes = if scene.solver.tolerance <= 0.01 {
        NODES_FINE
    } else {
        NODES_COARSE
    };
    let passes = listed(scene.traffic.passes);
    let at = |nodes: f64| -> Result<(PassLaw, Evolution, Resolution), Error> {
        let resolution = Resolution::new(scene.duct.depth)?.with_nodes_per_depth(nodes)?;
        let law = PassLaw::new(&cable, &traffic, resolution)?;
        let evolution = law.run(&passes)?;
        Ok((law, evolution, resolution))
    };
    let (law, evolution, resolution) = at(nodes)?;
    let (_, coarse, _) = at(0.5 * nodes)?;

    let mut warnings: Vec<String> = law.concerns().iter().map(ToString::to_string).collect();
    if evolution.left_table {
        warnings.push("the locked friction left the range in which the law was tabulated".into());
    }
    let swing = swing(scene);
    let mut records: Vec<PassRecord> = evolution.records.iter().map(|record| of(record, swing)).collect();
    let share = difference(
        &records,
        &coarse
            .records
            .iter()
            .map(|record| of(record, swing))
            .collect::<Vec<_>>(),
    );
    let mut measured = None;
    if let Some(mut simulated) = checked()? {
        let good = simulated.partition_point(|record| record.pass < FIRST_GOOD);
        let checked = simulated.split_off(good);
        // Before that pass the law is rough, and the simulation knows better.
        let early = records.partition_point(|record| record.pass < FIRST_GOOD);
        records.splice(..early.min(simulated.len()), simulated);
        let wanted: Vec<u64> = checked.iter().map(|record| record.pass).collect();
        if let Some(&last) = wanted.last() {
            let by_law = law.run(&wanted)?;
            let by_law: Vec<PassRecord> = by_law.records.iter().map(|record| of(record, swing)).collect();
            measured = Some((difference(&checked, &by_law), last));
        }
    } else {
        warnings.push("the first nine passes are rough by the pass law".into());
    }
    let law_error = measured.map_or(LAW_ERROR, |(error, _)| error.max(LAW_ERROR));
    let parts = ErrorShares {
        mesh: 0.5 * share,
        ground: plan.ground.accuracy,
        inertia: plan.choice.inertia,
        passes: law_error,
        law: law_error,
        ..ErrorShares::default()
    };
    let relative = parts.mesh + parts.ground + parts.inertia + parts.passes;
    if relative > scene.solver.tolerance {
        let (error, tolerance) = (percent(relative), percent(scene.solver.tolerance));
        warnings.push(format!(
            "the estimated error of {error} exceeds the tolerance of {tolerance}"
        ));
    }
    Ok(LawRun {
        node_spacing: resolution.node_spacing(),
        vehicle_step: resolution.vehicle_step(),
        saturation: saturation(scene, &law),
        force_profile: force_profile(&cable, &evolution),
        restraints: restraints(&cable, &evolution),
        stages: self::stages(&cable, &law, scene, stages)?,
        error: ErrorEstimate {
            relative,
            method: format!(
                "mesh {}: half the change on cells twice as coarse; ground {}, inertia {}; pass law {}: {}",
                percent(parts.mesh),
                percent(parts.ground),
                percent(parts.inertia),
                percent(law_error),
                match measured {
                    Some((_, last)) => format!(
                        "its difference from the simulated passes {FIRST_GOOD} to {last}, counted as at least 1 %"
                    ),
                    None => "from the tenth pass on, where it was not measured on this scene".into(),
                }
            ),
            parts,
        },
        cost: Cost::of_law(evolution.statistics),
        passes: records,
        warnings,
    })
}

/// The records after `passes`, ascending, with `nodes_per_depth` in the law's cells.
#[cfg(feature = "calibrate")]
pub fn records(
    scene: &Scene,
    motions: &[DuctMotion],
    nodes_per_depth: f64,
    passes: &[u64],
) -> Result<Vec<PassRecord>, Error> {
    let resolution = Resolution::new(scene.duct.depth)?.with_nodes_per_depth(nodes_per_depth)?;
    let law = PassLaw::new(&cable(scene)?, &traffic(scene, motions), resolution)?;
    let swing = swing(scene);
    Ok(law
        .run(passes)?
        .records
        .iter()
        .map(|record| of(record, swing))
        .collect())
}

/// The motions under vehicles that do drive, with their shares.
fn traffic(scene: &Scene, motions: &[DuctMotion]) -> Vec<(DuctMotion, f64)> {
    motions
        .iter()
        .cloned()
        .zip(scene.vehicles.iter().map(|vehicle| vehicle.share))
        .filter(|(_, share)| *share > 0.0)
        .collect()
}

/// Traffic in another order than evenly interleaved leaves another force at the very end: the mean is shown.
fn swing(scene: &Scene) -> f64 {
    f64::from(u8::from(scene.traffic.order == Order::Interleaved))
}

fn of(record: &pass_law::PassRecord, swing: f64) -> PassRecord {
    PassRecord {
        pass: record.pass,
        downstream_force_n: record.downstream_force - (1.0 - swing) * record.downstream_swing,
        downstream_peak_n: record.downstream_peak,
        upstream_force_n: record.upstream_force - (1.0 - swing) * record.upstream_swing,
        upstream_peak_n: record.upstream_peak,
        max_compression_n: record.max_compression,
        upstream_displacement_m: record.upstream_displacement,
        downstream_displacement_m: record.downstream_displacement,
        dissipated_energy_j: None,
    }
}

/// Largest difference of a force from the tenth pass on, as a share of the largest force after that pass, or of a tenth of
/// the last one.
fn difference(a: &[PassRecord], b: &[PassRecord]) -> f64 {
    let forces = |r: &PassRecord| [r.upstream_force_n, r.downstream_force_n, r.max_compression_n];
    let largest =
        |record: &PassRecord, least: f64| forces(record).into_iter().map(f64::abs).fold(least, f64::max);
    let floor = a.last().map_or(0.0, |last| SMALL_FORCE * largest(last, 0.0));
    a.iter()
        .zip(b)
        .filter(|(record, _)| record.pass >= FIRST_GOOD || a.len() == 1)
        .flat_map(|(a, b)| {
            let scale = largest(a, floor);
            forces(a)
                .into_iter()
                .zip(forces(b))
                .filter(|(a, b)| a != b)
                .map(move |(a, b)| (a - b).abs() / scale)
        })
        .fold(0.0, f64::max)
}

/// Saturated force at the end that is held, the larger of two.
fn saturation(scene: &Scene, law: &PassLaw) -> Option<Saturation> {
    let saturation = law.saturation()?;
    let at = |end: End, force: f64| if end == End::Free { 0.0 } else { force };
    let upstream = at(scene.ends.upstream, saturation.upstream_force);
    let downstream = at(scene.ends.downstream, saturation.downstream_force);
    let force_n = larger(downstream, upstream);
    let passes = saturation.passes_to(LEVEL)?;
    (force_n != 0.0 && passes.is_finite()).then(|| Saturation {
        force_n,
        passes_to_95_percent: passes.ceil() as u64,
    })
}

fn force_profile(cable: &DuctedCable, evolution: &Evolution) -> ForceProfile {
    let pairs = || {
        evolution
            .positions
            .windows(2)
            .zip(evolution.displacement.windows(2))
    };
    ForceProfile {
        positions_m: pairs().map(|(x, _)| 0.5 * (x[0] + x[1])).collect(),
        force_n: pairs()
            .map(|(x, u)| cable.axial_stiffness() * (u[0] - u[1]) / (x[1] - x[0]))
            .collect(),
    }
}

fn restraints(cable: &DuctedCable, evolution: &Evolution) -> Vec<RestraintRecord> {
    cable
        .restraints()
        .iter()
        .map(|restraint| {
            let right = evolution
                .positions
                .partition_point(|&x| x < restraint.position)
                .clamp(1, evolution.positions.len() - 1);
            let (x, u) = (
                &evolution.positions[right - 1..=right],
                &evolution.displacement[right - 1..=right],
            );
            let share = (restraint.position - x[0]) / (x[1] - x[0]);
            RestraintRecord {
                position_m: restraint.position,
                stiffness_n_per_m: restraint.stiffness,
                force_n: restraint.stiffness * (u[0] + share * (u[1] - u[0])),
            }
        })
        .collect()
}

/// The cable after each of the passes `wanted` that the traffic has.
fn stages(cable: &DuctedCable, law: &PassLaw, scene: &Scene, wanted: &[u64]) -> Result<Vec<Stage>, Error> {
    wanted
        .iter()
        .filter(|pass| (1..=scene.traffic.passes).contains(*pass))
        .map(|&pass| {
            Ok(Stage {
                pass,
                force_profile: force_profile(cable, &law.run(&[pass])?),
                friction: None,
            })
        })
        .collect()
}
