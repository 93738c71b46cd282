//! What is asked of a run with jumps.

use std::ops::RangeInclusive;

use cable_dem::CableState;

use crate::JumpError;

/// How jumps are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jumps {
    pub(crate) tolerance: f64,
    pub(crate) first_periods: u64,
    pub(crate) first_jump: f64,
    pub(crate) length_scale: f64,
    pub(crate) motion: f64,
    pub(crate) least: (f64, f64),
    pub(crate) most_passes: (u64, u64),
    pub(crate) of_days: bool,
}

impl Jumps {
    /// Jumps whose error, where they are checked, is at most `tolerance` as a share of the largest force or movement so far. Forces on the
    /// way differ from simulated ones by about as much at most, most of it early. The slope is averaged over `length_scale` \[m\],
    /// over which the duct's motion changes, at least its depth; `motion` is max |D_l| of all vehicles \[m\].
    ///
    /// Eight periods are simulated at the start, enough for any cable seen so far, and the first jump is a quarter as long.
    ///
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] unless tolerance and length are finite and positive and the motion is finite and not negative.
    pub fn new(tolerance: f64, length_scale: f64, motion: f64) -> Result<Self, JumpError> {
        positive("tolerance", tolerance)?;
        positive("length_scale", length_scale)?;
        not_negative("motion", motion)?;
        Ok(Self {
            tolerance,
            first_periods: 8,
            first_jump: 0.25,
            length_scale,
            motion,
            least: (0.0, 0.0),
            most_passes: (1000, 10_000),
            of_days: false,
        })
    }

    /// With so many `periods` simulated at the start, at least two, and a first jump whose length is the share `jump` of these. Runs that are to
    /// show each other's error begin differently: 0.5 and 0.25.
    ///
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] for fewer periods, or unless the share is finite and positive.
    pub fn with_start(self, periods: u64, jump: f64) -> Result<Self, JumpError> {
        valid("periods at the start", periods >= 2, "at least 2")?;
        positive("first jump", jump)?;
        Ok(Self {
            first_periods: periods,
            first_jump: jump,
            ..self
        })
    }

    /// With a force \[N\] and a movement \[m\] below which all is nothing.
    ///
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] unless both are finite and not negative.
    pub fn with_least(self, force: f64, movement: f64) -> Result<Self, JumpError> {
        not_negative("least force", force)?;
        not_negative("least movement", movement)?;
        Ok(Self {
            least: (force, movement),
            ..self
        })
    }

    /// Over days, whose "passes" are all that happens in a day: what counts as large is so at any moment of a period, and periods that would
    /// change little if all of them were like the last one are taken to be like it.
    #[must_use]
    pub(crate) fn over_days(self, of_days: bool) -> Self {
        Self { of_days, ..self }
    }

    /// With the passes after which every one is simulated until nothing changes any more, and those after which the run gives up.
    #[must_use]
    pub fn with_most_passes(self, jumping: u64, simulated: u64) -> Self {
        Self {
            most_passes: (jumping, simulated),
            ..self
        }
    }
}

/// Traffic and what is wanted to know of it.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    pub(crate) passes: u64,
    pub(crate) order: &'a [usize],
    pub(crate) one_by_one: (u64, u64),
    pub(crate) wanted: &'a [u64],
    pub(crate) looked_at: &'a [u64],
    pub(crate) beyond: &'a [u64],
    pub(crate) periods: &'a [u64],
    pub(crate) state: Option<&'a CableState>,
    pub(crate) guide: Guide<'a>,
}

impl<'a> Request<'a> {
    /// So many `passes` in all, by the vehicles of a period in their `order`, after which the traffic repeats: only which of them are the
    /// same counts.
    ///
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] for a period without vehicles.
    pub fn new(passes: u64, order: &'a [usize]) -> Result<Self, JumpError> {
        valid("vehicles of a period", !order.is_empty(), "at least one")?;
        Ok(Self {
            passes,
            order,
            one_by_one: (0, 0),
            wanted: &[],
            looked_at: &[],
            beyond: &[],
            periods: &[],
            state: None,
            guide: Guide::Free,
        })
    }

    /// With these passes recorded.
    ///
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] unless they are in ascending order, from 1.
    pub fn with_wanted(self, wanted: &'a [u64]) -> Result<Self, JumpError> {
        let ascending = wanted.is_sorted_by(|a, b| a < b) && wanted.first() != Some(&0);
        valid("wanted passes", ascending, "ascending, from 1")?;
        Ok(Self { wanted, ..self })
    }

    /// With passes beyond the last one recorded: where the forces lead.
    ///
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] unless they are in ascending order, beyond the last pass.
    pub fn with_beyond(self, beyond: &'a [u64]) -> Result<Self, JumpError> {
        let ascending = beyond.is_sorted_by(|a, b| a < b);
        let is_beyond = beyond.first().is_none_or(|first| *first > self.passes);
        valid(
            "passes beyond the last",
            ascending && is_beyond,
            "ascending, beyond the last",
        )?;
        Ok(Self { beyond, ..self })
    }

    /// With the passes recorded, in these periods, ascending from 1, that show the largest forces and movements: all of them where they are
    /// simulated.
    pub(crate) fn with_periods(self, periods: &'a [u64]) -> Self {
        Self { periods, ..self }
    }

    /// With the cable in this state before the first pass, not as laid.
    pub(crate) fn with_state(self, state: &'a CableState) -> Self {
        Self {
            state: Some(state),
            ..self
        }
    }

    /// With these of the wanted passes shown to `pass` also where they lie within a jump, from the state that is interpolated before them;
    /// what is recorded is interpolated all the same.
    #[must_use]
    pub fn with_looked_at(self, looked_at: &'a [u64]) -> Self {
        Self { looked_at, ..self }
    }

    /// With so many passes at the beginning and at the end simulated in any case, those at the end without jumps: there others may drive
    /// than those of the period.
    #[must_use]
    pub fn with_one_by_one(self, first: u64, last: u64) -> Self {
        Self {
            one_by_one: (first, last),
            ..self
        }
    }

    /// With the jumps of another run taken again.
    #[must_use]
    pub fn with_guide(self, guide: Guide<'a>) -> Self {
        Self { guide, ..self }
    }

    /// Vehicles in a period.
    pub(crate) fn period(&self) -> u64 {
        self.order.len() as u64
    }

    /// The passes of this range that are to be recorded, ascending, where those at these `places` show the largest of a period.
    pub(crate) fn recorded(&self, range: RangeInclusive<u64>, places: &[usize]) -> Vec<u64> {
        let length = self.period();
        let periods = self.periods.iter().map(|period| (period - 1) * length);
        let largest = periods.flat_map(|before| places.iter().map(move |&place| before + place as u64 + 1));
        let asked = self.wanted.iter().chain(self.beyond).copied();
        let mut passes: Vec<u64> = asked.chain(largest).filter(|pass| range.contains(pass)).collect();
        passes.sort_unstable();
        passes.dedup();
        passes
    }

    /// Whether `pass` is to be recorded.
    pub(crate) fn wants(&self, pass: u64) -> bool {
        let is_in = |list: &[u64], number: u64| list.binary_search(&number).is_ok();
        is_in(self.wanted, pass)
            || is_in(self.beyond, pass)
            || is_in(self.periods, pass.div_ceil(self.period()))
    }
}

fn valid(name: &'static str, is_valid: bool, allowed: &'static str) -> Result<(), JumpError> {
    if is_valid {
        Ok(())
    } else {
        Err(JumpError::InvalidParameter { name, allowed })
    }
}

fn positive(name: &'static str, value: f64) -> Result<(), JumpError> {
    valid(name, value.is_finite() && value > 0.0, "finite and positive")
}

fn not_negative(name: &'static str, value: f64) -> Result<(), JumpError> {
    valid(name, value.is_finite() && value >= 0.0, "finite and not negative")
}

/// Jumps of another run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Guide<'a> {
    /// None.
    #[default]
    Free,
    /// These as long as their errors allow it, so that runs on two meshes differ by their meshes alone.
    Follow(&'a [u64]),
    /// Exactly these, so that an answer is smooth in its parameters.
    Obey(&'a [u64]),
}

impl Guide<'_> {
    /// The length at `place`, where the guide has one.
    pub(crate) fn length(self, place: usize) -> Option<u64> {
        match self {
            Self::Free => None,
            Self::Follow(lengths) | Self::Obey(lengths) => lengths.get(place).copied(),
        }
    }
}

/// A pass that is to be simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Next {
    /// Its place in the period.
    pub phase: usize,
    /// Its number, from 1; `None` for one that only measures.
    pub number: Option<u64>,
}
