//! The answer of one point, and how it stands in the journal.

use std::fmt::Write;

use crate::Run;

/// What one point of a sweep answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// Force on the downstream end after the last pass \[N\].
    pub downstream_force_n: f64,
    /// Force on the upstream end after the last pass \[N\].
    pub upstream_force_n: f64,
    /// Largest compression along the cable after the last pass \[N\].
    pub max_compression_n: f64,
    /// Where the force levels off \[N\], if it does.
    pub saturation_force_n: Option<f64>,
    /// Passes to 95 % of that.
    pub passes_to_95_percent: Option<u64>,
    /// Displacement of the upstream end after the last pass \[m\].
    pub upstream_displacement_m: f64,
    /// Displacement of the downstream end after the last pass \[m\].
    pub downstream_displacement_m: f64,
    /// Estimated relative error of the forces.
    pub error_estimate: f64,
}

/// A point that is done: its answer, or why there is none.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Number of the point in the grid, from 0.
    pub index: usize,
    /// The answer, or the error in one line.
    pub outcome: Result<Answer, String>,
}

impl Answer {
    /// The last pass of a run; `None` for a run without passes.
    pub fn of(run: &Run) -> Option<Self> {
        let last = run.passes.last()?;
        Some(Self {
            downstream_force_n: last.downstream_force_n,
            upstream_force_n: last.upstream_force_n,
            max_compression_n: last.max_compression_n,
            saturation_force_n: run.saturation.map(|saturation| saturation.force_n),
            passes_to_95_percent: run.saturation.map(|saturation| saturation.passes_to_95_percent),
            upstream_displacement_m: last.upstream_displacement_m,
            downstream_displacement_m: last.downstream_displacement_m,
            error_estimate: run.error_estimate.relative,
        })
    }
}

const ABSENT: &str = "-";
const ERROR: &str = "error";

impl Row {
    /// The row as a line without its end: checksum, number, and the answer's numbers to the last digit.
    pub fn to_line(&self) -> String {
        let mut text = self.index.to_string();
        // Writing to a text does not fail.
        match &self.outcome {
            Ok(answer) => {
                let optional =
                    |value: Option<f64>| value.map_or_else(|| ABSENT.to_owned(), |v| format!("{v:e}"));
                let passes = answer.passes_to_95_percent;
                let _ = write!(
                    text,
                    " {:e} {:e} {:e} {} {} {:e} {:e} {:e}",
                    answer.downstream_force_n,
                    answer.upstream_force_n,
                    answer.max_compression_n,
                    optional(answer.saturation_force_n),
                    passes.map_or_else(|| ABSENT.to_owned(), |passes| passes.to_string()),
                    answer.upstream_displacement_m,
                    answer.downstream_displacement_m,
                    answer.error_estimate
                );
            }
            Err(message) => {
                let _ = write!(text, " {ERROR} {}", one_line(message));
            }
        }
        format!("{:016x} {text}", checksum(text.as_bytes()))
    }

    /// The row of a line; `None` for one that was not written whole.
    pub fn of_line(line: &str) -> Option<Self> {
        let (sum, text) = line.split_once(' ')?;
        if u64::from_str_radix(sum, 16).ok()? != checksum(text.as_bytes()) {
            return None;
        }
        let (index, rest) = text.split_once(' ')?;
        let index = index.parse().ok()?;
        if let Some(message) = rest.strip_prefix(ERROR) {
            let outcome = Err(message.trim_start().to_owned());
            return Some(Self { index, outcome });
        }
        let mut words = rest.split(' ');
        let finite = |word: &str| word.parse().ok().filter(|value: &f64| value.is_finite());
        let mut number = || finite(words.next()?);
        let (downstream_force_n, upstream_force_n, max_compression_n) = (number()?, number()?, number()?);
        let saturation_force_n = match words.next()? {
            ABSENT => None,
            word => Some(finite(word)?),
        };
        let passes_to_95_percent = match words.next()? {
            ABSENT => None,
            word => Some(word.parse().ok()?),
        };
        let mut number = || finite(words.next()?);
        let answer = Answer {
            downstream_force_n,
            upstream_force_n,
            max_compression_n,
            saturation_force_n,
            passes_to_95_percent,
            upstream_displacement_m: number()?,
            downstream_displacement_m: number()?,
            error_estimate: number()?,
        };
        Some(Self {
            index,
            outcome: Ok(answer),
        })
    }
}

/// The first line of a message: what follows shows the place in the file again.
fn one_line(message: &str) -> String {
    let line = message.lines().next().unwrap_or_default();
    line.chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect()
}

/// FNV-1a, 64 bits: tells a torn line from a whole one, and one sweep from another.
pub fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, &byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows() -> [Row; 3] {
        let answer = Answer {
            downstream_force_n: 542.312_345_678_901_2,
            upstream_force_n: -0.0,
            max_compression_n: 1e-300,
            saturation_force_n: None,
            passes_to_95_percent: None,
            upstream_displacement_m: 0.1 + 0.2,
            downstream_displacement_m: -5e-324,
            error_estimate: f64::MAX,
        };
        let saturated = Answer {
            saturation_force_n: Some(1.0 / 3.0),
            passes_to_95_percent: Some(u64::MAX),
            ..answer
        };
        [
            Row {
                index: 7,
                outcome: Ok(answer),
            },
            Row {
                index: 0,
                outcome: Ok(saturated),
            },
            Row {
                index: 123,
                outcome: Err("out of range: found -1\n  |\n".into()),
            },
        ]
    }

    #[test]
    fn a_line_gives_its_row_back_to_the_last_bit() {
        for row in rows() {
            let line = row.to_line();
            assert!(!line.contains('\n'));
            let back = Row::of_line(&line).expect("a row");
            let expected = Row {
                index: row.index,
                outcome: row.outcome.map_err(|_| "out of range: found -1".to_owned()),
            };
            assert_eq!(back, expected);
        }
    }

    #[test]
    fn a_number_that_is_none_is_no_row() {
        for value in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            let [mut row, ..] = rows();
            let Ok(answer) = &mut row.outcome else {
                panic!("an answer")
            };
            answer.error_estimate = value;
            assert_eq!(Row::of_line(&row.to_line()), None);
        }
    }

    #[test]
    fn a_torn_or_changed_line_is_no_row() {
        for row in rows() {
            let line = row.to_line();
            for end in 0..line.len() {
                assert_eq!(Row::of_line(&line[..end]), None, "{}", &line[..end]);
            }
            assert_eq!(
                Row::of_line(
                    &line
                        .replacen("e0", "e1", 1)
                        .replacen("found", "fount", 1)
                        .replacen("e2", "e3", 1)
                ),
                None
            );
        }
    }

    #[test]
    fn the_checksum_is_fnv_1a() {
        // Published values: draft-eastlake-fnv, test vectors.
        assert_eq!(checksum(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(checksum(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(checksum(b"foobar"), 0x85944171f73967e8);
    }
}
