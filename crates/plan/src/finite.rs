//! Every number of an answer is finite: checked where the answer is made, so that what comes later
//! need not look.
//!
//! JSON has no word for infinity, and serialises it as the `null` that stands for a missing value;
//! a table would hold the text `inf`.

use std::fmt::Debug;

use crate::error::Error;

/// Makes sure that no number of the answer is infinite or NaN.
///
/// # Errors
///
/// [`Error::NotFinite`] with the first such number and its field.
pub fn check(answer: &impl Debug) -> Result<(), Error> {
    // The long form of `Debug` has one field or element a line, and texts in quotes.
    let text = format!("{answer:#?}");
    let word = |line: &str| {
        let ends = line.ends_with("NaN,") || line.ends_with("inf,");
        let value = ends.then(|| line.rsplit(' ').next().unwrap_or_default().trim_end_matches(','))?;
        matches!(value, "NaN" | "inf" | "-inf").then(|| value.parse().unwrap_or(f64::NAN))
    };
    let Some((line, value)) = text
        .lines()
        .enumerate()
        .find_map(|(line, text)| Some((line, word(text)?)))
    else {
        return Ok(());
    };
    // An element of a list stands below its field.
    let named = text
        .lines()
        .take(line + 1)
        .filter_map(|line| line.split_once(": "));
    let field = named.last().map_or("", |(field, _)| field.trim()).to_owned();
    Err(Error::NotFinite { field, value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug)]
    #[allow(dead_code, reason = "what is read is its text")]
    struct Answer {
        title: &'static str,
        force_n: f64,
        positions_m: Vec<f64>,
        years: Option<f64>,
    }

    #[test]
    fn a_number_that_is_none_is_found_wherever_it_stands() {
        let good = || Answer {
            title: "x: NaN,\ninf",
            force_n: 1e300,
            positions_m: vec![0.0, -1e-300],
            years: None,
        };
        assert!(check(&good()).is_ok());
        let found = |answer: Answer| match check(&answer) {
            Err(Error::NotFinite { field, value }) => (field, value.to_bits()),
            other => panic!("{other:?} of {}", answer.title),
        };
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let force = Answer {
                force_n: bad,
                ..good()
            };
            assert_eq!(found(force), ("force_n".to_owned(), bad.to_bits()));
            let positions = Answer {
                positions_m: vec![0.0, bad],
                ..good()
            };
            assert_eq!(found(positions).0, "positions_m");
            let years = Answer {
                years: Some(bad),
                ..good()
            };
            assert_eq!(found(years).0, "years");
        }
    }
}
