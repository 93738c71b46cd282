//! Measures: those of a scene, and the list built in.

use creepage_scene::{End, Measure, Restraint, Scene};

/// Stiffnesses of springs that are tried, as shares of the cable's own EA/L: between them both 1/F and u are read as of a spring
/// against a spring.
const SPRINGS: [f64; 4] = [0.03, 0.2, 1.0, 6.0];
/// Which ends have them, upstream and downstream.
const SPRUNG: [(&str, [bool; 2]); 3] = [
    ("spring at the upstream end", [true, false]),
    ("spring at the downstream end", [false, true]),
    ("springs at both ends", [true; 2]),
];
/// Stiffness of clamps as a share of EA/L: ten times as stiff ones bear a tenth more at most.
const CLAMP: f64 = 10.0;
/// Their places that are tried, as shares of the duct's length.
const CLAMPED: [(&str, [&[f64]; 3]); 2] = [
    ("one clamp", [&[0.1], &[0.5], &[0.9]]),
    ("two clamps", [&[0.02, 0.98], &[0.1, 0.9], &[0.3, 0.7]]),
];

/// A measure, or several alike of which the best is looked for: springs by growing stiffness, of which those between them can be built
/// too, or clamps at several places.
pub type Way = Vec<Measure>;

fn named(name: &str) -> Measure {
    Measure {
        name: name.to_owned(),
        ..Measure::default()
    }
}

fn held(name: &str, [upstream, downstream]: [bool; 2], by: End) -> Measure {
    Measure {
        upstream: upstream.then_some(by),
        downstream: downstream.then_some(by),
        ..named(name)
    }
}

/// What is compared: the scene as it is, then its own measures, or those built in, first what is not looked for.
pub fn ways(scene: &Scene) -> Vec<Way> {
    let mut ways = vec![vec![named("as it is")]];
    if !scene.measures.is_empty() {
        ways.extend(scene.measures.iter().map(|measure| vec![measure.clone()]));
        return ways;
    }
    let fixed = held("both ends fixed", [true; 2], End::Fixed);
    if fixed.applied(scene) != *scene {
        ways.push(vec![fixed]);
    }
    let own = scene.cable.axial_stiffness / scene.duct.length;
    ways.extend(SPRUNG.map(|(name, ends)| {
        let springs = SPRINGS.map(|share| held(name, ends, End::Spring(share * own)));
        springs.into()
    }));
    let clamp = |place: &f64| Restraint::new(place * scene.duct.length, CLAMP * own);
    let clamped = |name, places: &[f64]| Measure {
        added_restraints: places.iter().map(clamp).collect(),
        ..named(name)
    };
    ways.extend(CLAMPED.map(|(name, all)| all.map(|places| clamped(name, places)).into()));
    ways
}

/// The stiffness of the springs of a measure \[N/m\]; none if it has none.
pub fn stiffness(measure: &Measure) -> Option<f64> {
    let end = measure.upstream.or(measure.downstream)?;
    end.stiffness().filter(|stiffness| *stiffness > 0.0)
}

/// The measure with another stiffness of its springs \[N/m\].
pub fn with_stiffness(measure: &Measure, stiffness: f64) -> Measure {
    let spring = |end: Option<End>| end.map(|_| End::Spring(stiffness));
    Measure {
        upstream: spring(measure.upstream),
        downstream: spring(measure.downstream),
        ..measure.clone()
    }
}
