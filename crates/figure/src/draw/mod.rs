//! From data to SVG.

mod canvas;
mod cells;
mod chart;
mod frame;
mod heading;
mod legend;
mod mark;
mod reference;
mod series;
mod text;

use crate::chart::Chart;
use crate::error::FigureError;
use crate::panels::Panels;
use canvas::{Canvas, Rect};
use heading::Heading;

impl Chart {
    /// The chart as an SVG of 800 by 500 px.
    ///
    /// # Errors
    ///
    /// [`FigureError`] without data, where cells and axes do not fit together, with numbers that are not finite or have no
    /// place on a logarithmic axis, and where a text has no room.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        Panels::new("")
            .panel_size(800.0, 500.0)
            .with(self.clone())
            .to_svg()
    }
}

impl Panels {
    /// The figure as an SVG.
    ///
    /// # Errors
    ///
    /// As for [`Chart::to_svg`], and without any chart.
    pub fn to_svg(&self) -> Result<String, FigureError> {
        if self.charts.is_empty() {
            return Err(FigureError::empty("figure", &self.title));
        }
        self.charts.iter().try_for_each(Chart::check)?;
        let columns = self.columns.min(self.charts.len());
        let rows = self.charts.len().div_ceil(columns);
        let (width, height) = self.size;
        let whole = width * columns as f64;
        let heading = Heading::new(&self.title, whole)?;
        let top = heading.height();
        let titles = self.charts.iter().map(|chart| chart.title.as_str());
        let titles = std::iter::once(self.title.as_str()).chain(titles);
        let titles: Vec<&str> = titles.filter(|title| !title.is_empty()).collect();
        let mut canvas = Canvas::new(&titles.join("; "), (whole, top + height * rows as f64));
        heading.draw(&mut canvas, (0.0, 0.0));
        for (k, chart) in self.charts.iter().enumerate() {
            let (column, row) = ((k % columns) as f64, (k / columns) as f64);
            let centre = ((column + 0.5) * width, top + (row + 0.5) * height);
            let outer = Rect::around(centre, 0.5 * width, 0.5 * height);
            chart::draw(chart, &mut canvas, outer)?;
        }
        Ok(canvas.finish())
    }
}
