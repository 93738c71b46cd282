//! Measures: those of a scene, and the list built in.

use creepage_scene::Scene;
use creepage_scene::{End, Measure, Restraint};

/// Stiffnesses of springs that are tried, as shares of the cable's own EA/L: between them both 1/F and u are read as of a spring
/// against a spring.
const SPRINGS: [f64; 4] = [0.03, 0.2, 1.0, 6.0];
/// Stiffness of clamps as a share of EA/L: ten times as stiff ones bear a tenth more at most.
const CLAMP: f64 = 10.0;
/// Places of one clamp, and of two, as shares of the duct's length.
const ONE: [f64; 3] = [0.1, 0.5, 0.9];
const TWO: [[f64; 2]; 3] = [[0.02, 0.98], [0.1, 0.9], [0.3, 0.7]];

/// A measure, or several alike of which the best is looked for.
pub struct Way {
    /// What is tried.
    pub candidates: Vec<Measure>,
    /// Stiffnesses of the candidates \[N/m\], ascending, where they differ by these alone: what lies between can be built too.
    pub stiffnesses: Vec<f64>,
}

impl Way {
    fn one(measure: Measure) -> Self {
        Self {
            candidates: vec![measure],
            stiffnesses: Vec::new(),
        }
    }

    /// The spring of this stiffness \[N/m\] where the candidates have theirs.
    pub fn with_spring(&self, stiffness: f64) -> Measure {
        let mut measure = self.candidates[0].clone();
        for end in [&mut measure.upstream, &mut measure.downstream] {
            *end = end.map(|_| End::Spring(stiffness));
        }
        measure
    }
}

/// What is compared: the scene as it is, then its own measures, or those built in.
pub fn ways(scene: &Scene) -> Vec<Way> {
    let named = |name: &str| Measure {
        name: name.to_owned(),
        ..Measure::default()
    };
    let mut ways = vec![Way::one(named("as it is"))];
    if !scene.measures.is_empty() {
        ways.extend(scene.measures.iter().cloned().map(Way::one));
        return ways;
    }
    let fixed = Measure {
        upstream: Some(End::Fixed),
        downstream: Some(End::Fixed),
        ..named("both ends fixed")
    };
    if fixed.applied(scene) != *scene {
        ways.push(Way::one(fixed));
    }
    let own = scene.cable.axial_stiffness / scene.duct.length;
    for (name, upstream, downstream) in [
        ("spring at the upstream end", true, false),
        ("spring at the downstream end", false, true),
        ("springs at both ends", true, true),
    ] {
        let spring = |stiffness: f64| Measure {
            upstream: upstream.then_some(End::Spring(stiffness)),
            downstream: downstream.then_some(End::Spring(stiffness)),
            ..named(name)
        };
        let stiffnesses = SPRINGS.map(|share| share * own);
        ways.push(Way {
            candidates: stiffnesses.map(spring).into(),
            stiffnesses: stiffnesses.into(),
        });
    }
    let clamped = |name: &str, places: &[f64]| Measure {
        added_restraints: places
            .iter()
            .map(|place| Restraint::new(place * scene.duct.length, CLAMP * own))
            .collect(),
        ..named(name)
    };
    let clamps = |candidates| Way {
        candidates,
        stiffnesses: Vec::new(),
    };
    ways.push(clamps(ONE.map(|place| clamped("one clamp", &[place])).into()));
    ways.push(clamps(TWO.map(|places| clamped("two clamps", &places)).into()));
    ways
}

/// How many ends and clamps a measure changes.
pub fn parts(measure: &Measure) -> usize {
    let ends = [measure.upstream, measure.downstream];
    let clamps = measure.restraints.as_ref().map_or(0, Vec::len) + measure.added_restraints.len();
    ends.iter().flatten().count() + clamps
}
