//! Content on its way to its place.

use std::fs::OpenOptions;
use std::io::{self, BufWriter, Write};

use super::error::OutputError;
use super::place::Place;
use super::target::Output;
use super::temporary::Temporary;

/// A file that is being written. Dropped before it is finished, it leaves nothing behind.
pub struct Draft {
    output: Output,
    writer: BufWriter<To>,
}

enum To {
    /// What is written as it is.
    Stream(Box<dyn Write + Send>),
    Temporary(Temporary),
}

impl Output {
    /// Begins to write.
    pub fn begin(&self) -> Result<Draft, OutputError> {
        Draft::of(self)
    }

    /// Writes all of it: what `fill` writes stands there if it succeeds, and else what stood there before.
    #[cfg(feature = "cli")]
    pub fn write(&self, fill: impl FnOnce(&mut dyn io::Write) -> io::Result<()>) -> Result<(), OutputError> {
        let mut draft = self.begin()?;
        fill(&mut draft).map_err(|source| self.failed(source))?;
        draft.finish()
    }
}

impl Draft {
    pub(super) fn of(output: &Output) -> Result<Self, OutputError> {
        let to = match &output.place {
            Place::StandardOutput => Ok(To::Stream(Box::new(io::stdout()))),
            // What another program handed over goes on where it is.
            Place::Special(path) => {
                let file = OpenOptions::new().append(true).open(path);
                file.map(|file| To::Stream(Box::new(file)))
            }
            Place::File(path) => Temporary::beside(path).map(To::Temporary),
        };
        Ok(Self {
            writer: BufWriter::new(to.map_err(|source| output.failed(source))?),
            output: output.clone(),
        })
    }

    /// Puts the content in its place.
    pub fn finish(self) -> Result<(), OutputError> {
        let Self { output, writer } = self;
        let to = writer.into_inner().map_err(io::IntoInnerError::into_error);
        match (to, &output.place) {
            (Ok(To::Temporary(temporary)), Place::File(path)) => {
                // Hours may have gone by: what has come into its place meanwhile is kept too.
                output.check_kind(path)?;
                temporary.replace(path)
            }
            (Ok(To::Stream(mut out)), _) => out.flush(),
            (Ok(To::Temporary(_)), _) => Ok(()),
            (Err(error), _) => Err(error),
        }
        .map_err(|source| output.failed(source))
    }
}

impl Write for Draft {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl To {
    fn out(&mut self) -> &mut dyn Write {
        match self {
            Self::Stream(out) => out,
            Self::Temporary(temporary) => temporary,
        }
    }
}

impl Write for To {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.out().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out().flush()
    }
}
