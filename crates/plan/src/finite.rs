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
/// [`Error::NoAnswer`] with the first such number and its field.
pub fn check(answer: &impl Debug) -> Result<(), Error> {
    // The long form of `Debug` has one field or element a line, and texts in quotes.
    let text = format!("{answer:#?}");
    let mut field = "";
    for line in text.lines().map(str::trim) {
        let value;
        // An element of a list stands below its field.
        (field, value) = line.split_once(": ").unwrap_or((field, line));
        if let "NaN," | "inf," | "-inf," = value {
            let value = value.trim_end_matches(',');
            let reason = format!("the computation failed: {field} came out as {value}");
            return Err(Error::NoAnswer { reason });
        }
    }
    Ok(())
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
            Err(Error::NoAnswer { reason }) => reason,
            other => panic!("{other:?} of {}", answer.title),
        };
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let reason = |field: &str| format!("the computation failed: {field} came out as {bad}");
            let force = Answer {
                force_n: bad,
                ..good()
            };
            assert_eq!(found(force), reason("force_n"));
            let positions = Answer {
                positions_m: vec![0.0, bad],
                ..good()
            };
            assert_eq!(found(positions), reason("positions_m"));
            let years = Answer {
                years: Some(bad),
                ..good()
            };
            assert_eq!(found(years), reason("years"));
        }
    }
}
