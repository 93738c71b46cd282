//! How far the answers of two runs of one scene lie apart, kind by kind, as the stated error counts them.

use creepage::{DayExtremes, PassRecord, RestraintRange, Run, Scene};

/// Shares of the forces after passes, of the largest and the least during them, of the forces on clamps, and of the movements.
pub type Errors = [f64; 5];
pub const KINDS: [&str; 5] = ["after", "peak", "least", "clamp", "movement"];

/// Forces and movements below this share of the run's largest, or of the duct's own movement, count as nothing, as in the estimate;
/// and so does the friction on a centimetre of cable.
const SMALL: f64 = 0.1;
const SHORT: f64 = 0.01;

/// What the run states of each kind.
pub fn stated(run: &Run) -> Errors {
    let force = run.error_estimate.relative;
    [force, force, force, force, run.error_estimate.parts.movement]
}

/// How far `run` is from `exact` in the passes or days that both list.
pub fn errors(scene: &Scene, run: &Run, exact: &Run) -> Errors {
    let scale = Scale::new(scene, exact);
    if exact.days.is_empty() {
        of_passes(run, exact, &scale)
    } else {
        of_days(run, exact, &scale)
    }
}

/// What the differences are relative to at least.
struct Scale {
    force: f64,
    movement: f64,
    /// The largest tension along the cable, which is known after the last pass alone.
    tension: f64,
}

impl Scale {
    fn new(scene: &Scene, exact: &Run) -> Self {
        let of_passes = exact.passes.iter().flat_map(|pass| {
            let during = during(pass).into_iter().flatten();
            forces(pass).into_iter().chain(during)
        });
        let of_days = exact
            .days
            .iter()
            .flat_map(|day| day_forces(day).into_iter().flatten());
        let clamps = exact
            .restraints
            .iter()
            .flat_map(|clamp| clamp.after_passes_n.iter().copied());
        let most = largest(of_passes).max(largest(clamps));
        let tension = exact
            .force_profile
            .force_n
            .iter()
            .fold(0.0, |most: f64, force| most.max(-force));
        // Where heat moves the cable, or where it is pulled more than pressed, all is relative to the largest.
        let share = if exact.days.is_empty() && tension <= most {
            SMALL
        } else {
            1.0
        };
        let most = most.max(tension).max(largest(of_days));
        let moved = exact.passes.iter().flat_map(movements);
        let moved = moved.chain(
            exact
                .days
                .iter()
                .flat_map(|day| day_movements(day).into_iter().flatten()),
        );
        Self {
            force: (share * most)
                .max(SHORT * scene.friction_limit())
                .max(f64::MIN_POSITIVE),
            movement: largest(moved).max(SMALL * exact.duct_motion.peak_longitudinal_m),
            tension,
        }
    }
}

/// The largest error of each kind so far.
#[derive(Default)]
struct Worst(Errors);

impl Worst {
    fn note(&mut self, kind: usize, found: f64, exact: f64, scale: f64) {
        self.0[kind] = self.0[kind].max((found - exact).abs() / scale);
    }

    /// The least and the largest of a force.
    fn range(&mut self, kinds: [usize; 2], found: [f64; 2], exact: [f64; 2], scale: f64) {
        for end in 0..2 {
            self.note(kinds[end], found[end], exact[end], scale);
        }
    }
}

fn of_passes(run: &Run, exact: &Run, scale: &Scale) -> Errors {
    let mut worst = Worst::default();
    let last = exact.passes.last().map(|pass| pass.pass);
    let pairs: Vec<(usize, usize)> = pairs(&run.passes, &exact.passes, |pass| pass.pass);
    for &(index, at) in &pairs {
        let (found, exact) = (&run.passes[index], &exact.passes[at]);
        let tension = if Some(exact.pass) == last {
            scale.tension
        } else {
            0.0
        };
        let whole = largest(forces(exact)).max(scale.force).max(tension);
        for (found, exact) in forces(found).into_iter().zip(forces(exact)) {
            worst.note(0, found, exact, whole);
        }
        for (found, exact) in during(found).into_iter().zip(during(exact)) {
            worst.range([2, 1], found, exact, largest(exact).max(scale.force));
        }
        for (found, exact) in movements(found).into_iter().zip(movements(exact)) {
            worst.note(4, found, exact, scale.movement);
        }
    }
    for (clamp, exact) in run.restraints.iter().zip(&exact.restraints) {
        for (found, exact) in [
            (&clamp.after_passes_n, &exact.after_passes_n),
            (&clamp.during_passes_n, &exact.during_passes_n),
        ] {
            let whole = largest(exact.iter().copied()).max(scale.force);
            for &(index, at) in &pairs {
                worst.note(3, found[index], exact[at], whole);
            }
        }
    }
    worst.0
}

fn of_days(run: &Run, exact: &Run, scale: &Scale) -> Errors {
    let mut worst = Worst::default();
    for (index, at) in pairs(&run.days, &exact.days, |day| day.day) {
        let (found, exact) = (&run.days[index], &exact.days[at]);
        for (found, exact) in day_forces(found).into_iter().zip(day_forces(exact)) {
            worst.range([2, 1], found, exact, scale.force);
        }
        for (found, exact) in found.restraints.iter().zip(&exact.restraints) {
            let range = |range: &RestraintRange| [range.min_n, range.max_n];
            worst.range([3, 3], range(found), range(exact), scale.force);
        }
        for (found, exact) in day_movements(found).into_iter().zip(day_movements(exact)) {
            worst.range([4, 4], found, exact, scale.movement);
        }
    }
    for (index, at) in pairs(&run.passes, &exact.passes, |pass| pass.pass) {
        let (found, exact) = (forces(&run.passes[index]), forces(&exact.passes[at]));
        for end in 0..2 {
            worst.note(0, found[end], exact[end], scale.force);
        }
    }
    worst.0
}

/// Where the same number stands in two ascending lists.
fn pairs<T>(own: &[T], other: &[T], number: impl Fn(&T) -> u64) -> Vec<(usize, usize)> {
    let same = |wanted| other.binary_search_by_key(&wanted, &number).ok();
    let own = own.iter().enumerate();
    own.filter_map(|(index, item)| Some((index, same(number(item))?)))
        .collect()
}

fn forces(pass: &PassRecord) -> [f64; 3] {
    [
        pass.upstream_force_n,
        pass.downstream_force_n,
        pass.max_compression_n,
    ]
}

/// The least and the largest force on each end during a pass.
fn during(pass: &PassRecord) -> [[f64; 2]; 2] {
    let upstream = [pass.upstream_least_n, pass.upstream_peak_n];
    [upstream, [pass.downstream_least_n, pass.downstream_peak_n]]
}

fn movements(pass: &PassRecord) -> [f64; 2] {
    [pass.upstream_displacement_m, pass.downstream_displacement_m]
}

/// The least and the largest force on each end in a day.
fn day_forces(day: &DayExtremes) -> [[f64; 2]; 2] {
    let upstream = [day.upstream_min_n, day.upstream_max_n];
    [upstream, [day.downstream_min_n, day.downstream_max_n]]
}

fn day_movements(day: &DayExtremes) -> [[f64; 2]; 2] {
    let upstream = [day.upstream_displacement_min_m, day.upstream_displacement_max_m];
    let downstream = [
        day.downstream_displacement_min_m,
        day.downstream_displacement_max_m,
    ];
    [upstream, downstream]
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| most.max(value.abs()))
}
