//! Sheets of a workbook, each written row by row.

use rust_xlsxwriter::{Color, DocProperties, ExcelDateTime, Format, FormatBorder, Workbook, XlsxError};

use creepage_scene::{SceneFile, shortened};

/// Letters of a text: Excel takes a few more.
const LONGEST: usize = 32_000;
/// The widest column \[px\].
const WIDE: u32 = 420;
/// Of what is marked.
const GREY: Color = Color::RGB(0x80_80_80);

/// What stands in a cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// Nothing.
    Absent,
    /// A number.
    Number(f64),
    /// A text, never a formula.
    Text(String),
    /// True or false.
    Truth(bool),
}

/// A workbook whose last sheet is being written.
pub struct Book {
    workbook: Workbook,
    row: u32,
}

impl Book {
    /// An empty workbook.
    pub fn new(title: &str) -> Result<Self, XlsxError> {
        let mut workbook = Workbook::new();
        let properties = DocProperties::new()
            .set_title(shortened(title, 200))
            .set_author(concat!("creepage ", env!("CARGO_PKG_VERSION")))
            .set_creation_datetime(&ExcelDateTime::from_ymd(2000, 1, 1)?);
        workbook.set_properties(&properties);
        Ok(Self { workbook, row: 0 })
    }

    /// Begins a sheet with the names of its columns, below them their units if there are any.
    pub fn sheet(&mut self, name: &str, columns: &[(&str, &str)]) -> Result<(), XlsxError> {
        let (bold, lined) = (
            Format::new().set_bold(),
            Format::new().set_border_bottom(FormatBorder::Thin),
        );
        let has_units = columns.iter().any(|(_, unit)| !unit.is_empty());
        let sheet = self.workbook.add_worksheet().set_name(name)?;
        for (place, (name, unit)) in (0..).zip(columns) {
            sheet.write_string_with_format(0, place, *name, &bold)?;
            if has_units {
                sheet.write_string_with_format(1, place, *unit, &lined)?;
            }
        }
        self.row = if has_units { 2 } else { 1 };
        sheet.set_freeze_panes(self.row, 1)?;
        Ok(())
    }

    /// The next row of the sheet; a marked one is grey and slanted.
    pub fn row(&mut self, cells: impl IntoIterator<Item = Cell>, is_marked: bool) -> Result<(), XlsxError> {
        let plain = Format::new();
        let marked = Format::new().set_italic().set_font_color(GREY);
        let (row, format) = (self.row, if is_marked { &marked } else { &plain });
        let Some(sheet) = self.workbook.worksheets_mut().last_mut() else {
            return Ok(());
        };
        for (place, cell) in (0..).zip(cells) {
            match cell {
                Cell::Absent => continue,
                Cell::Number(number) => sheet.write_number_with_format(row, place, number, format)?,
                Cell::Text(text) => {
                    sheet.write_string_with_format(row, place, shortened(&text, LONGEST), format)?
                }
                Cell::Truth(truth) => sheet.write_boolean_with_format(row, place, truth, format)?,
            };
        }
        self.row += 1;
        Ok(())
    }

    /// The bytes of the file, columns as wide as their content.
    pub fn finish(mut self) -> Result<Vec<u8>, XlsxError> {
        for sheet in self.workbook.worksheets_mut() {
            sheet.set_autofit_max_width(WIDE);
            sheet.autofit();
        }
        self.workbook.save_to_buffer()
    }
}

/// Adds a sheet with every key of the scene as it was typed.
pub fn scene(book: &mut Book, file: &SceneFile) -> Result<(), XlsxError> {
    book.sheet("scene", &[("key", ""), ("value", ""), ("from", "")])?;
    file.typed().into_iter().try_for_each(|typed| {
        let number = typed
            .text
            .parse()
            .ok()
            .filter(|number: &f64| typed.is_number && number.is_finite());
        let value = number.map_or(Cell::Text(typed.text), Cell::Number);
        book.row([Cell::Text(typed.key), value, Cell::Text(typed.source)], false)
    })
}
