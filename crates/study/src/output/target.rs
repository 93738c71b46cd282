//! One file that is going to be written, and its content on its way there.

use std::fs::OpenOptions;
use std::io::{self, BufWriter, ErrorKind, IntoInnerError, Write};
use std::path::{Path, PathBuf};

use super::error::OutputError;
use super::place::Place;
use super::temporary::Temporary;

/// A file to be written.
#[derive(Debug, Clone)]
pub struct Output {
    /// As the user calls it.
    pub(super) name: PathBuf,
    pub(super) place: Place,
    /// What the names of older files end in that it replaces.
    pub(super) ending: &'static str,
    pub(super) force: bool,
}

impl Output {
    /// Makes sure that the place can be written and may be.
    pub fn check(&self) -> Result<(), OutputError> {
        let Place::File(file) = &self.place else {
            return Ok(());
        };
        let unwritable = |source| OutputError::unwritable(&self.name, source);
        match OpenOptions::new().append(true).open(file) {
            Ok(_) => self.check_ending(file)?,
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            Err(error) => return Err(unwritable(error)),
        }
        Temporary::beside(file).map(drop).map_err(unwritable)
    }

    /// Refuses to replace a file whose name ends otherwise, so that a slip of the name costs nobody's work.
    fn check_ending(&self, file: &Path) -> Result<(), OutputError> {
        let ending = file.extension().unwrap_or_default();
        if self.force || ending.eq_ignore_ascii_case(self.ending) || !file.exists() {
            return Ok(());
        }
        Err(OutputError::OtherEnding {
            file: file.display().to_string(),
            ending: self.ending,
        })
    }

    /// Where the content will stand, past all links; what is no file stays what it is called.
    pub fn path(&self) -> &Path {
        match &self.place {
            Place::File(file) => file,
            _ => &self.name,
        }
    }

    /// Whether this is standard output under another name.
    pub fn is_standard_output(&self) -> bool {
        matches!(self.place, Place::StandardOutput)
    }

    /// Begins to write it.
    pub fn begin(&self) -> Result<Draft, OutputError> {
        let begin = || -> io::Result<(Box<dyn Write + Send>, Option<Temporary>)> {
            Ok(match &self.place {
                Place::StandardOutput => (Box::new(io::stdout()), None),
                // What another program handed over goes on where it is.
                Place::Special(path) => (Box::new(OpenOptions::new().append(true).open(path)?), None),
                Place::File(path) => {
                    let temporary = Temporary::beside(path)?;
                    (Box::new(temporary.writer()?), Some(temporary))
                }
            })
        };
        let (out, temporary) = begin().map_err(|source| self.failed(source))?;
        Ok(Draft {
            output: self.clone(),
            writer: BufWriter::new(out),
            temporary,
        })
    }

    /// Writes all of it: what `fill` writes stands there if it succeeds, and else what stood there before.
    pub fn write(&self, fill: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), OutputError> {
        let mut draft = self.begin()?;
        fill(&mut draft).map_err(|source| self.failed(source))?;
        draft.finish()
    }

    /// The error of a write that failed.
    pub fn failed(&self, source: io::Error) -> OutputError {
        match self.place {
            Place::StandardOutput => OutputError::StandardOutput(source),
            _ => OutputError::Failed(self.name.display().to_string(), source),
        }
    }
}

/// A file that is being written. Dropped before it is finished, it leaves nothing behind.
pub struct Draft {
    output: Output,
    writer: BufWriter<Box<dyn Write + Send>>,
    /// What is being written, but for what is written where it is.
    temporary: Option<Temporary>,
}

impl Draft {
    /// Puts the content in its place.
    pub fn finish(self) -> Result<(), OutputError> {
        let Self {
            output,
            writer,
            temporary,
        } = self;
        let out = writer.into_inner().map_err(IntoInnerError::into_error);
        let mut written = out.and_then(|mut out| out.flush());
        if let (Ok(()), Some(temporary), Place::File(path)) = (&written, temporary, &output.place) {
            // Hours may have gone by: what has come into its place meanwhile is kept too.
            output.check_ending(path)?;
            written = temporary.replace(path);
        }
        written.map_err(|source| output.failed(source))
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
