//! Odemark's approximation against the exact layered half-space on random grounds that had no part in its making: its error
//! is the one its documentation states.

use boussinesq::Odemark;
use burmister::LayeredHalfSpace;
use ground_field::Base;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use super::common::{distance, line, load, profile, soil};

const GROUNDS: usize = 120;

/// How the modulus goes from one layer to the next below.
#[derive(Debug, Clone, Copy)]
enum Course {
    Falling,
    Rising,
    UpAndDown,
}

/// Errors of u_r and u_z of one ground at three depths, as shares of the peak.
fn errors(steps: &[(f64, f64, bool)], base: f64, ratios: &[f64], course: Course) -> Vec<[f64; 2]> {
    // From the base up: `step` is the ratio of a modulus to the one below it.
    let mut modulus = base;
    let mut layers = Vec::new();
    for (k, &(thickness, step, up)) in steps.iter().enumerate() {
        let falls = match course {
            Course::Falling => true,
            Course::Rising => false,
            Course::UpAndDown => up,
        };
        modulus *= if falls { step } else { 1.0 / step };
        layers.insert(0, (thickness, soil(modulus, ratios[k + 1])));
    }
    let ground = profile(&layers, Base::HalfSpace(soil(base, ratios[0])));
    let exact = LayeredHalfSpace::new(&ground)
        .and_then(|model| model.with_accuracy(1e-5))
        .expect("exact");
    let cheap = Odemark::new(&ground).expect("odemark");
    let radii: Vec<f64> = (0..40)
        .map(|k| 0.1 * f64::from(k))
        .chain((0..17).map(|k| 4.0 + f64::from(k)))
        .collect();
    let wheel = load(5e4, 0.15);
    [0.6, 1.2, 2.0]
        .map(|depth| {
            distance(
                &line(&exact, wheel, &radii, depth),
                &line(&cheap, wheel, &radii, depth),
            )
        })
        .to_vec()
}

/// Median, 90 % quantile and worst of u_r, then of u_z.
fn statistics(course: Course) -> [[f64; 3]; 2] {
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[17; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let layer = (0.05..0.55_f64, 0.0..1.0_f64, proptest::bool::ANY)
        .prop_map(|(thickness, decade, up)| (thickness, 10f64.powf(decade), up));
    let any = (
        proptest::collection::vec(layer, 1..4),
        7.5..8.5_f64,
        proptest::collection::vec(0.2..0.45_f64, 4),
    );
    let mut found = Vec::new();
    for _ in 0..GROUNDS {
        let (steps, base, ratios) = any.new_tree(&mut runner).expect("ground").current();
        let at_depths = errors(&steps, 10f64.powf(base), &ratios, course);
        found
            .push([0, 1].map(|component| at_depths.iter().map(|error| error[component]).fold(0.0, f64::max)));
    }
    [0, 1].map(|component| {
        let mut sorted: Vec<f64> = found.iter().map(|error| error[component]).collect();
        sorted.sort_by(f64::total_cmp);
        let last = sorted.len() - 1;
        [sorted[last / 2], sorted[last * 9 / 10], sorted[last]]
    })
}

/// Median and 90 % quantile as documented, u_r then u_z, and what the worst of these grounds may reach. The worst of a
/// sample is no bound: a duct a few centimetres from an interface above much stiffer soil hardly moves along, and there the
/// error of u_r reaches its own peak.
const DOCUMENTED: [(Course, [[f64; 2]; 2], [f64; 2]); 3] = [
    (Course::Falling, [[0.15, 0.29], [0.03, 0.06]], [0.6, 0.1]),
    (Course::Rising, [[0.15, 0.38], [0.07, 0.13]], [1.2, 0.2]),
    (Course::UpAndDown, [[0.15, 0.41], [0.05, 0.12]], [1.2, 0.3]),
];

#[test]
fn hold_out_error_is_the_documented_one() {
    for (course, documented, limit) in DOCUMENTED {
        let found = statistics(course);
        for component in [0, 1] {
            let [median, ninety, worst] = found[component];
            for (value, stated) in [
                (median, documented[component][0]),
                (ninety, documented[component][1]),
            ] {
                // Another hundred grounds, drawn in another way: the quantiles scatter by a quarter.
                assert!(
                    (0.7..1.3).contains(&(value / stated)),
                    "{course:?}: {found:.3?} where {documented:?} is stated"
                );
            }
            assert!(worst < limit[component], "{course:?}: {found:.3?}");
        }
    }
}
