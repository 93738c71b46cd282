//! How far the answers of two runs of one scene lie apart, kind by kind, as the stated error counts them.

use creepage::{DayExtremes, PassRecord, Run, Scene};

use crate::largest;

/// Shares of the forces after passes, of the largest and the least during them, of the forces on clamps, and of the movements.
pub type Errors = [f64; 5];
pub const KINDS: [&str; 5] = ["after", "peak", "least", "clamp", "movement"];
pub const AFTER: usize = 0;
const PEAK: usize = 1;
const LEAST: usize = 2;
const CLAMP: usize = 3;
pub const MOVEMENT: usize = 4;

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
    if pairs(&run.passes, &exact.passes, |pass| pass.pass).is_empty() {
        return [f64::INFINITY; 5];
    }
    if exact.days.is_empty() {
        of_passes(run, exact, &scale)
    } else {
        of_days(run, exact, &scale)
    }
}

/// What the differences are relative to at least.
struct Scale {
    /// What counts as nothing, and what the forces of passes are relative to at least \[N\].
    nothing: f64,
    force: f64,
    /// The same of movements \[m\].
    still: f64,
    movement: f64,
    /// The largest tension along the cable, which is known after the last pass alone. Compression inside is relative to it after every pass:
    /// in a cable that is free at both ends there is hardly any.
    tension: f64,
}

impl Scale {
    fn new(scene: &Scene, exact: &Run) -> Self {
        let of_passes = exact.passes.iter().flat_map(|pass| {
            let during = during(pass).into_iter().flatten();
            forces(pass).into_iter().chain(during)
        });
        let of_days = exact.days.iter().flat_map(day_forces);
        let clamps = exact
            .restraints
            .iter()
            .flat_map(|clamp| clamp.after_passes_n.iter().copied());
        let along = &exact.force_profile.force_n;
        let most = largest(
            of_passes
                .chain(of_days)
                .chain(clamps)
                .chain(along.iter().copied()),
        );
        // A heated cable has its largest force at other hours than those of its passes.
        let share = if exact.days.is_empty() { SMALL } else { 1.0 };
        let nothing = (SHORT * scene.friction_limit()).max(f64::MIN_POSITIVE);
        let still = SMALL * exact.duct_motion.peak_longitudinal_m;
        Self {
            nothing,
            force: nothing.max(share * most),
            still,
            movement: largest(exact.passes.iter().flat_map(movements)).max(still),
            tension: along.iter().fold(0.0, |most: f64, force| most.max(-force)),
        }
    }
}

/// The largest error of each kind so far.
#[derive(Default)]
struct Worst(Errors);

impl Worst {
    fn note(&mut self, kind: usize, found: f64, exact: f64, scale: f64) {
        let error = (found - exact).abs() / scale;
        // What is no number is wrong.
        self.0[kind] = self.0[kind].max(if error.is_nan() { f64::INFINITY } else { error });
    }

    /// Forces or movements at one place.
    fn all<const N: usize>(&mut self, kind: usize, found: [f64; N], exact: [f64; N], scale: f64) {
        found
            .into_iter()
            .zip(exact)
            .for_each(|(found, exact)| self.note(kind, found, exact, scale));
    }
}

fn of_passes(run: &Run, exact: &Run, scale: &Scale) -> Errors {
    let mut worst = Worst::default();
    let last = exact.passes.last().map(|pass| pass.pass);
    let pairs = pairs(&run.passes, &exact.passes, |pass| pass.pass);
    for &(index, at) in &pairs {
        let (found, exact) = (&run.passes[index], &exact.passes[at]);
        let whole = largest(forces(exact)).max(scale.force);
        let inside = whole.max(scale.tension);
        let on_ends = if Some(exact.pass) == last { inside } else { whole };
        worst.all(AFTER, ends(found), ends(exact), on_ends);
        worst.note(AFTER, found.max_compression_n, exact.max_compression_n, inside);
        for (found, exact) in during(found).into_iter().zip(during(exact)) {
            let whole = largest(exact).max(scale.force);
            worst.note(LEAST, found[0], exact[0], whole);
            worst.note(PEAK, found[1], exact[1], whole);
        }
        worst.all(MOVEMENT, movements(found), movements(exact), scale.movement);
    }
    for (clamp, exact) in run.restraints.iter().zip(&exact.restraints) {
        let of_clamp = exact.after_passes_n.iter().chain(&exact.during_passes_n);
        let whole = largest(of_clamp.copied()).max(scale.force);
        for (found, exact) in [
            (&clamp.after_passes_n, &exact.after_passes_n),
            (&clamp.during_passes_n, &exact.during_passes_n),
        ] {
            for &(index, at) in &pairs {
                worst.note(CLAMP, found[index], exact[at], whole);
            }
        }
    }
    worst.0
}

/// Days are judged by their own largest values, at rest; passes by the forces on the ends.
fn of_days(run: &Run, exact: &Run, scale: &Scale) -> Errors {
    let mut worst = Worst::default();
    for (index, at) in pairs(&run.days, &exact.days, |day| day.day) {
        let (found, exact) = (&run.days[index], &exact.days[at]);
        let whole = largest(day_forces(exact)).max(scale.nothing);
        worst.all(LEAST, day_least(found), day_least(exact), whole);
        worst.all(PEAK, day_most(found), day_most(exact), whole);
        let clamps = |day: &DayExtremes| -> Vec<f64> {
            let ranges = day.restraints.iter();
            ranges.flat_map(|range| [range.min_n, range.max_n]).collect()
        };
        let on_clamps = largest(clamps(exact)).max(whole);
        for (found, exact) in clamps(found).into_iter().zip(clamps(exact)) {
            worst.note(CLAMP, found, exact, on_clamps);
        }
        let moved = largest(day_movements(exact)).max(scale.still);
        worst.all(MOVEMENT, day_movements(found), day_movements(exact), moved);
    }
    for (index, at) in pairs(&run.passes, &exact.passes, |pass| pass.pass) {
        let (found, exact) = (&run.passes[index], &exact.passes[at]);
        worst.all(AFTER, ends(found), ends(exact), scale.force);
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

fn ends(pass: &PassRecord) -> [f64; 2] {
    [pass.upstream_force_n, pass.downstream_force_n]
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

/// The least forces of a day: on each end and, as the largest tension, in the cable.
fn day_least(day: &DayExtremes) -> [f64; 3] {
    [day.upstream_min_n, day.downstream_min_n, -day.max_tension_n]
}

fn day_most(day: &DayExtremes) -> [f64; 3] {
    [day.upstream_max_n, day.downstream_max_n, day.max_compression_n]
}

fn day_forces(day: &DayExtremes) -> Vec<f64> {
    [day_least(day), day_most(day)].concat()
}

fn day_movements(day: &DayExtremes) -> [f64; 4] {
    let upstream = [day.upstream_displacement_min_m, day.upstream_displacement_max_m];
    let downstream = [
        day.downstream_displacement_min_m,
        day.downstream_displacement_max_m,
    ];
    [upstream[0], upstream[1], downstream[0], downstream[1]]
}
