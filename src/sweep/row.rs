//! The answer of one point, and how it stands in the journal.

use serde::{Deserialize, Serialize};

use crate::error::with_causes;
use crate::{Error, Run};

/// What one point of a sweep answers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
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
    /// What heat adds, over all days.
    #[serde(flatten, default)]
    pub heat: Option<HeatAnswer>,
}

/// What a cable that is heated every day shows over all days.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct HeatAnswer {
    /// Largest force on the downstream end \[N\].
    pub downstream_max_n: f64,
    /// Least force on the downstream end \[N\].
    pub downstream_min_n: f64,
    /// Largest force on the upstream end \[N\].
    pub upstream_max_n: f64,
    /// Least force on the upstream end \[N\].
    pub upstream_min_n: f64,
    /// Movement of the cable from day to day in the end \[m\], where days repeat but for that.
    pub drift_per_day_m: Option<f64>,
}

/// Why a point has no answer. The message is one line, as it stands in the table.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, thiserror::Error)]
#[error("{}", self.message())]
#[non_exhaustive]
pub enum PointError {
    /// The scene of this point is wrong.
    BadInput(String),
    /// The computation failed.
    Failed(String),
}

/// A point that is done.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Row {
    /// Number of the point in the grid, from 0.
    pub index: usize,
    /// The answer, or why there is none.
    pub outcome: Result<Answer, PointError>,
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
            heat: run.heat.as_ref().map(|heat| HeatAnswer {
                downstream_max_n: heat.all_days.downstream_max_n,
                downstream_min_n: heat.all_days.downstream_min_n,
                upstream_max_n: heat.all_days.upstream_max_n,
                upstream_min_n: heat.all_days.upstream_min_n,
                drift_per_day_m: heat.drift_per_day_m,
            }),
        })
    }
}

impl PointError {
    /// Its message.
    pub fn message(&self) -> &str {
        match self {
            Self::BadInput(message) | Self::Failed(message) => message,
        }
    }
}

impl From<Error> for PointError {
    /// Keeps the first line of the message: what follows shows the place in the file again.
    fn from(error: Error) -> Self {
        let message = with_causes(&error);
        let line = message.lines().next().unwrap_or_default();
        let line = line.replace(char::is_control, " ");
        if error.is_bad_input() {
            Self::BadInput(line)
        } else {
            Self::Failed(line)
        }
    }
}

impl Row {
    /// The row as a line without its end: a checksum, then JSON with all digits of its numbers.
    pub(super) fn to_line(&self) -> Result<String, serde_json::Error> {
        let text = serde_json::to_string(self)?;
        Ok(format!("{:016x} {text}", checksum(text.as_bytes())))
    }

    /// The row of a line; `None` for one that was not written whole, or holds a number that is not finite.
    pub(super) fn of_line(line: &str) -> Option<Self> {
        let (sum, text) = line.split_once(' ')?;
        let is_whole = u64::from_str_radix(sum, 16).ok()? == checksum(text.as_bytes());
        is_whole.then(|| serde_json::from_str(text).ok())?
    }
}

/// FNV-1a, 64 bits: distinguishes a torn line from a whole one, and one sweep from another.
pub fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |sum, &byte| {
        (sum ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows() -> [Row; 4] {
        let answer = Answer {
            downstream_force_n: 542.312_345_678_901_2,
            upstream_force_n: -0.0,
            max_compression_n: 1e-300,
            saturation_force_n: None,
            passes_to_95_percent: None,
            upstream_displacement_m: 0.1 + 0.2,
            downstream_displacement_m: -5e-324,
            error_estimate: f64::MAX,
            heat: None,
        };
        let saturated = Answer {
            saturation_force_n: Some(1.0 / 3.0),
            passes_to_95_percent: Some(u64::MAX),
            ..answer
        };
        let warm = Answer {
            heat: Some(HeatAnswer {
                downstream_max_n: 2.0 / 3.0,
                downstream_min_n: -1e-17,
                upstream_max_n: 0.0,
                upstream_min_n: f64::MIN,
                drift_per_day_m: None,
            }),
            ..answer
        };
        let refused = PointError::BadInput("out of range: found -1".into());
        [
            (7, Ok(answer)),
            (0, Ok(saturated)),
            (8, Ok(warm)),
            (123, Err(refused)),
        ]
        .map(|(index, outcome)| Row { index, outcome })
    }

    #[test]
    fn a_line_gives_its_row_back_to_the_last_bit() {
        for row in rows() {
            let line = row.to_line().expect("a line");
            assert!(!line.contains('\n'));
            let back = Row::of_line(&line).expect("a row");
            assert_eq!(back, row);
            if let (Ok(back), Ok(answer)) = (back.outcome, row.outcome) {
                let bits =
                    |answer: Answer| [answer.upstream_force_n, answer.error_estimate].map(f64::to_bits);
                assert_eq!(bits(back), bits(answer));
            }
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
            assert_eq!(Row::of_line(&row.to_line().expect("a line")), None);
        }
    }

    #[test]
    fn a_torn_or_changed_line_is_no_row() {
        for row in rows() {
            let line = row.to_line().expect("a line");
            for end in 0..line.len() {
                assert_eq!(Row::of_line(&line[..end]), None, "{}", &line[..end]);
            }
            let changed = line.replacen('1', "2", 1);
            assert_ne!(changed, line);
            assert_eq!(Row::of_line(&changed), None, "{changed}");
        }
    }

    #[test]
    fn an_error_is_one_line() {
        let message = Error::Unfit {
            key: "a\nb\tc",
            found: "d",
            reason: "e".into(),
        };
        assert_eq!(PointError::from(message), PointError::BadInput("a".into()));
    }

    #[test]
    fn the_checksum_is_fnv_1a() {
        // Published values: draft-eastlake-fnv, test vectors.
        assert_eq!(checksum(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(checksum(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(checksum(b"foobar"), 0x85944171f73967e8);
    }
}
