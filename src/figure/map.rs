//! A map: a grid of cells, coloured by class or by value.

use super::axis::Axis;
use super::chart::SIZE;
use super::draw;
use super::palette::CLASSES;
use super::scale::{Scale, TickLabels, is_sound};
use super::series::Series;
use super::{FigureError, Panels};

/// One axis of a [`Map`]: the places or names of its columns or rows.
#[derive(Debug, Clone, PartialEq)]
pub struct GridAxis {
    pub(super) label: String,
    places: Places,
}

#[derive(Debug, Clone, PartialEq)]
enum Places {
    Numbers {
        centres: Vec<f64>,
        logarithmic: bool,
        tick_labels: TickLabels,
    },
    Names(Vec<String>),
}

impl GridAxis {
    /// Cells around ascending numbers, with borders half-way between them.
    #[must_use]
    pub fn linear(label: impl Into<String>, centres: impl IntoIterator<Item = f64>) -> Self {
        Self::numbers(label, centres, false)
    }

    /// Cells around ascending numbers, with borders half-way between their logarithms.
    #[must_use]
    pub fn logarithmic(label: impl Into<String>, centres: impl IntoIterator<Item = f64>) -> Self {
        Self::numbers(label, centres, true)
    }

    /// Cells with names.
    #[must_use]
    pub fn names<Name: Into<String>>(
        label: impl Into<String>,
        names: impl IntoIterator<Item = Name>,
    ) -> Self {
        Self {
            label: label.into(),
            places: Places::Names(names.into_iter().map(Into::into).collect()),
        }
    }

    /// Labels ticks with SI prefixes of `unit`: "1 µm", "10 ms". Names stay as they are.
    #[must_use]
    pub fn prefixes(mut self, unit: impl Into<String>) -> Self {
        if let Places::Numbers { tick_labels, .. } = &mut self.places {
            *tick_labels = TickLabels::Prefixed(unit.into());
        }
        self
    }

    fn numbers(label: impl Into<String>, centres: impl IntoIterator<Item = f64>, logarithmic: bool) -> Self {
        Self {
            label: label.into(),
            places: Places::Numbers {
                centres: centres.into_iter().collect(),
                logarithmic,
                tick_labels: TickLabels::Number,
            },
        }
    }

    /// How many columns or rows.
    pub(super) fn count(&self) -> usize {
        match &self.places {
            Places::Numbers { centres, .. } => centres.len(),
            Places::Names(names) => names.len(),
        }
    }

    /// Names, if the cells have them.
    pub(super) fn named(&self) -> Option<&[String]> {
        match &self.places {
            Places::Names(names) => Some(names),
            Places::Numbers { .. } => None,
        }
    }

    /// The scale of this axis, and the borders of its cells.
    pub(super) fn scale(&self, ticks: usize) -> Result<(Scale, Vec<f64>), FigureError> {
        if self.count() == 0 {
            return Err(FigureError::Empty {
                what: format!("axis \"{}\"", self.label),
            });
        }
        let (centres, logarithmic, tick_labels) = match &self.places {
            Places::Names(names) => {
                let borders = (0..=names.len()).map(|k| k as f64 - 0.5).collect();
                return Ok((Scale::names(names), borders));
            }
            Places::Numbers {
                centres,
                logarithmic,
                tick_labels,
            } => (centres, *logarithmic, tick_labels),
        };
        for (index, &value) in centres.iter().enumerate() {
            if !value.is_finite() {
                return Err(FigureError::NotFinite {
                    what: self.label.clone(),
                    index,
                    value,
                });
            }
            if logarithmic && value <= 0.0 {
                return Err(FigureError::NotPositive {
                    what: self.label.clone(),
                    value,
                });
            }
        }
        if let Some(pair) = centres.windows(2).find(|pair| pair[0] >= pair[1]) {
            return Err(FigureError::NotAscending {
                axis: self.label.clone(),
                previous: pair[0],
                next: pair[1],
            });
        }
        let borders = borders(centres, logarithmic);
        let range = (borders[0], borders[borders.len() - 1]);
        if !is_sound(range, logarithmic) {
            return Err(FigureError::BadRange {
                axis: self.label.clone(),
                from: range.0,
                to: range.1,
            });
        }
        Ok((Scale::new(range, logarithmic, ticks, tick_labels), borders))
    }
}

/// Borders of cells half-way between their centres; the outer cells are as wide on the outside as on the inside.
fn borders(centres: &[f64], logarithmic: bool) -> Vec<f64> {
    let to = |value: f64| if logarithmic { value.ln() } else { value };
    let from = |place: f64| if logarithmic { place.exp() } else { place };
    let places: Vec<f64> = centres.iter().map(|&centre| to(centre)).collect();
    let n = places.len();
    let (first, last) = match n {
        1 => (0.5, 0.5),
        _ => (
            0.5 * (places[1] - places[0]),
            0.5 * (places[n - 1] - places[n - 2]),
        ),
    };
    std::iter::once(places[0] - first)
        .chain(places.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])))
        .chain(std::iter::once(places[n - 1] + last))
        .map(from)
        .collect()
}

/// A class of cells: its name, and the look of the class at its place (blue, vermilion with a cross, yellow with a stroke,
/// black, purple with a dot, green with a ring).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Class {
    pub(super) name: String,
    pub(super) look: Option<usize>,
}

impl Class {
    /// A class with a name.
    #[must_use]
    pub fn new(name: impl Into<String>) -> Self {
        Self {
            name: name.into(),
            look: None,
        }
    }

    /// The look of the `index`-th class, from 0.
    #[must_use]
    pub fn look(mut self, index: usize) -> Self {
        self.look = Some(index % CLASSES.len());
        self
    }
}

/// What fills the cells.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Fill {
    Classes(Vec<Class>, Vec<usize>),
    Values(Axis, Vec<Option<f64>>),
}

/// A grid of cells over two axes, with lines drawn over it.
///
/// ```
/// use creepage::figure::{Class, GridAxis, Map, Series};
///
/// let svg = Map::of_classes(
///     "Explicit solver",
///     GridAxis::logarithmic("time step, s", [1e-5, 1e-4, 1e-3]),
///     GridAxis::names("law", ["sigmoid", "coulomb"]),
///     [Class::new("right"), Class::new("wrong"), Class::new("refused")],
///     [0, 0, 2, 0, 1, 2],
/// )
/// .with(Series::line("predicted limit", [(3e-4, -0.5), (3e-4, 1.5)]))
/// .to_svg()?;
/// assert!(svg.contains("refused"));
/// # Ok::<(), creepage::figure::FigureError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    pub(super) title: String,
    pub(super) x: GridAxis,
    pub(super) y: GridAxis,
    pub(super) fill: Fill,
    pub(super) lines: Vec<Series>,
}

impl Map {
    /// Cells coloured by class. `cells` names the class of each cell by its place in `classes`, row by row from the lowest, each
    /// row along x.
    #[must_use]
    pub fn of_classes(
        title: impl Into<String>,
        x: GridAxis,
        y: GridAxis,
        classes: impl IntoIterator<Item = Class>,
        cells: impl IntoIterator<Item = usize>,
    ) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            fill: Fill::Classes(classes.into_iter().collect(), cells.into_iter().collect()),
            lines: Vec::new(),
        }
    }

    /// Cells coloured by value on the scale `value`, drawn as a bar on the right; `None` leaves a cell white. Order of cells as for
    /// [`Map::of_classes`].
    #[must_use]
    pub fn of_values(
        title: impl Into<String>,
        x: GridAxis,
        y: GridAxis,
        value: Axis,
        cells: impl IntoIterator<Item = Option<f64>>,
    ) -> Self {
        Self {
            title: title.into(),
            x,
            y,
            fill: Fill::Values(value, cells.into_iter().collect()),
            lines: Vec::new(),
        }
    }

    /// Draws a series over the cells. On an axis of names the cells stand at 0, 1, 2, ...
    #[must_use]
    pub fn with(mut self, line: Series) -> Self {
        self.lines.push(line);
        self
    }

    /// The map as an SVG of 800 by 500 px.
    ///
    /// # Errors
    ///
    /// [`FigureError`] without data, where cells and axes do not fit together, with numbers that are not finite or have no
    /// place on a logarithmic axis, and where a text has no room.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        Panels::new("")
            .panel_size(SIZE.0, SIZE.1)
            .with(self.clone())
            .to_svg()
    }

    pub(super) fn check(&self) -> Result<(), FigureError> {
        let (columns, rows) = (self.x.count(), self.y.count());
        let found = match &self.fill {
            Fill::Classes(_, cells) => cells.len(),
            Fill::Values(_, cells) => cells.len(),
        };
        if found == 0 {
            return Err(FigureError::Empty {
                what: format!("map \"{}\"", self.title),
            });
        }
        if found != columns * rows {
            return Err(FigureError::CellCount {
                map: self.title.clone(),
                found,
                columns,
                rows,
            });
        }
        match &self.fill {
            Fill::Classes(classes, cells) => {
                let unknown = cells.iter().position(|class| *class >= classes.len());
                if let Some(index) = unknown {
                    return Err(FigureError::UnknownClass {
                        map: self.title.clone(),
                        index,
                        class: cells[index],
                        classes: classes.len(),
                    });
                }
            }
            Fill::Values(axis, cells) => {
                for (index, &value) in cells.iter().enumerate() {
                    match value {
                        Some(value) if !value.is_finite() => {
                            return Err(FigureError::NotFinite {
                                what: format!("map \"{}\"", self.title),
                                index,
                                value,
                            });
                        }
                        Some(value) if axis.logarithmic && value <= 0.0 => {
                            return Err(FigureError::NotPositive {
                                what: format!("map \"{}\"", self.title),
                                value,
                            });
                        }
                        _ => {}
                    }
                }
                if cells.iter().all(Option::is_none) {
                    return Err(FigureError::Empty {
                        what: format!("map \"{}\"", self.title),
                    });
                }
            }
        }
        self.lines.iter().try_for_each(Series::check)
    }

    pub(super) fn draw(&self, canvas: &draw::Canvas<'_>, outer: draw::Rect) -> Result<(), FigureError> {
        draw::map(self, canvas, outer)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_lie_half_way() {
        assert_eq!(borders(&[1.0, 2.0, 4.0], false), [0.5, 1.5, 3.0, 5.0]);
        let decades = borders(&[1.0, 100.0], true);
        for (found, wanted) in decades.iter().zip([0.1, 10.0, 1000.0]) {
            assert!((found / wanted - 1.0).abs() < 1e-14, "{decades:?}");
        }
    }
}
