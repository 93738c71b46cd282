//! Content on its way to its place.

use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Stdout, Write};

use super::place::Place;
use super::temporary::Temporary;
use super::{Output, OutputError};

/// A file in the making. Dropped before it is finished, it leaves nothing behind.
pub struct Draft {
    output: Output,
    writer: BufWriter<To>,
}

enum To {
    StandardOutput(Stdout),
    Special(File),
    Temporary(Temporary),
}

impl Draft {
    pub(super) fn of(output: &Output) -> Result<Self, OutputError> {
        let to = match &output.place {
            Place::StandardOutput => Ok(To::StandardOutput(io::stdout())),
            // What another program handed over goes on where it is.
            Place::Special(path) => OpenOptions::new().append(true).open(path).map(To::Special),
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
            (Ok(To::StandardOutput(mut out)), _) => out.flush(),
            (Ok(_), _) => Ok(()),
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

impl Write for To {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::StandardOutput(out) => out.write(bytes),
            Self::Special(file) => file.write(bytes),
            Self::Temporary(temporary) => temporary.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::StandardOutput(out) => out.flush(),
            Self::Special(file) => file.flush(),
            Self::Temporary(temporary) => temporary.flush(),
        }
    }
}
