//! Test models: problems with their exact answers.
//!
//! In the closed forms duct and cable start at rest, and a wide front moves the duct forward by D behind it. It slips
//! forward past the cable everywhere and all the time, or not at all; the state before the duct's return then does not depend on
//! the path. With an elastic sheath of screening length λ = √(EA γ), γ = 2/(q b) (λ = 0 for Coulomb's law):
//!
//! - *fully mobilised*, D large: F(x) = q x from a free end at 0, u(0) = q L²/(2EA) against a fixed one at L;
//! - *anchored*, the bar long: friction reaches X = √(2EA·D/q) from the fixed end, with F = q √(X² − λ²) there;
//! - *sprung end*, stiffness S: the end yields by F/S, so that F² = 2EA q (D − F/S) − q²λ²; where that asks for less than
//!   q λ nothing slips, the sheath only shears, and F = (D − F/S)·EA/λ;
//! - *push and pull*: fronts of D and −D by turns; from one to the other the duct turns by 2 D;
//! - *free at both ends*: the cable rides along with the duct, there and back, and carries no force;
//! - *steady slide* with the sigmoid: a duct that moves on at V rubs with f = q tanh(b V Δt/2) for ever.
//!
//! Unloading, and so the return of the duct to rest, is the loading curve doubled in both directions (G. Masing, 1926).
//!
//! What inertia adds is at most a wave as fast as the duct, √(EA m′)·V: the front's speed is chosen to make that
//! [`WAVE`] of the force, which is then part of the tolerance of solvers with inertia.

use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh};

use super::harness::{Bar, Drive, Kind, LIMITS, MASS, Pass, Problem, Run, SPEED, UPPER, sheathed, truck};

type Made<T> = Result<T, Box<dyn std::error::Error>>;

const EA: f64 = 8e6;
const Q: f64 = 40.0;
/// Displacement of the duct \[m\].
const D: f64 = 1e-4;
/// Nodes per anchored length.
const FINENESS: f64 = 21.9;
/// Stiffness of a spring that holds nothing and only tells where its end is \[N/m\].
const FEELER: f64 = 1e-3;
/// Share of the force that waves may have.
const WAVE: f64 = 5e-4;
/// What the quasi-static windows leave out.
const WINDOWS: f64 = 1e-4;

/// What a model predicts.
#[derive(Debug, Clone, Copy)]
pub enum Quantity {
    UpstreamForce,
    DownstreamForce,
    /// Before the duct returns to rest.
    UpstreamBeforeRest,
    DownstreamBeforeRest,
    PeakDownstream,
    LowestDownstream,
    MaxCompression,
    MaxTension,
    UpstreamDisplacement,
    DownstreamDisplacement,
    MiddleDisplacement,
    /// In this element.
    ElementForce(usize),
}

/// One exact number.
#[derive(Debug, Clone, Copy)]
pub struct Exact {
    /// After so many passes.
    pub passes: usize,
    pub quantity: Quantity,
    pub value: f64,
    /// Largest error by discretisation, absolute.
    pub discretisation: f64,
    /// Largest effect of inertia, absolute.
    pub inertia: f64,
    /// Largest effect of steps finer than those of the answer, absolute.
    pub steps: f64,
}

/// A problem and its exact answers.
pub struct Model {
    pub name: &'static str,
    pub problem: Problem,
    /// Vehicles in the order in which they pass.
    pub traffic: Vec<usize>,
    pub exact: Vec<Exact>,
}

impl Quantity {
    pub fn read(self, problem: &Problem, run: &Run, pass: &Pass) -> f64 {
        let outcome = &pass.outcome;
        match self {
            Self::UpstreamForce => outcome.force.upstream,
            Self::DownstreamForce => outcome.force.downstream,
            Self::UpstreamBeforeRest => pass.before_rest.upstream,
            Self::DownstreamBeforeRest => pass.before_rest.downstream,
            Self::PeakDownstream => outcome.peak.downstream,
            Self::LowestDownstream => outcome.lowest.downstream,
            Self::MaxCompression => outcome.max_compression,
            Self::MaxTension => outcome.max_tension,
            Self::UpstreamDisplacement => outcome.upstream_displacement,
            Self::DownstreamDisplacement => outcome.downstream_displacement,
            Self::MiddleDisplacement => run.state.displacement()[problem.mesh.elements() / 2],
            // Between those on the ends.
            Self::ElementForce(element) => problem.forces(&run.state)[element + 1],
        }
    }
}

impl Exact {
    /// After the first pass, with the wave's share of `scale` for inertia.
    fn new(quantity: Quantity, value: f64, discretisation: f64, scale: f64) -> Self {
        Self {
            passes: 1,
            quantity,
            value,
            discretisation: discretisation * scale,
            inertia: WAVE * scale,
            steps: 0.0,
        }
    }

    /// Largest error of a solver.
    pub fn allowed(&self, kind: Kind) -> f64 {
        let inertia = if kind.has_inertia() { self.inertia } else { 0.0 };
        // Its steps are those of its stability.
        let steps = if kind == Kind::Explicit { self.steps } else { 0.0 };
        self.discretisation + inertia + steps
    }
}

/// Laws of which all solvers know the answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Law {
    Coulomb,
    Sheath,
}

impl Law {
    pub const ALL: [Self; 2] = [Self::Coulomb, Self::Sheath];

    /// λ² \[m²\] in a bar with anchored length X: λ = X/2 for the sheath.
    fn screening(self) -> f64 {
        match self {
            Self::Coulomb => 0.0,
            Self::Sheath => 0.25 * anchored_length().powi(2),
        }
    }

    fn friction(self) -> Made<Friction> {
        let shape_factor = 2.0 * EA / (Q * self.screening());
        let law = match self {
            Self::Coulomb => FrictionLaw::Coulomb,
            Self::Sheath => FrictionLaw::ElasticPlastic { shape_factor },
        };
        Ok(Friction::new(law, Q)?)
    }

    /// Error of an anchored force, as a share: the border of the slipping zone falls between two nodes, and the sheath's
    /// decay over λ is of second order; twice the friction halves the slipping zone's square, and both moves add up.
    fn resolution(self, moves: f64) -> f64 {
        let border = 0.13 * moves * moves / FINENESS.powi(2);
        let decay = match self {
            Self::Coulomb => 0.0,
            Self::Sheath => 0.1 * (2.0 / FINENESS).powi(2),
        };
        border + decay
    }
}

/// X, the length over which friction q takes up the displacement D from an end that does not move \[m\].
fn anchored_length() -> f64 {
    (2.0 * EA * D / Q).sqrt()
}

/// A front of half-width `width`, so slow that waves are [`WAVE`] of `force`.
fn front(width: f64, displacement: f64, force: f64) -> Drive {
    let duct_speed_per_speed = 0.5 * displacement.abs() / width;
    let speed = WAVE * force / ((EA * MASS).sqrt() * duct_speed_per_speed);
    // tanh(7) is 1 to 2e-6. Nor shall inertia soften what travels with the front by a greater share, v²/c².
    Drive::new(speed.min((WAVE * EA / MASS).sqrt()), 7.0 * width, move |xi| {
        0.5 * displacement * (1.0 - (xi / width).tanh())
    })
}

/// A bar of seven anchored lengths.
///
/// The front is twenty times as wide as the slipping zone. A steeper one ratchets: where friction is locked at q, its
/// bend EA D″ makes the cable slip on in passing, by about (X/W)²/40 of the force.
fn long_bar(law: Law, downstream: End, moves: &[f64]) -> Made<Problem> {
    let x = anchored_length();
    let length = 7.0 * x;
    Ok(Problem {
        cable: DuctedCable::new(length, EA, law.friction()?)?.with_ends(End::Free, downstream)?,
        mesh: Mesh::new(length, x / FINENESS, x / FINENESS)?,
        drives: moves.iter().map(|&d| front(20.0 * x, d, Q * x)).collect(),
    })
}

/// Fully mobilised between a free end and one on a spring, or fixed.
fn fully_mobilised(law: Law, spring: Option<f64>) -> Made<Model> {
    let length = 12.0;
    let exact = Q * length;
    let stretch = Q * length * length / (2.0 * EA);
    let yielded = spring.map_or(0.0, |s| exact / s);
    let far = stretch + yielded;
    let friction = match law {
        Law::Coulomb => law.friction()?,
        Law::Sheath => Friction::new(FrictionLaw::ElasticPlastic { shape_factor: 1e7 }, Q)?,
    };
    let mesh = Mesh::new(length, 0.5, 0.1)?;
    let downstream = spring.map_or(End::Fixed, End::Spring);
    let along = [0, 5, 12, 20, 23].map(|element| {
        let x = (element as f64 + 0.5) * mesh.spacing();
        Exact::new(Quantity::ElementForce(element), -Q * x, WINDOWS, exact)
    });
    let ends = [
        Exact::new(Quantity::UpstreamForce, 0.0, 0.0, exact),
        Exact::new(Quantity::DownstreamBeforeRest, exact, WINDOWS, exact),
        Exact::new(Quantity::PeakDownstream, exact, WINDOWS, exact),
        Exact::new(Quantity::DownstreamForce, -exact, WINDOWS, exact),
        Exact::new(Quantity::MaxCompression, 0.0, WINDOWS, exact),
        Exact::new(Quantity::MaxTension, exact, WINDOWS, exact),
        Exact::new(Quantity::UpstreamDisplacement, -far, WINDOWS, far),
        Exact::new(Quantity::DownstreamDisplacement, -yielded, WINDOWS, far),
    ];
    Ok(Model {
        name: "fully mobilised",
        problem: Problem {
            cable: DuctedCable::new(length, EA, friction)?.with_ends(End::Free, downstream)?,
            mesh,
            // Three times farther than friction can stretch the bar, so that the return mobilises it the other way.
            drives: vec![front(length, 3.0 * far, exact)],
        },
        traffic: vec![0],
        exact: ends.into_iter().chain(along).collect(),
    })
}

/// Force at the downstream end of a long bar, fixed or on a spring, when the duct has moved from the beginning by a `share`
/// of D.
fn pushed(law: Law, spring: Option<f64>, share: f64) -> f64 {
    let x = anchored_length();
    let yielding = spring.map_or(0.0, |s| EA * Q / s);
    let reach = Q * Q * (share * x * x - law.screening());
    let slipping = (yielding * yielding + reach).sqrt() - yielding;
    let screening = law.screening().sqrt();
    // Written so that the root of a negative number fails.
    if slipping >= Q * screening {
        slipping
    } else {
        share * D * EA / (screening + spring.map_or(0.0, |s| EA / s))
    }
}

/// Anchored at a fixed end, or at one on a spring.
fn anchored(law: Law, spring: Option<f64>) -> Made<Model> {
    let x = anchored_length();
    let push = pushed(law, spring, 1.0);
    let kept = push - 2.0 * pushed(law, spring, 0.5);
    let resolution = law.resolution(1.0) + WINDOWS;
    let returned = law.resolution(2.0) + WINDOWS;
    let mut answers = vec![
        Exact::new(Quantity::UpstreamForce, 0.0, 0.0, Q * x),
        Exact::new(Quantity::DownstreamBeforeRest, push, resolution, Q * x),
        Exact::new(Quantity::PeakDownstream, push, resolution, Q * x),
        Exact::new(Quantity::DownstreamForce, kept, returned, Q * x),
        Exact::new(Quantity::LowestDownstream, kept, returned, Q * x),
    ];
    if let Some(spring) = spring {
        let (quantity, value) = (Quantity::DownstreamDisplacement, kept / spring);
        answers.push(Exact::new(quantity, value, returned, Q * x / spring));
    }
    Ok(Model {
        name: "anchored",
        problem: long_bar(law, spring.map_or(End::Fixed, End::Spring), &[D])?,
        traffic: vec![0],
        exact: answers,
    })
}

/// Pushed and pulled, over and over.
fn push_and_pull(law: Law) -> Made<Model> {
    let x = anchored_length();
    let push = pushed(law, None, 1.0);
    let kept = push - 2.0 * pushed(law, None, 0.5);
    let traffic = vec![0, 1, 0];
    let exact = traffic.iter().enumerate().flat_map(|(pass, &drive)| {
        let sign = [1.0, -1.0][drive];
        let extreme = [Quantity::PeakDownstream, Quantity::LowestDownstream][drive];
        // The ratchet of a front of 20 X.
        let ratchet = (pass + 1) as f64 / 400.0 / 40.0;
        let resolution = law.resolution(2.0) + WINDOWS + ratchet;
        [
            (Quantity::DownstreamBeforeRest, push),
            (extreme, push),
            (Quantity::DownstreamForce, kept),
        ]
        .map(|(quantity, value)| Exact {
            passes: pass + 1,
            ..Exact::new(quantity, sign * value, resolution, Q * x)
        })
    });
    Ok(Model {
        name: "push and pull",
        exact: exact.collect(),
        problem: long_bar(law, End::Fixed, &[D, -D])?,
        traffic,
    })
}

/// Held by nothing.
fn riding_along(law: Law) -> Made<Model> {
    let exact = (1..=2).flat_map(|passes| {
        [
            Exact::new(Quantity::UpstreamForce, 0.0, 0.0, 0.0),
            Exact::new(Quantity::DownstreamForce, 0.0, 0.0, 0.0),
            Exact::new(Quantity::PeakDownstream, 0.0, 0.0, 0.0),
            // The ends' share of the front's bend fades over λ; an endless cable would ride along exactly.
            Exact::new(Quantity::MiddleDisplacement, 0.0, 1e-5, D),
        ]
        .map(|answer| Exact { passes, ..answer })
    });
    Ok(Model {
        name: "riding along",
        problem: long_bar(law, End::Free, &[D])?,
        traffic: vec![0; 2],
        exact: exact.collect(),
    })
}

/// The full-scale experiment, by an independent program on the same mesh: node spacing 0.1 m, vehicle step 0.05 m.
fn full_scale(limit: f64, forces: [f64; 2]) -> Made<Model> {
    let bar = Bar {
        law: sheathed(limit),
        limit,
        mesh: (0.1, 0.05),
        ..UPPER
    };
    let problem = bar.under(&truck())?;
    let ratio = cable_dem::inertia_ratio(&problem.cable, MASS, SPEED)?;
    let exact = [1, 5].into_iter().zip(forces).map(|(passes, force)| Exact {
        passes,
        quantity: Quantity::DownstreamForce,
        value: force,
        // The distance of this mesh from a finer one, by which any two solvers on it may differ; that program and one with
        // other steps may lie on either side.
        discretisation: 0.002 * force,
        inertia: ratio * force,
        steps: 0.002 * force,
    });
    Ok(Model {
        name: "full scale",
        exact: exact.collect(),
        problem,
        traffic: vec![0; 5],
    })
}

/// A duct that moves on under the sigmoid law, for which f depends on the time step.
fn steady_slide(slip: f64) -> Made<Model> {
    let (length, speed, shape_factor) = (12.0, 20.0, 1e6);
    // So small a vehicle step that it is the time step of both solvers with inertia.
    let mesh = Mesh::new(length, 0.5, 0.006)?;
    let time_step = mesh.vehicle_step() / speed;
    // b V Δt/2 = slip
    let strain = 2.0 * slip / (shape_factor * time_step) / speed;
    let friction = Friction::new(FrictionLaw::Sigmoid { shape_factor }, Q)?;
    let rubbed = Q * slip.tanh();
    let (force, stretch) = (rubbed * length, rubbed * length * length / (2.0 * EA));
    let (approach, element) = (25.0, 11);
    // A pass takes a whole number of steps: Δt is rounded to one step in so many.
    let steps = (length + 2.0 * approach) / mesh.vehicle_step();
    // The duct's return is far longer than the slip of a step: friction at its limit.
    let returned = -Q * (element as f64 + 0.5) * mesh.spacing();
    let shrunk = -Q * length * length / (2.0 * EA);
    let answer = |quantity, value, scale| Exact {
        inertia: 0.0,
        steps: scale / steps,
        // Steady, and settled.
        ..Exact::new(quantity, value, 1e-6, scale)
    };
    Ok(Model {
        name: "steady slide",
        problem: Problem {
            cable: DuctedCable::new(length, EA, friction)?.with_ends(End::Spring(FEELER), End::Fixed)?,
            mesh,
            drives: vec![Drive::new(speed, approach, move |xi| -strain * xi)],
        },
        traffic: vec![0],
        exact: vec![
            answer(Quantity::UpstreamBeforeRest, -FEELER * stretch, FEELER * stretch),
            answer(Quantity::DownstreamBeforeRest, force, force),
            answer(Quantity::DownstreamForce, -Q * length, force),
            answer(Quantity::ElementForce(element), returned, force),
            answer(Quantity::UpstreamDisplacement, shrunk, stretch),
        ],
    })
}

/// All of them.
pub fn all() -> Made<Vec<Model>> {
    let x = anchored_length();
    let mut models = vec![
        full_scale(LIMITS[0], [102.08, 210.46])?,
        full_scale(LIMITS[1], [110.43, 214.68])?,
        steady_slide(0.2)?,
        steady_slide(0.5)?,
    ];
    for law in Law::ALL {
        for spring in [None, Some(1e6)] {
            models.push(fully_mobilised(law, spring)?);
        }
        for spring in [None, Some(0.01), Some(1.0), Some(30.0)] {
            models.push(anchored(law, spring.map(|share| share * EA / x))?);
        }
        models.push(push_and_pull(law)?);
        models.push(riding_along(law)?);
    }
    Ok(models)
}
