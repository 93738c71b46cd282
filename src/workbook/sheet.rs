//! Sheets of a workbook, each written row by row.

use rust_xlsxwriter::{
    Color, DocProperties, ExcelDateTime, Format, FormatBorder, Workbook, Worksheet, XlsxError,
};

use crate::scene::shortened;

/// Letters of a text: Excel takes a few more.
const LONGEST: usize = 32_000;
/// Widths of columns, in letters.
const NARROW: usize = 10;
const WIDE: usize = 60;
/// Of what is marked.
const GREY: Color = Color::RGB(0x80_80_80);

/// What stands in a cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    Absent,
    Number(f64),
    /// A share, shown as a percentage.
    Share(f64),
    Text(String),
    Truth(bool),
}

/// A workbook whose last sheet is being written.
pub struct Book {
    workbook: Workbook,
    row: u32,
    name: Format,
    unit: Format,
    plain: Format,
    marked: Format,
    share: Format,
}

impl Book {
    /// An empty workbook.
    pub fn new(title: &str) -> Result<Self, XlsxError> {
        let mut workbook = Workbook::new();
        let begun = ExcelDateTime::from_ymd(2000, 1, 1)?;
        let author = concat!("creepage ", env!("CARGO_PKG_VERSION"));
        let properties = DocProperties::new()
            .set_title(shortened(title, 200))
            .set_author(author)
            .set_creation_datetime(&begun);
        workbook.set_properties(&properties);
        Ok(Self {
            workbook,
            row: 0,
            name: Format::new().set_bold(),
            unit: Format::new().set_border_bottom(FormatBorder::Thin),
            plain: Format::new(),
            marked: Format::new().set_italic().set_font_color(GREY),
            share: Format::new().set_num_format("0.00 %"),
        })
    }

    /// Begins a sheet with the names of its columns, below them their units where there are any.
    pub fn sheet(&mut self, name: &str, columns: &[(&str, &str)]) -> Result<(), XlsxError> {
        let has_units = columns.iter().any(|(_, unit)| !unit.is_empty());
        let sheet = self.workbook.add_worksheet().set_name(name)?;
        for (place, (name, unit)) in (0..).zip(columns) {
            let width = name.chars().count().clamp(NARROW, WIDE) + 2;
            sheet.set_column_width(place, width as f64)?;
            sheet.write_string_with_format(0, place, *name, &self.name)?;
            if has_units {
                sheet.write_string_with_format(1, place, *unit, &self.unit)?;
            }
        }
        self.row = if has_units { 2 } else { 1 };
        sheet.set_freeze_panes(self.row, 1)?;
        Ok(())
    }

    /// The next row of the sheet; a marked one is grey and slanted.
    pub fn row(&mut self, cells: impl IntoIterator<Item = Cell>, is_marked: bool) -> Result<(), XlsxError> {
        let format = if is_marked { &self.marked } else { &self.plain };
        let Some(sheet) = self.workbook.worksheets_mut().last_mut() else {
            return Ok(());
        };
        for (place, cell) in (0..).zip(cells) {
            write(sheet, (self.row, place), cell, format, &self.share)?;
        }
        self.row += 1;
        Ok(())
    }

    /// Widens columns of the sheet \[letters\].
    pub fn widths(&mut self, widths: &[f64]) -> Result<(), XlsxError> {
        if let Some(sheet) = self.workbook.worksheets_mut().last_mut() {
            for (place, width) in (0..).zip(widths) {
                sheet.set_column_width(place, *width)?;
            }
        }
        Ok(())
    }

    /// The bytes of the file.
    pub fn finish(mut self) -> Result<Vec<u8>, XlsxError> {
        self.workbook.save_to_buffer()
    }
}

fn write(
    sheet: &mut Worksheet,
    (row, place): (u32, u16),
    cell: Cell,
    format: &Format,
    share: &Format,
) -> Result<(), XlsxError> {
    match cell {
        Cell::Absent => return Ok(()),
        Cell::Number(number) => sheet.write_number_with_format(row, place, number, format)?,
        Cell::Share(number) => sheet.write_number_with_format(row, place, number, share)?,
        Cell::Text(text) => sheet.write_string_with_format(row, place, shortened(&text, LONGEST), format)?,
        Cell::Truth(truth) => sheet.write_boolean_with_format(row, place, truth, format)?,
    };
    Ok(())
}
