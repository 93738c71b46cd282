//! What is asked of a run with jumps.

/// How jumps are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jumps {
    /// Error that a jump may have where it is checked, as a share of the largest force or movement so far. Forces on the way differ
    /// from simulated ones by about as much at most, most of it early.
    pub tolerance: f64,
    /// Periods simulated at the start, at least two; eight are enough for any cable seen so far.
    pub first_periods: u64,
    /// Length of the first jump as a share of these. Runs that are to show each other's error begin differently: 0.5 and 0.25.
    pub first_jump: f64,
    /// Length over which the duct's motion changes \[m\], at least its depth: the slope is averaged over it.
    pub length_scale: f64,
    /// max |D_l| of all vehicles \[m\].
    pub motion: f64,
    /// Force \[N\] and movement \[m\] below which all is nothing.
    pub least: (f64, f64),
    /// Passes after which every one is simulated until nothing changes any more, and those after which the run gives up.
    pub most_passes: (u64, u64),
}

/// Traffic and what is wanted to know of it.
#[derive(Debug, Clone, Copy)]
pub struct Request<'a> {
    /// Vehicles in all.
    pub passes: u64,
    /// The vehicles of a period, after which the traffic repeats: only which of them are the same counts.
    pub order: &'a [usize],
    /// So many passes at the beginning and at the end are simulated in any case, those at the end without jumps: there others may drive than
    /// those of the period.
    pub one_by_one: (u64, u64),
    /// Passes to be recorded, ascending.
    pub wanted: &'a [u64],
    /// Those of them that are shown to `pass` also where they lie within a jump, from the state that is interpolated before them; what is
    /// recorded is interpolated all the same.
    pub looked_at: &'a [u64],
    /// Passes beyond the last one to be recorded, ascending: where the forces lead.
    pub beyond: &'a [u64],
    /// Jumps of another run to be taken again.
    pub guide: Guide<'a>,
}

impl Request<'_> {
    /// Vehicles in a period.
    pub(crate) fn period(&self) -> u64 {
        self.order.len() as u64
    }

    /// Whether `pass` is to be recorded.
    pub(crate) fn wants(&self, pass: u64) -> bool {
        self.wanted.binary_search(&pass).is_ok() || self.beyond.binary_search(&pass).is_ok()
    }
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
