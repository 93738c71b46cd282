//! A chart: series and cells over two axes.

use crate::axis::Axis;
use crate::cells::{Bar, Cells};
use crate::drawing::{Drawing, Rect};
use crate::error::FigureError;
use crate::frame::{BELOW, Frame, ticks};
use crate::legend::{self, Legend};
use crate::reference::Reference;
use crate::series::{Kind, Series};

/// Legends begin this far from the figure's left edge \[px\].
const INDENT: f64 = 24.0;
/// What the y axis takes of the width, about \[px\].
const LEFT: f64 = 90.0;

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
    x: Axis,
    y: Axis,
    cells: Option<Cells>,
    series: Vec<Series>,
    references: Vec<Reference>,
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
    /// cell by its index in `classes`, row by row from the lowest, each row along x. Classes look, in turn: blue, vermilion, yellow,
    /// black, purple, green, each of another lightness.
    pub fn of_classes<Name: Into<String>>(
        title: impl Into<String>,
        x: Axis,
        y: Axis,
        classes: impl IntoIterator<Item = Name>,
        cells: impl IntoIterator<Item = usize>,
    ) -> Self {
        let classes = classes.into_iter().map(Into::into).collect();
        Self::new(title, x, y).filled(Cells::Classes(classes, cells.into_iter().collect()))
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
        Self::new(title, x, y).filled(Cells::Values(value, cells.into_iter().collect()))
    }

    fn filled(mut self, cells: Cells) -> Self {
        self.cells = Some(cells);
        self
    }

    /// Adds a series; the later is drawn above the earlier, and all above the cells.
    pub fn with(mut self, series: Series) -> Self {
        let (index, on_cells) = (self.series.len(), self.cells.is_some());
        self.series.push(series.placed(index, on_cells));
        self
    }

    /// Adds a reference line or band, drawn below the series.
    pub fn refer(mut self, reference: Reference) -> Self {
        self.references.push(reference);
        self
    }

    pub(crate) fn check(&self) -> Result<(), FigureError> {
        if self.series.is_empty() && self.cells.is_none() {
            return Err(FigureError::Empty(format!("chart \"{}\"", self.title)));
        }
        if let Some(cells) = &self.cells {
            cells.check(&self.title, self.x.centres.len() * self.y.centres.len())?;
        }
        self.x.check_cells()?;
        self.y.check_cells()?;
        if let Some(series) = self.series.iter().find(|series| series.points.is_empty()) {
            return Err(FigureError::Empty(format!("series \"{}\"", series.name)));
        }
        for (what, x, y) in self.contents() {
            self.x.check(&what, x)?;
            self.y.check(&what, y)?;
        }
        Ok(())
    }

    /// What the axes have to hold: what it is, its abscissae, and its ordinates.
    fn contents(&self) -> impl Iterator<Item = (String, Vec<f64>, Vec<f64>)> {
        let series = self.series.iter().map(|series| {
            let (x, mut y): (Vec<f64>, Vec<f64>) = series.points.iter().copied().unzip();
            // Areas reach down to zero.
            y.extend((series.kind == Kind::Area && !self.y.logarithmic).then_some(0.0));
            (format!("series \"{}\"", series.name), x, y)
        });
        let references = self.references.iter().map(|reference| {
            let what = format!("reference \"{}\"", reference.label);
            let values = vec![reference.from, reference.to];
            let (x, y) = if reference.is_vertical {
                (values, vec![])
            } else {
                (vec![], values)
            };
            (what, x, y)
        });
        series.chain(references)
    }

    /// Draws the chart in its part of the figure.
    pub(crate) fn draw(&self, drawing: &mut Drawing, mut outer: Rect) -> Result<(), FigureError> {
        let classes = match &self.cells {
            Some(Cells::Classes(classes, _)) => classes.as_slice(),
            _ => &[],
        };
        outer.top += legend::title(&self.title, drawing, (outer.left, outer.top), outer.width())?;
        let legend = Legend::new(classes, &self.series, outer.width() - 2.0 * INDENT)?;
        outer.bottom -= legend.height;
        let up = ticks(outer.height() - BELOW, 50.0);
        let bar = Bar::new(self.cells.as_ref(), up)?;
        let right = bar.as_ref().map_or(0.0, Bar::width);
        let across = ticks(outer.width() - right - LEFT, 90.0);
        let scales = (
            self.x.scale(self.contents().flat_map(|(_, x, _)| x), across)?,
            self.y.scale(self.contents().flat_map(|(.., y)| y), up)?,
        );
        let labels = (self.x.label.as_str(), self.y.label.as_str());
        let frame = Frame::draw(drawing, outer, scales, labels, self.cells.is_none(), right)?;
        if let Some(cells) = &self.cells {
            cells.draw(drawing, &frame, (&self.x, &self.y), bar.as_ref());
        }
        for reference in &self.references {
            reference.draw(drawing, &frame);
        }
        for series in &self.series {
            series.draw(drawing, &frame);
        }
        for reference in &self.references {
            reference.draw_label(drawing, &frame)?;
        }
        if let Some(bar) = bar {
            bar.draw(drawing, frame.plot)?;
        }
        legend.draw(drawing, (outer.left + INDENT, outer.bottom));
        Ok(())
    }
}
