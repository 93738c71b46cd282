//! Map 2: plain Newton against the quasi-static solver, over shape factor b and vehicle step.
//!
//! Second pass over 15 m of duct with nodes 0.2 m apart. Both solve the same steps of the same chain, from the ground at rest to the ground at rest, and so does what is right:
//! Newton's method damped by a line search on the step's convex energy, which always arrives. Plain Newton takes full steps
//! and goes on with what it has after `PLAIN_STEPS`, as many programs do.

use std::path::Path;

use cable_dem::{CableError, CableState, DuctedCable, FrictionLaw, Mesh, Passage, QuasiStatic};
use creepage::figure::Panels;
use ground_field::DuctMotion;

use crate::Failure;
use crate::cable_map::{LIMIT, cable, judge, panels, silent, truck, unanswered};
use crate::map::{Cell, DEPTH, Grid, Outcome, decades};

const LENGTH: f64 = 15.0;
const SPACING: f64 = 0.2;
const APPROACH: f64 = 15.0;
const PASSES: usize = 2;
const PLAIN_STEPS: usize = 25;
const DAMPED_STEPS: usize = 2000;

/// A whole chain of elastic-plastic nodes, free upstream and fixed downstream.
struct Chain {
    stiffness: f64,
    limit: f64,
    /// q b/2 \[N/m²\].
    slope: f64,
    tributary: Vec<f64>,
    displacement: Vec<f64>,
    friction: Vec<f64>,
}

impl Chain {
    fn new(cable: &DuctedCable, mesh: &Mesh) -> Self {
        let nodes = mesh.nodes();
        let friction = cable.friction();
        Self {
            stiffness: cable.axial_stiffness() / mesh.spacing(),
            limit: friction.limit(),
            slope: 0.5 * friction.limit() * friction.law().shape_factor(),
            tributary: (0..nodes).map(|i| mesh.tributary_length(i)).collect(),
            displacement: vec![0.0; nodes],
            friction: vec![0.0; nodes],
        }
    }

    /// Friction after the duct has moved on by `advance` and the cable to `u`, and the forces out of balance.
    fn balance(&self, u: &[f64], advance: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let last = u.len() - 1;
        let friction: Vec<f64> = (0..=last)
            .map(|i| {
                let slip = advance[i] - (u[i] - self.displacement[i]);
                (self.friction[i] + self.slope * slip).clamp(-self.limit, self.limit)
            })
            .collect();
        let mut force: Vec<f64> = (0..=last).map(|i| self.tributary[i] * friction[i]).collect();
        for i in 0..last {
            let tension = self.stiffness * (u[i + 1] - u[i]);
            force[i] += tension;
            force[i + 1] -= tension;
        }
        force[last] = 0.0;
        (friction, force)
    }

    /// Newton's direction: elimination on the tangent stiffness.
    fn direction(&self, friction: &[f64], force: &[f64]) -> Vec<f64> {
        let last = force.len() - 1;
        let (mut upper, mut right) = (vec![0.0; last + 1], vec![0.0; last + 1]);
        for i in 0..last {
            let sheath = if friction[i].abs() < self.limit {
                self.slope * self.tributary[i]
            } else {
                0.0
            };
            let (above, carried, neighbours) = if i > 0 {
                (upper[i - 1], right[i - 1], 2.0)
            } else {
                (0.0, 0.0, 1.0)
            };
            let pivot = neighbours * self.stiffness + sheath - self.stiffness * above;
            upper[i] = self.stiffness / pivot;
            right[i] = (force[i] + self.stiffness * carried) / pivot;
        }
        for i in (0..last).rev() {
            right[i] += upper[i] * right[i + 1];
        }
        right
    }

    /// One step of the vehicle; false if a damped one did not arrive.
    fn step(&mut self, advance: &[f64], damped: bool) -> bool {
        let mut u = self.displacement.clone();
        let steps = if damped { DAMPED_STEPS } else { PLAIN_STEPS };
        let scale = |u: &[f64]| u.iter().chain(advance).fold(0.0_f64, |m, v| m.max(v.abs()));
        let mut arrived = false;
        for _ in 0..steps {
            let (friction, force) = self.balance(&u, advance);
            let worst = force.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
            let rounding = 64.0 * f64::EPSILON * self.stiffness * scale(&u)
                + 16.0 * f64::EPSILON * self.slope * SPACING * scale(&u);
            if worst <= 1e-7 * self.limit * SPACING + rounding {
                arrived = true;
                break;
            }
            let direction = self.direction(&friction, &force);
            // Forces along the direction, which fall as the energy is convex: its minimum is where they change sign.
            let along = |share: f64| -> f64 {
                let tried: Vec<f64> = u.iter().zip(&direction).map(|(u, d)| u + share * d).collect();
                let force = self.balance(&tried, advance).1;
                force.iter().zip(&direction).map(|(f, d)| f * d).sum()
            };
            let mut share = 1.0;
            if damped && along(1.0) < 0.0 {
                let (mut low, mut high) = (0.0, 1.0);
                let start = along(0.0);
                for _ in 0..50 {
                    share = 0.5 * (low + high);
                    if along(share).abs() <= 0.1 * start {
                        break;
                    }
                    if along(share) > 0.0 {
                        low = share;
                    } else {
                        high = share;
                    }
                }
            }
            for (u, d) in u.iter_mut().zip(&direction) {
                *u += share * d;
            }
        }
        self.friction = self.balance(&u, advance).0;
        self.displacement = u;
        arrived || !damped
    }

    /// Force on the fixed end after all passes \[N\]; none if a damped step did not arrive.
    fn run(mut self, mesh: &Mesh, motion: &DuctMotion, damped: bool) -> Option<f64> {
        let nodes = self.displacement.len();
        // The library's positions: a step apart, on the duct's start, to beyond the approach on either side.
        let whole = |length: f64| (length / mesh.vehicle_step() * (1.0 - 1e-9)).ceil();
        let outside = whole(APPROACH);
        let steps = (whole(LENGTH) + 2.0 * outside) as usize;
        let duct = |step: usize| -> Vec<f64> {
            let vehicle = mesh.vehicle_step() * (step as f64 - outside);
            (0..nodes)
                .map(|i| motion.longitudinal(mesh.spacing() * i as f64 - vehicle))
                .collect()
        };
        // Before the vehicle comes and after it has left the ground is at rest.
        let rest = || std::iter::once(vec![0.0; nodes]);
        let path: Vec<Vec<f64>> = rest().chain((0..=steps).map(duct)).chain(rest()).collect();
        for _ in 0..PASSES {
            for pair in path.windows(2) {
                let advance: Vec<f64> = pair[1].iter().zip(&pair[0]).map(|(new, old)| new - old).collect();
                if !self.step(&advance, damped) {
                    return None;
                }
            }
        }
        let (u, last) = (&self.displacement, nodes - 1);
        Some(self.stiffness * (u[last - 1] - u[last]) + self.tributary[last] * self.friction[last])
    }
}

/// Outcomes of one scene by plain Newton and by the library; the step is a whole part or multiple of the spacing.
fn outcomes(shape_factor: f64, step: f64, motion: &DuctMotion) -> Result<[Cell; 2], CableError> {
    let cable = cable(LENGTH, FrictionLaw::ElasticPlastic { shape_factor })?;
    let mesh = Mesh::new(LENGTH, SPACING, step)?;
    let chain = || Chain::new(&cable, &mesh);
    let Some(expected) = chain().run(&mesh, motion, true) else {
        return Err(CableError::NoConvergence {
            vehicle_position: f64::NAN,
            violation: f64::NAN,
        });
    };
    // If nothing slips nothing is left: forces below what friction holds on a centimetre count as nothing.
    let scale = expected.abs().max(0.01 * LIMIT);
    let judge = |force: f64| judge(force, expected, scale, false);
    let library = || {
        let passage = Passage::new(&cable, &mesh, motion, APPROACH)?;
        let mut solver = QuasiStatic::new(cable.clone(), mesh)?;
        let mut state = CableState::at_rest(&mesh);
        (0..PASSES).try_fold(0.0, |_, _| {
            Ok(solver.pass(&passage, &mut state)?.force.downstream)
        })
    };
    Ok([
        chain()
            .run(&mesh, motion, false)
            .map_or_else(|| silent(Outcome::Failed, expected), judge),
        library().map_or_else(|error| silent(unanswered(&error), expected), judge),
    ])
}

/// The map of plain Newton and of the library with 2^`finest`…1 steps a spacing and up to four spacings a step, and `factors`
/// shape factors; an error where damped Newton does not arrive, so that nothing is known to be right.
pub fn map(finest: i32, factors: usize) -> Result<Grid<[Cell; 2]>, Failure> {
    let motion = truck(DEPTH, 10.0)?;
    let steps = (-finest..=2).map(|k| SPACING * 2_f64.powi(k)).collect();
    let cell = |_, factor, step| outcomes(factor, step, &motion);
    Ok(Grid::fill(decades(4.0, 12.0, factors), steps, cell)?)
}

pub fn run(out: &Path) -> Result<(), Failure> {
    let grid = map(3, 13)?;
    let axes = [grid.x_axis("shape factor b, 1/m"), grid.y_axis("vehicle step, m")];
    let (charts, rows) = panels(&grid, ["plain Newton", "quasi-static solver"], &axes);
    let figure = Panels::new(
        "Implicit steps: force after the second pass over 15 m, by shape factor and vehicle step",
    )
    .columns(2)
    .panel_size(700.0, 480.0);
    let figure = charts.into_iter().fold(figure, Panels::with);
    let table = "map,shape_factor_per_m,vehicle_step_m,outcome,force_n,right_force_n\n".to_owned() + &rows;
    crate::table::write(&out.join("stability-implicit.csv"), &table)?;
    std::fs::write(out.join("stability-implicit.svg"), figure.to_svg()?)?;
    Ok(())
}
