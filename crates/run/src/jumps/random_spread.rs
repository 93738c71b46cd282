//! Vehicles in random order: how far their forces scatter around the mean.
//!
//! Many passes later the cable lies as the mean of the traffic has left it, and only the last few
//! tens of vehicles scatter around that. So a few short random runs from there show the spread, on
//! the mesh that the jumps were found on: it is an estimate. Their own mean is that of a coarse
//! mesh and of some more passes, so the spread is laid around the mean of the answer.

use cable_dem::{CableState, Order};

use crate::answer::{Quantiles, RandomSpread, larger};
use crate::passes::{Passes, Simulation, Task};
use crate::refine::Work;
use creepage_plan::{Error, cable::traffic};

/// Random runs, their passes, and how many of these forget the order before.
const RUNS: u64 = 8;
const PASSES: usize = 90;
const FORGOTTEN: usize = 30;

/// The spread of the forces around the last ones of the `answer`, from runs that begin in `state`.
pub fn spread(
    task: &Task<'_>,
    state: &CableState,
    answer: &Passes,
    work: &Work,
) -> Result<Option<RandomSpread>, Error> {
    let (Order::Random { seed }, Some(last)) = (task.scene.order(), answer.records.last()) else {
        return Ok(None);
    };
    let mut simulation = Simulation::new(task)?;
    let mut forces = [Vec::new(), Vec::new()];
    for run in 0..RUNS {
        let mut state = state.clone();
        let seed = seed.wrapping_add(run);
        let order = traffic(task.scene, Order::Random { seed })?;
        for (number, vehicle) in order.take(PASSES).enumerate() {
            let force = simulation.pass(vehicle, None, &mut state)?.force;
            if number >= FORGOTTEN {
                forces[0].push(force.downstream);
                forces[1].push(force.upstream);
            }
        }
    }
    let ([downstream, upstream], mean) = (forces, last.outcome.force);
    *work.borrow_mut() += simulation.passes.statistics;
    Ok(Some(RandomSpread {
        downstream: quantiles(downstream, mean.downstream),
        upstream: quantiles(upstream, mean.upstream),
    }))
}

/// Of `forces`, moved so that their mean is `mean`.
fn quantiles(mut forces: Vec<f64>, mean: f64) -> Quantiles {
    let off = mean - forces.iter().sum::<f64>() / forces.len() as f64;
    forces.sort_by(f64::total_cmp);
    let at = |share: f64| forces[(share * (forces.len() - 1) as f64).round() as usize] + off;
    Quantiles {
        q05_n: at(0.05),
        q50_n: at(0.5),
        q95_n: at(0.95),
        max_n: larger(at(0.0), at(1.0)),
    }
}
