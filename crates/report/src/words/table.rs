//! Tables for a reader.

use super::answer::Answer;
use super::number::count;
use super::reader::Reader;
use creepage_plan::shown::{percent, spacing, time};
use creepage_run::{
    Candidate, ErrorSource, Limited, Part, PassRecord, Place, PlanSummary, Run,
    answer::{DayExtremes, after, in_rows, table_days, table_rows},
};
use creepage_scene::CableEnd;

/// Rows of texts under their heads.
pub struct Table {
    pub head: Vec<String>,
    pub rows: Vec<Vec<String>>,
    /// Columns of words that come first; the others hold numbers.
    pub words: usize,
}

impl Table {
    /// The `rows` below these heads.
    pub fn new<const COLUMNS: usize>(head: [&str; COLUMNS], rows: Vec<Vec<String>>, words: usize) -> Self {
        let head = head.map(str::to_owned).into();
        Self { head, rows, words }
    }
}

/// The force on an end or its movement, and what its column is called.
type Column = (String, CableEnd, Limited);

/// A column for each end and quantity of which some of `values` is not zero, or for all. A movement is called `moved`, its end in place of
/// the star; soft hyphens, as a phone is narrow.
fn columns(reader: &Reader, moved: &str, is_zero: impl Fn(CableEnd, Limited) -> bool) -> Vec<Column> {
    let column = |quantity, name: &str, end: CableEnd| {
        let name = name.replace('*', &narrow_name(end));
        (reader.head(&name, quantity), end, quantity)
    };
    let forces = CableEnd::ALL.map(|end| column(Limited::Force, "force *", end));
    let movements = CableEnd::ALL.map(|end| column(Limited::Movement, moved, end));
    let mut columns = [forces, movements].concat();
    let is_shown = |(_, end, quantity): &Column| !is_zero(*end, *quantity);
    if columns.iter().any(is_shown) {
        columns.retain(is_shown);
    }
    columns
}

/// The name of an end with a soft hyphen.
fn narrow_name(end: CableEnd) -> String {
    end.name().replace("stream", "\u{ad}stream")
}

/// Force \[N\] or displacement \[m\] of an end after a pass.
pub fn after_pass(record: &PassRecord, end: CableEnd, quantity: Limited) -> f64 {
    quantity.of([record.force_after(end), record.displacement(end)])
}

/// The least and the largest of them on a day.
pub fn over_day(day: &DayExtremes, end: CableEnd, quantity: Limited) -> [f64; 2] {
    quantity.of(day.of(end))
}

impl Answer<'_> {
    /// Some passes; without what stays zero, as the force on a free end. The largest compression has a column where there is room. The last
    /// column says in what rows differ.
    pub fn passes(&self, has_room: bool) -> Table {
        let Self { run, reader, scene } = self;
        let all = &run.passes;
        let columns = columns(reader, "moved *", |end, quantity| {
            all.iter().all(|record| after_pass(record, end, quantity) == 0.0)
        });
        let rows = table_rows(all, &scene.traffic);
        let a_day = run.heat.as_ref().map(|heat| heat.passes_per_day);
        let (kind, kinds) = in_rows(&rows, scene, a_day, run.random.is_some()).unzip();
        let mut head = vec!["after pass".to_owned()];
        head.extend(scene.traffic.per_day.map(|_| "time".to_owned()));
        head.extend(columns.iter().map(|(name, ..)| name.clone()));
        head.extend(has_room.then(|| reader.head("largest in cable", Limited::Force)));
        head.extend(kind.map(str::to_owned));
        let mut kinds = kinds.into_iter().flatten();
        let row = |record: &PassRecord| {
            let value = |end, quantity| reader.number(quantity, after_pass(record, end, quantity));
            let mut row = vec![count(record.pass)];
            row.extend(record.years.map(after));
            row.extend(columns.iter().map(|(_, end, quantity)| value(*end, *quantity)));
            row.extend(has_room.then(|| reader.number(Limited::Force, record.max_compression_n)));
            row.extend(kinds.next());
            row
        };
        let rows = rows.into_iter().map(row).collect();
        Table { head, rows, words: 0 }
    }

    /// Extremes of some days, without what stays zero; none of a cable that is not heated.
    pub fn days(&self) -> Option<Table> {
        let Self { run, reader, .. } = self;
        let heat = run.heat.as_ref()?;
        let columns = columns(reader, "place of the * end", |end, quantity| {
            let mut days = run.days.iter();
            days.all(|day| over_day(day, end, quantity) == [0.0; 2])
        });
        let row = |name: String, day: &DayExtremes| {
            let ranges = columns.iter().map(|(_, end, quantity)| {
                let range = over_day(day, *end, *quantity).map(|value| reader.number(*quantity, value));
                range.join(" to ")
            });
            std::iter::once(name).chain(ranges).collect()
        };
        let days = table_days(&run.days, heat.periodic_from_day).into_iter();
        let mut rows: Vec<Vec<String>> = days.map(|day| row(count(day.day), day)).collect();
        rows.push(row("all days".into(), &heat.all_days));
        let mut head = vec!["day".to_owned()];
        head.extend(columns.into_iter().map(|(name, ..)| name));
        Some(Table { head, rows, words: 0 })
    }

    /// What each clamp carries; none without clamps.
    pub fn clamps(&self) -> Option<Table> {
        let Self { run, reader, .. } = self;
        let slips = run.restraints.iter().any(|clamp| clamp.slipped_m.is_some());
        let rows = run.restraints.iter().map(|clamp| {
            let largest =
                |quantity| reader.number(quantity, run.largest(Place::Clamp(clamp.position_m), quantity));
            let mut row = vec![
                reader.length(clamp.position_m),
                reader.number(Limited::Force, clamp.force_n),
                largest(Limited::Force),
                largest(Limited::Movement),
            ];
            let slipped = |metres| reader.number(Limited::Movement, metres);
            row.extend(slips.then(|| clamp.slipped_m.map_or("–".into(), slipped)));
            row
        });
        let rows: Vec<Vec<String>> = rows.collect();
        let when = self.when_on_clamps();
        let mut head = vec![
            "clamp at".to_owned(),
            reader.head("force after the last pass", Limited::Force),
            reader.head(&format!("force at most {when}"), Limited::Force),
            reader.head(&format!("moved at most {when}"), Limited::Movement),
        ];
        head.extend(slips.then(|| reader.head("slipped in the end", Limited::Movement)));
        (!rows.is_empty()).then_some(Table { head, rows, words: 1 })
    }
}

/// Everything that was considered, and what became of it.
pub fn candidates(candidates: &[Candidate]) -> Table {
    let row = |candidate: &Candidate| {
        let cost = [
            candidate.estimated_error.map(percent),
            candidate.estimated_seconds.map(time),
        ];
        let fate = match candidate.part {
            _ if candidate.chosen => "chosen",
            Part::Mesh => "not taken at first",
            _ => "rejected",
        };
        vec![
            format!("{} {}: {fate}", candidate.part, candidate.name),
            cost.into_iter().flatten().collect::<Vec<_>>().join(", "),
            candidate.reason.clone(),
        ]
    };
    let head = ["model", "before the run: error, time", "why, or why not"];
    Table::new(head, candidates.iter().map(row).collect(), 3)
}

/// How a run was solved.
pub fn solved(plan: &PlanSummary, reader: &Reader) -> String {
    let unit = reader.units.length;
    let [node, step] = [plan.node_spacing_m, plan.vehicle_step_m].map(|length| spacing(unit.of_si(length)));
    let (ground, cable, unit) = (&plan.ground, &plan.cable, unit.symbol());
    format!("Ground {ground}, cable {cable}, node spacing {node} {unit}, vehicle step {step} {unit}.")
}

/// What the error of the forces comes from.
pub fn error_parts(run: &Run) -> Table {
    let parts = &run.error_estimate.parts;
    let row = |name: &str, share: f64| vec![name.to_owned(), percent(share)];
    let rows = ErrorSource::ALL.map(|source| row(source.name(), parts.of(source)));
    let movement = row("movement of the ends, all parts together", parts.movement);
    let rows = rows.into_iter().chain([movement]).collect();
    Table::new(["part", "error"], rows, 1)
}
