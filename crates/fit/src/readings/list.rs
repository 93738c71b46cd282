//! Readings, in the order of their file.

use super::reading::Reading;

/// Readings of one scene, in the order of the file.
///
/// ```
/// use creepage_fit::readings::Readings;
///
/// let readings = Readings::from_csv("cell.csv", b"pass,force_n\n1,113.4\n2,152.5\n")?;
/// assert_eq!(readings.values(), [113.4, 152.5]);
/// assert_eq!(readings.last_pass(), 2);
/// # Ok::<(), creepage_fit::readings::DataError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Readings {
    pub(super) list: Vec<Reading>,
    pub(super) runs: Vec<String>,
    pub(super) notes: Vec<String>,
}

impl Readings {
    /// The readings, in the order of the file.
    pub fn readings(&self) -> &[Reading] {
        &self.list
    }

    /// Those of the readings that are to be kept.
    #[must_use]
    pub fn keep(&self, keep: impl Fn(&Reading) -> bool) -> Self {
        let mut kept = self.clone();
        kept.list.retain(keep);
        kept
    }

    /// Names of the runs; one without a name where the file tells none apart.
    pub fn runs(&self) -> &[String] {
        &self.runs
    }

    /// What the user should know of how the file was read.
    pub fn notes(&self) -> &[String] {
        &self.notes
    }

    /// Passes from a cable at rest to the last reading.
    pub fn last_pass(&self) -> u64 {
        self.list.iter().map(|reading| reading.passes).max().unwrap_or(0)
    }

    /// The values, forces in newtons.
    pub fn values(&self) -> Vec<f64> {
        self.list.iter().map(|reading| reading.value).collect()
    }

    /// The standard deviations, where the file gives them.
    pub fn sigmas(&self) -> Option<Vec<f64>> {
        self.list.iter().map(|reading| reading.sigma).collect()
    }
}

impl FromIterator<Reading> for Readings {
    fn from_iter<I: IntoIterator<Item = Reading>>(readings: I) -> Self {
        Self {
            list: readings.into_iter().collect(),
            runs: vec![String::new()],
            ..Self::default()
        }
    }
}
