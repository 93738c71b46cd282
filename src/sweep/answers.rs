//! The table of a sweep in memory.

use std::sync::Mutex;

use super::compute::lock;
use super::error::SweepError;
use super::grid::Sweep;
use super::options::SweepOptions;
use super::row::Row;
use super::sink::{Cell, Column, Kind};

/// A column of a sweep's table.
#[derive(Debug, Clone, PartialEq)]
pub struct AnswerColumn {
    /// Its name: a key, or a field of [`Answer`](super::Answer).
    pub name: String,
    /// A value a row, in SI.
    pub values: AnswerValues,
}

/// The values of a column; `None` where a row has none.
#[derive(Debug, Clone, PartialEq)]
pub enum AnswerValues {
    /// Numbers in SI.
    Numbers(Vec<Option<f64>>),
    /// Counts.
    Counts(Vec<Option<u64>>),
    /// Texts.
    Texts(Vec<Option<String>>),
}

impl Sweep {
    /// Computes all points and returns the columns that [`Sweep::run`] writes, without any file.
    ///
    /// ```
    /// use creepage::SceneFile;
    /// use creepage::sweep::{AnswerValues, Samples, Sweep, SweepOptions};
    ///
    /// let file = SceneFile::read("examples/scenes/full-scale-upper.toml")?.with(&["traffic.passes=1"])?;
    /// let depths = vec![("duct.depth".to_owned(), vec!["1.2 m".to_owned(), "2 m".to_owned()])];
    /// let sweep = Sweep::of_table(file, depths, Samples::default())?;
    /// let columns = sweep.answers(&SweepOptions::default())?;
    /// assert_eq!(columns[0].values, AnswerValues::Numbers(vec![Some(1.2), Some(2.0)]));
    /// assert_eq!(columns[1].name, "downstream_force_n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SweepError::Stopped`] where the progress stopped it. What fails at a point is a row of the table.
    pub fn answers(&self, options: &SweepOptions<'_>) -> Result<Vec<AnswerColumn>, SweepError> {
        let rows: Mutex<Vec<Option<Row>>> = Mutex::new(vec![None; self.count()]);
        self.compute(&vec![false; self.count()], options, &|row| {
            let index = row.index;
            lock(&rows)[index] = Some(row);
            Ok(())
        })?;
        let heads = self.columns();
        let answers: Vec<_> = self.answer_columns().collect();
        let mut columns = self.heads();
        for row in lock(&rows).iter().flatten() {
            if let Some(each) = options.each {
                each(row);
            }
            let cells = self.cells(self.values(row.index), &heads, &answers, row);
            for (column, cell) in columns.iter_mut().zip(cells) {
                column.values.push(cell);
            }
        }
        Ok(columns)
    }

    /// The columns of its table, without rows.
    pub fn heads(&self) -> Vec<AnswerColumn> {
        let values = |kind| match kind {
            Kind::Number => AnswerValues::Numbers(Vec::new()),
            Kind::Count => AnswerValues::Counts(Vec::new()),
            Kind::Text => AnswerValues::Texts(Vec::new()),
        };
        let head = |column: Column| AnswerColumn {
            values: values(column.kind),
            name: column.name,
        };
        self.columns().into_iter().map(head).collect()
    }
}

impl AnswerValues {
    /// Adds a cell; of another kind it is none.
    fn push(&mut self, cell: Cell) {
        match (self, cell) {
            (Self::Numbers(values), Cell::Number(value)) => values.push(Some(value)),
            (Self::Counts(values), Cell::Count(value)) => values.push(Some(value)),
            (Self::Texts(values), Cell::Text(value)) => values.push(Some(value)),
            (Self::Numbers(values), _) => values.push(None),
            (Self::Counts(values), _) => values.push(None),
            (Self::Texts(values), _) => values.push(None),
        }
    }
}
