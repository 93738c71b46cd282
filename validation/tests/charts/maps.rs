//! The maps of where methods fail, and what calibrations hold.

use std::error::Error;

use creepage_validation::table;

use super::{Tested, folder};

/// With the program's checks no cell of a map is wrong, and without them many are.
#[test]
fn with_guards_no_cell_of_a_map_is_wrong() -> Tested {
    // The columns that name the map or model and what came out of a cell.
    let maps = [
        ("explicit", 0, 3, "guards on"),
        ("implicit", 0, 3, "quasi-static solver"),
        ("long-term", 0, 3, "guards on"),
        ("fem-ratio", 2, 3, "layered-fem"),
        ("fem-thickness", 2, 3, "layered-fem"),
        ("burmister", 2, 3, "burmister"),
    ];
    for (name, series, outcome, guarded) in maps {
        let mut reader = table::read(&folder().join(format!("stability-{name}.csv")))?;
        let (mut right, mut wrong_without) = (0, 0);
        for record in reader.records() {
            let record = record?;
            let wrong = record[outcome].starts_with("wrong");
            if record[series].ends_with(guarded) {
                assert!(!wrong, "{name}: {record:?}");
                right += usize::from(record[outcome].starts_with("right"));
            } else {
                wrong_without += usize::from(wrong);
            }
        }
        assert!(
            right > 0 && wrong_without > 20,
            "{name}: {right}, {wrong_without}"
        );
    }
    let mut reader = table::read(&folder().join("stability-heat.csv"))?;
    for record in reader.records() {
        let record = record?;
        assert!(record[3].starts_with("within"), "heat: {record:?}");
    }
    Ok(())
}

/// No fit that identifies the shape factor is wrong, and few intervals miss it; a noise of 30 N hides it.
#[test]
fn an_identified_shape_factor_is_right() -> Tested {
    let mut reader = table::read(&folder().join("stability-calibration.csv"))?;
    let header = reader.headers()?.clone();
    let (mut identified, mut missed) = (0, 0);
    for record in reader.records() {
        let record = record?;
        let count = |name: &str| -> Result<usize, Box<dyn Error>> {
            let column = header.iter().position(|found| found == name);
            Ok(record[column.ok_or_else(|| name.to_owned())?].parse()?)
        };
        assert_eq!((count("wrong")?, count("failed")?), (0, 0), "{record:?}");
        let here = count("right")? + count("missed_the_interval")?;
        assert!(record[1].parse::<f64>()? < 30.0 || here == 0, "{record:?}");
        identified += here;
        missed += count("missed_the_interval")?;
    }
    assert!(
        identified > 6000 && missed < identified / 20,
        "{identified} {missed}"
    );
    Ok(())
}

/// A row of the chart `discrepancy`: the model, whether it is wrong, whether a discrepancy was allowed, and shares of the draws.
struct Draws {
    model: String,
    wrong: bool,
    allowed: bool,
    held: f64,
    claimed: f64,
    width: f64,
}

fn draws() -> Result<Vec<Draws>, Box<dyn Error>> {
    let mut reader = table::read(&folder().join("discrepancy.csv"))?;
    let mut rows: Vec<Draws> = Vec::new();
    for record in reader.records() {
        let record = record?;
        let number = |column: usize| record[column].parse::<f64>();
        let (model, draws) = (record[0].to_owned(), number(4)?);
        // The first value of each model is the truth, but Coulomb's law is never that of a cable that gives.
        let before = rows.iter().filter(|row| row.model == model).count();
        rows.push(Draws {
            wrong: before > 1 || model.starts_with("Coulomb"),
            allowed: &record[3] == "with",
            held: number(5)? / draws,
            claimed: number(6)? / draws,
            width: number(7)?,
            model,
        });
    }
    Ok(rows)
}

/// Where the model is wrong, an interval without a discrepancy seldom holds the truth; with one it nearly always does.
#[test]
fn a_discrepancy_keeps_intervals_honest_where_the_model_is_wrong() -> Tested {
    let rows = draws()?;
    let of = |allowed: bool, wrong: bool| {
        rows.iter()
            .filter(move |row| (row.allowed, row.wrong) == (allowed, wrong))
    };
    let mean = |allowed: bool, wrong: bool| {
        let shares: Vec<f64> = of(allowed, wrong).map(|row| row.held).collect();
        shares.iter().sum::<f64>() / shares.len() as f64
    };
    assert_eq!((of(true, true).count(), of(false, true).count()), (10, 10));
    assert!(mean(false, true) < 0.35, "{}", mean(false, true));
    assert!(mean(true, true) > 0.85, "{}", mean(true, true));
    assert!(of(true, true).filter(|row| row.held > 0.9).count() >= 8);
    // Ground a fifth too stiff, and axles so far apart that no friction gives the forces: that is not called identifiable.
    for row in of(true, true) {
        assert!(
            row.held > 0.7 || row.claimed == 0.0,
            "{}: {}",
            row.model,
            row.held
        );
    }
    assert!(of(true, true).map(|row| row.claimed).sum::<f64>() < 0.05 * 10.0);
    // What it costs where the model is right.
    for (with, without) in of(true, false).zip(of(false, false)) {
        assert!(
            without.held > 0.9 && with.width < 3.0 * without.width,
            "{}: {} {}",
            with.model,
            with.width,
            without.width
        );
    }
    Ok(())
}

/// What a bend costs that presses with the force of the step before: nothing if it is wide, and the more the tighter it is.
#[test]
fn wide_bends_cost_nothing() -> Tested {
    let mut reader = table::read(&folder().join("stability-bends.csv"))?;
    let mut tight = 0.0_f64;
    for row in reader.deserialize() {
        let row: [f64; 5] = row?;
        let [stiffness, radius, friction, error, _] = row;
        assert!(radius < 8.9 || error <= 3.6e-3, "{row:?}");
        assert!(radius < 28.0 || error <= 3e-4, "{row:?}");
        assert!(stiffness > 1e7 || error <= 5e-3, "{row:?}");
        assert!(friction > 0.5 || radius < 2.0 || error <= 7e-3, "{row:?}");
        tight = tight.max(error);
    }
    assert!((0.05..0.07).contains(&tight), "{tight}");
    Ok(())
}

/// Friction that changes in one place costs what the mesh costs anyway, unless it locks the cable there.
#[test]
fn sections_of_similar_friction_cost_nothing() -> Tested {
    let mut reader = table::read(&folder().join("stability-sections.csv"))?;
    let mut locked = 0.0_f64;
    for row in reader.deserialize() {
        let row: [f64; 4] = row?;
        let [ratio, friction, error, _] = row;
        assert!(ratio > 1.8 || error <= 1.4e-2, "{row:?}");
        assert!(ratio * friction > 1.4 || error <= 1.5e-2, "{row:?}");
        locked = locked.max(error);
    }
    assert!((0.09..0.11).contains(&locked), "{locked}");
    Ok(())
}

/// Random scenes over the whole range of every key: no answer is wrong, few are missing or late, and what is stated holds.
#[test]
fn answers_over_the_whole_range_can_be_true() -> Tested {
    let mut reader = table::read(&folder().join("whole-range.csv"))?;
    let header = reader.headers()?.clone();
    let column = |name: &str| header.iter().position(|column| column == name);
    let mut counts = std::collections::BTreeMap::<String, f64>::new();
    let (mut twins, mut apart) = (0, Vec::new());
    let (mut compared, mut beyond, mut beyond_both) = (0.0, 0.0, 0.0);
    for record in reader.records() {
        let record = record?;
        let number = |name: &str| column(name).and_then(|column| record[column].parse::<f64>().ok());
        *counts.entry(record[1].to_owned()).or_default() += 1.0;
        // How far it is from another run by these columns, if that was made.
        let off = |names: &[&str]| names.iter().filter_map(|name| number(name)).reduce(f64::max);
        let stated = number("stated");
        let (force, movement) = (
            off(&["mirror", "larger"]),
            off(&["mirror_movement", "larger_movement"]),
        );
        twins += usize::from(force.is_some());
        if force > stated || movement > number("stated_movement") {
            apart.push(record[0].to_owned());
        }
        let finer = off(&["after", "peak", "least", "clamp"]);
        compared += f64::from(u8::from(finer.is_some()));
        // The finer run is wrong too, by what it states.
        let sum = |one: &str, other: &str| Some(number(one)? + number(other)?);
        let is_beyond = |force, movement| finer > force || number("movement") > movement;
        beyond += f64::from(u8::from(is_beyond(stated, number("stated_movement"))));
        let (force, movement) = (
            sum("stated", "finer_stated"),
            sum("stated_movement", "finer_stated_movement"),
        );
        beyond_both += f64::from(u8::from(is_beyond(force, movement)));
    }
    let all: f64 = counts.values().sum();
    let share = |name: &str| counts.get(name).map_or(0.0, |count| count / all);
    assert!(all >= 10000.0 && share("wrong") == 0.0, "{counts:?}");
    assert!(share("refused") < 0.01 && share("late") < 0.01, "{counts:?}");
    // Three movements, and a clamp that is pulled as hard as it is pressed.
    assert!(twins > 600, "{twins}");
    assert_eq!(apart, ["6986", "7308", "9338", "10038"]);
    assert!(
        compared > 500.0 && beyond <= 0.05 * compared && beyond_both <= 0.03 * compared,
        "{beyond} and {beyond_both} of {compared}"
    );
    Ok(())
}
