//! Measures: those of a scene, and the list built in.

use creepage_scene::{End, Measure, Restraint, Scene};

/// Stiffnesses of springs that are tried, as shares of the cable's own EA/L: between them both 1/F and u are read as of a spring
/// against a spring.
const SPRINGS: [f64; 4] = [0.03, 0.2, 1.0, 6.0];
/// Stiffness of clamps as a share of EA/L: ten times as stiff ones bear a tenth more at most.
const CLAMP: f64 = 10.0;
/// Places of one clamp, and of two, as shares of the duct's length.
const ONE: [&[f64]; 3] = [&[0.1], &[0.5], &[0.9]];
const TWO: [&[f64]; 3] = [&[0.02, 0.98], &[0.1, 0.9], &[0.3, 0.7]];

/// A measure, or several alike of which the best is looked for: springs by growing stiffness, of which those between them can be built
/// too, or clamps at several places.
pub type Way = Vec<Measure>;

/// What is compared: the scene as it is, then its own measures, or those built in, first what is not looked for.
pub fn ways(scene: &Scene) -> Vec<Way> {
    let named = |name: &str| Measure {
        name: name.to_owned(),
        ..Measure::default()
    };
    let mut ways = vec![vec![named("as it is")]];
    if !scene.measures.is_empty() {
        ways.extend(scene.measures.iter().map(|measure| vec![measure.clone()]));
        return ways;
    }
    let held = |name, [upstream, downstream]: [bool; 2], by: End| Measure {
        upstream: upstream.then_some(by),
        downstream: downstream.then_some(by),
        ..named(name)
    };
    let fixed = held("both ends fixed", [true; 2], End::Fixed);
    if fixed.applied(scene) != *scene {
        ways.push(vec![fixed]);
    }
    let own = scene.cable.axial_stiffness / scene.duct.length;
    for (name, ends) in [
        ("spring at the upstream end", [true, false]),
        ("spring at the downstream end", [false, true]),
        ("springs at both ends", [true; 2]),
    ] {
        ways.push(
            SPRINGS
                .map(|share| held(name, ends, End::Spring(share * own)))
                .into(),
        );
    }
    let clamp = |place: &f64| Restraint::new(place * scene.duct.length, CLAMP * own);
    for (name, places) in [("one clamp", ONE), ("two clamps", TWO)] {
        let clamped = |places: &[f64]| Measure {
            added_restraints: places.iter().map(clamp).collect(),
            ..named(name)
        };
        ways.push(places.map(clamped).into());
    }
    ways
}

/// The stiffness of the springs of a measure \[N/m\]; none if it has none.
pub fn stiffness(measure: &Measure) -> Option<f64> {
    let end = measure.upstream.or(measure.downstream)?;
    end.stiffness().filter(|stiffness| *stiffness > 0.0)
}

/// The measure with another stiffness of its springs \[N/m\].
pub fn with_stiffness(measure: &Measure, stiffness: f64) -> Measure {
    let mut measure = measure.clone();
    for end in [&mut measure.upstream, &mut measure.downstream] {
        *end = end.map(|_| End::Spring(stiffness));
    }
    measure
}
