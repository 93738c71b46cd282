//! Force and movement over the passes.

use crate::PassRecord;
use crate::answer::selected;
use crate::report::Report;
use crate::report::figures;
use crate::report::html::{Html, Table};
use crate::report::quantity::{count, length};
use crate::shown::rounded;

use super::{MILLI, figure};

pub fn force(html: &mut Html, report: &Report) {
    html.raw("<div class=\"figures\">");
    let measured = match &report.agreement {
        None => String::new(),
        Some(agreement) => format!(
            " {} readings at the {} end; measured minus computed force of {} of them: mean {} N, root of the mean square {} N, \
             largest reading {} N.{}",
            agreement.readings.len(),
            agreement.end.name(),
            agreement.compared,
            rounded(agreement.mean_n, 1),
            rounded(agreement.rms_n, 1),
            rounded(agreement.largest_n, 1),
            if agreement.readings.iter().any(|reading| reading.sigma.is_some()) {
                " Bars are one standard deviation long to either side."
            } else {
                ""
            }
        ),
    };
    figure(
        html,
        &figures::force(report),
        &format!("Force after each pass, compression positive. A free end carries none.{measured}"),
    );
    figure(
        html,
        &figures::along(report),
        "Force along the cable after the passes named, compression positive.",
    );
    figure(
        html,
        &figures::movement(report),
        "Displacement of the cable’s ends, positive toward growing x, downstream.",
    );
    html.table(&passes(report));
    html.raw("</div>");
    for clamp in &report.run.restraints {
        html.paragraph(&format!(
            "The clamp at {} carries {} N.",
            length(clamp.position_m),
            rounded(clamp.force_n, 1)
        ));
    }
}

/// Some passes, as the terminal shows them; without what stays zero, as the force on a free end.
fn passes(report: &Report) -> Table {
    type Column = (&'static str, fn(&PassRecord) -> f64, usize);
    // Soft hyphens: a phone is narrow.
    const COLUMNS: [Column; 4] = [
        ("force up\u{ad}stream, N", |record| record.upstream_force_n, 1),
        ("force down\u{ad}stream, N", |record| record.downstream_force_n, 1),
        (
            "moved up\u{ad}stream, mm",
            |record| MILLI * record.upstream_displacement_m,
            4,
        ),
        (
            "moved down\u{ad}stream, mm",
            |record| MILLI * record.downstream_displacement_m,
            4,
        ),
    ];
    let passes = &report.run.passes;
    let is_told = |(_, value, _): &Column| passes.iter().any(|record| value(record) != 0.0);
    let columns: Vec<Column> = if COLUMNS.iter().any(is_told) {
        COLUMNS.into_iter().filter(is_told).collect()
    } else {
        COLUMNS.to_vec()
    };
    let row = |record: &PassRecord| {
        let values = columns
            .iter()
            .map(|(_, value, decimals)| rounded(value(record), *decimals));
        std::iter::once(count(record.pass)).chain(values).collect()
    };
    let names = columns.iter().map(|(name, ..)| *name);
    Table {
        head: std::iter::once("pass").chain(names).map(str::to_owned).collect(),
        rows: selected(passes).into_iter().map(row).collect(),
        numbers: vec![true; 1 + columns.len()],
    }
}
