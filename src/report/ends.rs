//! Both ends in figures and tables: upstream first, each with a look of its own.

use super::quantity::Shown;
use crate::answer::DayPoint;
use crate::figure::{Chart, Series};
use crate::scene::{End, Scene};
use crate::{CableEnd, PassRecord};

/// Look of what is neither of the ends.
pub const OTHER: usize = 2;

/// The ends that are not free: a free one carries nothing.
pub fn held(scene: &Scene) -> Vec<CableEnd> {
    let all = CableEnd::ALL.into_iter();
    all.filter(|end| end.held_in(scene) != End::Free).collect()
}

/// `chart` with a line for each of `ends`; its name has `more` behind that of the end.
pub fn lines<Points: IntoIterator<Item = (f64, f64)>>(
    chart: Chart,
    ends: &[CableEnd],
    more: Option<&str>,
    points: impl Fn(CableEnd) -> Points,
) -> Chart {
    ends.iter().fold(chart, |chart, end| {
        let name = more.map_or_else(String::new, |more| format!("{} end{more}", end.name()));
        chart.with(Series::line(name, points(*end)).look(end.of([1, 0])))
    })
}

/// A column of a table for each end: its head, whose value it has, and whether that is a force or a movement. Soft hyphens: a phone is narrow.
pub fn columns(shown: &Shown, moved: &str) -> Vec<(String, CableEnd, usize)> {
    let name = |end: CableEnd| end.name().replace("stream", "\u{ad}stream");
    let forces = CableEnd::ALL.map(|end| (shown.in_force(&format!("force {}", name(end))), end, 0));
    let movements = CableEnd::ALL.map(|end| (shown.in_movement(&moved.replace('*', &name(end))), end, 1));
    forces.into_iter().chain(movements).collect()
}

/// Force \[N\] and displacement \[m\] of an end after a pass.
pub fn of_pass(record: &PassRecord, end: CableEnd) -> [f64; 2] {
    [record.force_after(end), record.displacement(end)]
}

/// The same at a time of the day.
pub fn of_time(point: &DayPoint, end: CableEnd) -> [f64; 2] {
    end.of([
        [point.upstream_force_n, point.upstream_displacement_m],
        [point.downstream_force_n, point.downstream_displacement_m],
    ])
}
