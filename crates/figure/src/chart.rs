//! A chart: series and cells over two axes.

use crate::axis::Axis;
use crate::error::FigureError;
use crate::series::{Along, Kind, Reference, Series};

/// Series of points over two axes, with references, or a map: a grid of cells coloured by class or by value.
///
/// ```
/// use plain_figure::{Axis, Chart, Series};
///
/// let svg = Chart::of_classes(
///     "Explicit solver",
///     Axis::logarithmic("time step, s").cells([1e-5, 1e-4, 1e-3]),
///     Axis::names("law", ["sigmoid", "coulomb"]),
///     ["right", "wrong", "refused"],
///     [0, 0, 2, 0, 1, 2],
/// )
/// .with(Series::line("predicted limit", [(3e-4, -0.5), (3e-4, 1.5)]))
/// .to_svg()?;
/// assert!(svg.contains("refused"));
/// # Ok::<(), plain_figure::FigureError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
#[must_use]
pub struct Chart {
    pub(crate) title: String,
    pub(crate) x: Axis,
    pub(crate) y: Axis,
    pub(crate) cells: Option<Cells>,
    pub(crate) series: Vec<Series>,
    pub(crate) references: Vec<Reference>,
}

impl Chart {
    /// An empty chart. The title may be empty too.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            cells: None,
            series: Vec::new(),
            references: Vec::new(),
        }
    }

    /// A map of cells coloured by class, over axes of [cells](Axis::cells) or [names](Axis::names). `cells` names the class of each
    /// cell by its index in `classes`, row by row from the lowest, each row along x. Classes look, in turn: blue, vermilion with a
    /// cross, yellow with a stroke, black, purple with a dot, green with a ring.
    pub fn of_classes<Name: Into<String>>(
        title: impl Into<String>,
        x: Axis,
        y: Axis,
        classes: impl IntoIterator<Item = Name>,
        cells: impl IntoIterator<Item = usize>,
    ) -> Self {
        let classes = classes.into_iter().map(Into::into).collect();
        let cells = Cells::Classes(classes, cells.into_iter().collect());
        Self {
            cells: Some(cells),
            ..Self::new(title, x, y)
        }
    }

    /// A map of cells coloured by value on the scale `value`, which is drawn as a bar on the right; `None` leaves a cell white. Axes
    /// and order of cells as for [`Chart::of_classes`].
    pub fn of_values(
        title: impl Into<String>,
        x: Axis,
        y: Axis,
        value: Axis,
        cells: impl IntoIterator<Item = Option<f64>>,
    ) -> Self {
        let cells = Cells::Values(value, cells.into_iter().collect());
        Self {
            cells: Some(cells),
            ..Self::new(title, x, y)
        }
    }

    /// Adds a series; the later is drawn above the earlier, and all above the cells.
    pub fn with(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds a reference line or band, drawn below the series.
    pub fn refer(mut self, reference: Reference) -> Self {
        self.references.push(reference);
        self
    }

    pub(crate) fn check(&self) -> Result<(), FigureError> {
        if self.series.is_empty() && self.cells.is_none() {
            return Err(FigureError::empty("chart", &self.title));
        }
        if let Some(cells) = &self.cells {
            cells.check(&self.title, self.x.centres.len(), self.y.centres.len())?;
        }
        self.x.check_cells()?;
        self.y.check_cells()?;
        if let Some(series) = self.series.iter().find(|series| series.points.is_empty()) {
            return Err(FigureError::empty("series", &series.name));
        }
        for (what, x, y) in self.contents() {
            self.x.check(&what, x)?;
            self.y.check(&what, y)?;
        }
        Ok(())
    }

    /// What the axes have to hold: what it is, its abscissae, and its ordinates.
    pub(crate) fn contents(&self) -> impl Iterator<Item = (String, Vec<f64>, Vec<f64>)> {
        let series = self.series.iter().map(|series| {
            let (x, mut y): (Vec<f64>, Vec<f64>) = series.points.iter().copied().unzip();
            // Areas reach down to zero.
            y.extend((series.kind == Kind::Area && !self.y.logarithmic).then_some(0.0));
            (format!("series \"{}\"", series.name), x, y)
        });
        let references = self.references.iter().map(|reference| {
            let what = format!("reference \"{}\"", reference.label);
            let values = vec![reference.from, reference.to];
            match reference.along {
                Along::Horizontal => (what, Vec::new(), values),
                Along::Vertical => (what, values, Vec::new()),
            }
        });
        series.chain(references)
    }
}

/// A class or a value for each cell, row by row from the lowest, each row along x.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cells {
    /// Names of the classes, and the index of each cell's.
    Classes(Vec<String>, Vec<usize>),
    /// Values on the scale of the axis; a cell without value stays white.
    Values(Axis, Vec<Option<f64>>),
}

impl Cells {
    /// Whether they fill the grid of the chart named `chart`, with classes and values that exist.
    pub fn check(&self, chart: &str, columns: usize, rows: usize) -> Result<(), FigureError> {
        let (found, with_data) = match self {
            Self::Classes(_, cells) => (cells.len(), cells.len()),
            Self::Values(_, cells) => (cells.len(), cells.iter().flatten().count()),
        };
        if with_data == 0 {
            return Err(FigureError::empty("chart", chart));
        }
        if found != columns * rows {
            return Err(FigureError::CellCount {
                chart: chart.to_owned(),
                found,
                columns,
                rows,
            });
        }
        match self {
            Self::Values(axis, cells) => axis.check(&axis.label, cells.iter().flatten().copied()),
            Self::Classes(classes, cells) => match cells.iter().position(|class| *class >= classes.len()) {
                None => Ok(()),
                Some(index) => Err(FigureError::UnknownClass {
                    chart: chart.to_owned(),
                    index,
                    class: cells[index],
                    classes: classes.len(),
                }),
            },
        }
    }
}
