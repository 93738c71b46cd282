//! One reading.

use creepage_scene::CableEnd;

/// Where along the duct something was measured.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// The end that the scene holds, the downstream one if it holds both; of movements, the one
    /// that moves.
    Natural,
    /// This end.
    End(CableEnd),
    /// This far from the upstream end \[m\].
    At(f64),
}

/// What was measured after a pass.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Measured {
    /// Force in the cable \[N\], compression positive.
    Force(Place),
    /// Movement of the cable along the duct \[m\], positive downstream.
    Movement(Place),
    /// Strain of the cable by its force, shortening positive.
    Strain(Place),
    /// How far the duct goes down under the first vehicle \[m\].
    Deflection,
}

impl Measured {
    /// Its unit.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Force(_) => "N",
            Self::Movement(_) | Self::Deflection => "m",
            Self::Strain(_) => "1",
        }
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Force(_) => "force",
            Self::Movement(_) => "movement",
            Self::Strain(_) => "strain",
            Self::Deflection => "deflection",
        }
    }

    /// Where, in words.
    pub(crate) fn place(self) -> String {
        match self {
            Self::Deflection => "first vehicle".into(),
            Self::Force(place) | Self::Movement(place) | Self::Strain(place) => match place {
                Place::Natural => "held end".into(),
                Place::End(end) => end.name().into(),
                Place::At(x) => format!("{x} m"),
            },
        }
    }
}

/// A reading of an instrument.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Number of the pass after which it was taken, as the file has it; 0 for the zero reading.
    pub pass: u64,
    /// Passes since the cable was at rest, those of runs before this one included where it goes on
    /// from them.
    pub passes: u64,
    /// What was measured.
    pub measured: Measured,
    /// Its value, in SI.
    pub value: f64,
    /// Its standard deviation, where the file gives it.
    pub sigma: Option<f64>,
    /// Index of its series among those that are fitted together; 0 as it is read.
    pub series: usize,
    /// Index of the run, from 0.
    pub run: usize,
    /// Line of the file, from 1.
    pub line: u64,
}

impl Reading {
    /// The force \[N\] on the load cell after `pass`.
    pub fn force(pass: u64, force: f64) -> Self {
        Self {
            pass,
            passes: pass,
            measured: Measured::Force(Place::Natural),
            value: force,
            sigma: None,
            series: 0,
            run: 0,
            line: pass,
        }
    }

    /// What it is of: a quantity at a place, in a series.
    pub(crate) fn instrument(&self) -> Instrument {
        (self.series, self.measured)
    }

    /// Whether the cable was at rest, so that it reads 0 of all but a deflection.
    pub(crate) fn is_at_rest(&self) -> bool {
        self.passes == 0 && self.measured != Measured::Deflection
    }
}

/// A series and what is measured in it.
pub(crate) type Instrument = (usize, Measured);
