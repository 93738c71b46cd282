//! How jumps are taken, and what is wanted of a run.

use cable_dem::CableState;

use crate::JumpError;
use crate::error::check;
use crate::scale::Scale;
use crate::tuning::{MAX_ERROR, MAX_ERROR_GUIDED};

/// How jumps are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jumps {
    pub(crate) tolerance: f64,
    pub(crate) length_scale: f64,
    pub(crate) least: Scale,
    pub(crate) first_periods: u64,
    pub(crate) first_jump: f64,
    pub(crate) max_passes: (u64, u64),
}

impl Jumps {
    /// Jumps with an error of at most `tolerance`, as a share of the largest force or movement so
    /// far. Forces within jumps have about that error at most, most of it early. The slope is
    /// averaged over `length_scale` \[m\], over which the duct's motion changes: at least its
    /// depth. Forces and movements below `least` \[N, m\] count as nothing; about 1 % of the
    /// friction on a metre of cable, and a tenth of the duct's largest motion.
    ///
    /// Eight periods are simulated at the start, and the first jump is a quarter as long.
    ///
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] unless all are finite and positive.
    pub fn new(tolerance: f64, length_scale: f64, least: (f64, f64)) -> Result<Self, JumpError> {
        positive("tolerance", tolerance)?;
        positive("length scale", length_scale)?;
        positive("least force", least.0)?;
        positive("least movement", least.1)?;
        Ok(Self {
            tolerance,
            length_scale,
            least: Scale {
                force: least.0,
                movement: least.1,
            },
            first_periods: 8,
            first_jump: 0.25,
            max_passes: (1000, 10_000),
        })
    }

    /// With so many `periods` simulated at the start, at least two, and a first jump whose length
    /// is the share `jump` of these. Two runs that start differently, with 0.5 and 0.25, show
    /// their error by their difference.
    ///
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] for fewer periods, or unless the share is finite and
    /// positive.
    pub fn with_start(self, periods: u64, jump: f64) -> Result<Self, JumpError> {
        check("periods at the start", periods >= 2, "at least 2")?;
        positive("first jump", jump)?;
        Ok(Self {
            first_periods: periods,
            first_jump: jump,
            ..self
        })
    }

    /// With the number of simulated passes after which jumps end and every pass is simulated, and
    /// the number after which the run gives up; in [`evolve_days`](crate::days::evolve_days)
    /// numbers of simulated days.
    #[must_use]
    pub fn with_max_passes(self, jumping: u64, simulated: u64) -> Self {
        Self {
            max_passes: (jumping, simulated),
            ..self
        }
    }
}

/// The traffic, and what is wanted of it.
#[derive(Debug, Clone)]
pub struct Request<'a> {
    pub(crate) passes: u64,
    pub(crate) order: &'a [usize],
    /// Passes to be recorded, from 1.
    pub wanted: &'a [u64],
    /// Passes to be recorded beyond the last one: where the forces lead.
    pub beyond: &'a [u64],
    /// Those of the wanted passes that are simulated also where they lie within a jump, from the
    /// interpolated state before them. Their records stay interpolated.
    pub looked_at: &'a [u64],
    /// So many passes at the beginning are simulated in any case: vehicles other than those of the
    /// period may drive there.
    pub first_passes: u64,
    /// Jumps of another run.
    pub guide: Guide<'a>,
    /// The cable before the first pass, if not as laid.
    pub start: Option<&'a CableState>,
    /// Where periods are days: those to be recorded.
    pub(crate) days: Option<&'a [u64]>,
}

impl<'a> Request<'a> {
    /// So many `passes` in all, none of them recorded. The traffic repeats after a period, whose
    /// vehicles come in this `order`: equal numbers are equal vehicles.
    ///
    /// # Errors
    ///
    /// [`JumpError::InvalidParameter`] for a period without vehicles.
    pub fn new(passes: u64, order: &'a [usize]) -> Result<Self, JumpError> {
        check("vehicles of a period", !order.is_empty(), "at least one")?;
        Ok(Self {
            passes,
            order,
            wanted: &[],
            beyond: &[],
            looked_at: &[],
            first_passes: 0,
            guide: Guide::Free,
            start: None,
            days: None,
        })
    }

    /// Passes of a period.
    pub(crate) fn period(&self) -> u64 {
        self.order.len() as u64
    }
}

fn positive(name: &'static str, value: f64) -> Result<(), JumpError> {
    check(name, value.is_finite() && value > 0.0, "finite and positive")
}

/// Jumps of another run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Guide<'a> {
    /// None.
    #[default]
    Free,
    /// These as long as their errors allow it, so that runs on two meshes differ by their meshes
    /// alone.
    Follow(&'a [u64]),
    /// Exactly these, so that an answer is smooth in its parameters.
    Obey(&'a [u64]),
}

impl Guide<'_> {
    /// The length of the jump number `place`, where the guide has one.
    pub(crate) fn length(self, place: usize) -> Option<u64> {
        match self {
            Self::Free => None,
            Self::Follow(lengths) | Self::Obey(lengths) => lengths.get(place).copied(),
        }
    }

    /// The error above which a jump is rejected, as a multiple of the tolerance.
    pub(crate) fn max_error(self) -> f64 {
        match self {
            Self::Free => MAX_ERROR,
            Self::Follow(_) => MAX_ERROR_GUIDED,
            Self::Obey(_) => f64::INFINITY,
        }
    }
}

/// A pass that is to be simulated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Next {
    /// Its place in the period, from 0.
    pub phase: usize,
    /// Its number, from 1; `None` for one that only measures.
    pub number: Option<u64>,
}
