//! Map 1: the explicit solver over time step and shape factor b, and over time step and speed.
//!
//! First pass over 15 m of duct with nodes 0.2 m apart. Right is the force of an unconditionally stable solver with the same
//! law: quasi-static for the elastic-plastic law, implicit with the same time step for the sigmoid, whose answer is one
//! of the time step. Without guards neither the step limits nor the energy are checked. What the sigmoid has left counts as the
//! vehicle leaves, before the cable comes to rest: the law says nothing of that step, which the solver takes as an elastic-plastic one.

use std::path::Path;

use cable_dem::{
    CableError, CableState, Explicit, ExplicitOptions, FrictionLaw, Mesh, MovingDuct, Passage, QuasiStatic,
    StepLimits,
};
use creepage::figure::{Chart, Panels, Series};
use ground_field::DuctMotion;

use super::sigmoid::Chain;
use crate::Failure;
use crate::cable_map::{EA, LIMIT, MASS, cable, judge, panels, silent, truck, unanswered};
use crate::map::{Cell, DEPTH, Grid, decades};

const LENGTH: f64 = 15.0;
const SPACING: f64 = 0.2;
const APPROACH: f64 = 15.0;
/// Speed of the maps over b \[m/s\]: fast, so that passes are short; inertia changes the force by 0.1 %.
const SPEED: f64 = 100.0 / 3.6;
/// Shape factor of the map over speed \[1/m\].
const SHAPE_FACTOR: f64 = 1e8;

/// Which law is mapped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    ElasticPlastic,
    Sigmoid,
}

impl Law {
    fn with(self, shape_factor: f64) -> FrictionLaw {
        match self {
            Self::ElasticPlastic => FrictionLaw::ElasticPlastic { shape_factor },
            Self::Sigmoid => FrictionLaw::Sigmoid { shape_factor },
        }
    }

    fn name(self) -> &'static str {
        self.with(1.0).name()
    }
}

/// The mesh on which the vehicle advances by a `parts`-th of the spacing a step.
fn mesh(parts: f64) -> Result<Mesh, CableError> {
    Mesh::new(LENGTH, SPACING, SPACING / parts * (1.0 + 1e-9))
}

/// The right force \[N\]; `parts` time steps take the vehicle from node to node.
fn expected(law: FrictionLaw, parts: f64, motion: &DuctMotion) -> Result<f64, CableError> {
    if let FrictionLaw::Sigmoid { shape_factor } = law {
        let chain = Chain {
            elements: (LENGTH / SPACING).round() as usize,
            spacing: SPACING,
            axial_stiffness: EA,
            limit: LIMIT,
            shape_factor,
        };
        return chain.force(motion, APPROACH, SPACING / parts / motion.velocity());
    }
    let (cable, mesh) = (cable(LENGTH, law)?, mesh(2.0)?);
    let passage = Passage::new(&cable, &mesh, motion, APPROACH)?;
    let outcome = QuasiStatic::new(cable, mesh)?.pass(&passage, &mut CableState::at_rest(&mesh))?;
    Ok(outcome.force.downstream)
}

/// Outcomes of one run without guards and with them; `parts` time steps take the vehicle from node to node.
fn outcomes(law: FrictionLaw, parts: f64, motion: &DuctMotion) -> Result<[Cell; 2], CableError> {
    let expected = expected(law, parts, motion)?;
    let (cable, mesh) = (cable(LENGTH, law)?, mesh(2.0)?);
    let duct = MovingDuct::new(&cable, &mesh, motion, APPROACH)?;
    // The scale is what friction could do at most: with a leaking sigmoid hardly any force is left to be a share of.
    let scale = expected.abs().max(0.02 * LIMIT * LENGTH);
    Ok([false, true].map(|guarded| {
        let options = ExplicitOptions {
            time_step: Some(SPACING / parts / duct.speed()),
            check_limits: guarded,
            check_energy: guarded,
            ..ExplicitOptions::default()
        };
        let run = Explicit::new(cable.clone(), mesh, MASS, options)
            .and_then(|mut solver| solver.pass(&duct, &mut CableState::at_rest(&mesh)));
        match run {
            Ok(outcome) => {
                let at_rest = law.has_memory().then_some(outcome.pass.force);
                let force = at_rest.unwrap_or(outcome.force_before_rest);
                judge(force.downstream, expected, scale, false)
            }
            Err(error) => silent(unanswered(&error), expected),
        }
    }))
}

/// Time steps in which the vehicle gets from node to node, ascending in length: at most `finest`.
fn parts(finest: u32, count: usize) -> Vec<f64> {
    let all = decades(f64::from(finest).log10(), 3.0_f64.log10(), count);
    all.into_iter().map(f64::round).collect()
}

/// The same grid over time steps \[s\].
fn over_time_steps(mut grid: Grid<[Cell; 2]>, speed: f64) -> Grid<[Cell; 2]> {
    for parts in &mut grid.x {
        *parts = SPACING / *parts / speed;
    }
    grid
}

/// The map over time steps and shape factors, without and with guards.
pub fn over_shape_factor(law: Law, steps: usize, factors: usize) -> Result<Grid<[Cell; 2]>, Failure> {
    let motion = truck(DEPTH, SPEED)?;
    let cell = |_, parts, factor| outcomes(law.with(factor), parts, &motion);
    let grid = Grid::fill(parts(160, steps), decades(5.0, 10.5, factors), cell)?;
    Ok(over_time_steps(grid, SPEED))
}

/// The map over time steps and speeds, without and with guards.
pub fn over_speed(law: Law, steps: usize, speeds: usize) -> Result<Grid<[Cell; 2]>, Failure> {
    let grid = Grid::fill(parts(100, steps), decades(1.0, 2.0, speeds), |_, parts, speed| {
        // The time step of the column, whatever the speed.
        let parts = (parts * SPEED / speed).max(1.0).round();
        outcomes(law.with(SHAPE_FACTOR), parts, &truck(DEPTH, speed)?).map_err(Failure::from)
    })?;
    Ok(over_time_steps(grid, SPEED))
}

/// Step limits of the scene for one shape factor.
fn limits(law: Law, shape_factor: f64) -> Result<StepLimits, CableError> {
    let cable = cable(LENGTH, law.with(shape_factor))?;
    Ok(*Explicit::new(cable, mesh(2.0)?, MASS, ExplicitOptions::default())?.limits())
}

/// The limits as lines on a chart: in the time step, over `values` of what runs along y.
fn lines(chart: Chart, limits: &[(StepLimits, f64)]) -> Chart {
    let line = |of: fn(&StepLimits) -> f64| -> Vec<(f64, f64)> {
        let points = limits.iter().map(|(limits, y)| (of(limits), *y));
        points
            .filter(|(limit, _)| (3e-5..2.9e-3).contains(limit))
            .collect()
    };
    chart
        .with(Series::line("elastic limit", line(|limits| limits.elastic)))
        .with(Series::line("friction limit", line(|limits| limits.friction)).dashed())
        .with(Series::line("both together", line(StepLimits::together)).dotted())
}

pub fn run(out: &Path) -> Result<(), Failure> {
    let mut figure = Panels::new("Explicit solver: force after one pass over 15 m, by time step")
        .columns(2)
        .panel_size(700.0, 480.0);
    let mut table =
        String::from("map,time_step_s,shape_factor_per_m_or_speed_m_per_s,outcome,force_n,right_force_n\n");
    let mut add = |name: &str, label: &str, grid: &Grid<[Cell; 2]>, limits: &[(StepLimits, f64)]| {
        let names = ["off", "on"].map(|guards| format!("{name}, guards {guards}"));
        let axes = [grid.x_axis("time step, s"), grid.y_axis(label)];
        let (charts, rows) = panels(grid, [&names[0], &names[1]], &axes);
        for chart in charts {
            figure = std::mem::replace(&mut figure, Panels::new("")).with(lines(chart, limits));
        }
        table += &rows;
    };
    for law in [Law::ElasticPlastic, Law::Sigmoid] {
        let factors = decades(4.8, 10.7, 60).into_iter();
        let limits = factors.map(|b| Ok((limits(law, b)?, b)));
        let limits = limits.collect::<Result<Vec<_>, CableError>>()?;
        add(
            law.name(),
            "shape factor b, 1/m",
            &over_shape_factor(law, 15, 12)?,
            &limits,
        );
    }
    let limit = limits(Law::Sigmoid, SHAPE_FACTOR)?;
    let grid = over_speed(Law::Sigmoid, 15, 8)?;
    add(
        "sigmoid, b = 1e8 1/m",
        "speed, m/s",
        &grid,
        &[(limit, 10.0), (limit, 100.0)],
    );
    crate::table::write(&out.join("stability-explicit.csv"), &table)?;
    std::fs::write(out.join("stability-explicit.svg"), figure.to_svg()?)?;
    Ok(())
}
