//! Limits of force and movement on the command line.

use super::failure::Failure;
use super::terminal;
use crate::scene::{Dimension, End, Ends};
use crate::{CableEnd, EndLimits, Limits};

#[derive(Debug, clap::Args)]
pub struct LimitArguments {
    /// Largest force allowed on both ends, 2kN, or on one, downstream=2kN; may be repeated
    #[arg(long, value_name = "[END=]FORCE", allow_negative_numbers = true, value_parser = |text: &str| limit(text, Dimension::Force))]
    limit_force: Vec<Limit>,
    /// Largest movement allowed of the ends that are not free, 10mm, or of any one, upstream=10mm; may be repeated
    #[arg(long, value_name = "[END=]LENGTH", allow_negative_numbers = true, value_parser = |text: &str| limit(text, Dimension::Length))]
    limit_movement: Vec<Limit>,
}

/// A limit and the end it is for; for both where none is named.
#[derive(Debug, Clone, Copy)]
struct Limit {
    end: Option<CableEnd>,
    value: f64,
}

fn limit(text: &str, dimension: Dimension) -> Result<Limit, String> {
    let (end, value) = match text.split_once('=') {
        None => (None, text),
        Some((name, value)) => {
            let end = CableEnd::ALL.into_iter().find(|end| end.name() == name.trim());
            let end = end.ok_or("allowed before `=`: upstream or downstream")?;
            (Some(end), value)
        }
    };
    let value = dimension
        .parse_argument(value)
        .map_err(|error| error.to_string())?;
    if value > 0.0 && value.is_finite() {
        return Ok(Limit { end, value });
    }
    Err("allowed: a finite value greater than 0".to_owned())
}

/// Smallest force \[N\] and largest movement \[m\] that a limit is likely to be.
const LEAST_FORCE: f64 = 10.0;
const MOST_MOVEMENT: f64 = 1.0;

impl LimitArguments {
    /// Warns of bare numbers that were probably meant in another unit.
    fn warn_of_slips(&self) {
        for Limit { value, .. } in self.limit_force.iter().filter(|limit| limit.value < LEAST_FORCE) {
            terminal::warn(format_args!(
                "--limit-force is {value} N: did you mean {value}kN?"
            ));
        }
        for Limit { value, .. } in self
            .limit_movement
            .iter()
            .filter(|limit| limit.value > MOST_MOVEMENT)
        {
            terminal::warn(format_args!(
                "--limit-movement is {value} m: did you mean {value}mm?"
            ));
        }
    }

    pub fn are_given(&self) -> bool {
        !self.limit_force.is_empty() || !self.limit_movement.is_empty()
    }

    /// The limits of a cable with these ends. Without a name a limit is that of the ends that are not free; what is named counts before what
    /// is not.
    pub fn limits(&self, ends: Ends) -> Result<Limits, Failure> {
        self.warn_of_slips();
        let held = |end: CableEnd| match end {
            CableEnd::Upstream => ends.upstream != End::Free,
            CableEnd::Downstream => ends.downstream != End::Free,
        };
        let none = !CableEnd::ALL.into_iter().any(held);
        let mut limits = Limits::default();
        for end in CableEnd::ALL {
            let of = |given: &[Limit]| {
                let named = given.iter().rfind(|limit| limit.end == Some(end));
                // A free end carries nothing, and moves as far as it does.
                let both = given.iter().rfind(|limit| limit.end.is_none() && held(end));
                named.or(both).map(|limit| limit.value)
            };
            *limits.of_mut(end) = EndLimits {
                force_n: of(&self.limit_force),
                movement_m: of(&self.limit_movement),
            };
        }
        if none && self.limit_movement.iter().any(|limit| limit.end.is_none()) {
            return Err(Failure::Usage {
                argument: "--limit-movement",
                found: "no end by its name, where both are free".into(),
                allowed: "the end that must not move farther, such as downstream=10mm".into(),
            });
        }
        Ok(limits)
    }
}
