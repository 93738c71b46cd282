//! What the reader is told of a file; the rest it recognises.

use encoding_rs::Encoding;

/// How to read a table. What is `None` or empty is recognised.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// What stands between cells; a space stands for any number of them.
    pub separator: Option<char>,
    /// What stands before the decimals: `.` or `,`.
    pub decimal: Option<char>,
    /// How characters are written as bytes.
    pub encoding: Option<&'static Encoding>,
    /// Line of the header, from 1; of a workbook the row of its sheet.
    pub header_line: Option<u64>,
    /// Rows below the header that hold no data, one of units among them.
    pub skip: Option<u64>,
    /// Sheet of a workbook; the first that holds anything if omitted.
    pub sheet: Option<String>,
    /// Unit of the columns of [`measured`](crate::Layout::measured), whatever the file says.
    pub unit: Option<String>,
    /// Columns by their names: the kind, such as `force`, and the name in the header in any case.
    pub columns: Vec<(String, String)>,
}

/// Signs by their words.
#[rustfmt::skip]
const SIGNS: [(&str, &str); 6] =
    [(";", "semicolon"), ("\t", "tab"), (",", "comma"), (" ", "space"), ("|", "bar"), (".", "point")];

/// The word for a sign.
pub fn word(sign: char) -> String {
    let word = SIGNS.iter().find(|(other, _)| other.starts_with(sign));
    word.map_or_else(|| format!("\"{sign}\""), |(_, word)| (*word).to_owned())
}

impl Options {
    /// Sets the option of this name: that of a field, or `column_` and a kind.
    ///
    /// # Errors
    ///
    /// What was found and what is allowed.
    pub fn set(&mut self, name: &str, text: &str) -> Result<(), String> {
        let wrong = |allowed: &str| format!("found `{text}`; allowed: {allowed}");
        let sign = |among: &str, allowed: &str| {
            let typed = text.replace("\\t", "\t");
            let mut signs = SIGNS.iter().filter(|(sign, _)| among.contains(sign));
            let found = signs.find(|(sign, word)| [*sign, *word].contains(&&*typed));
            let sign = found.and_then(|(sign, _)| sign.chars().next());
            sign.map(Some).ok_or_else(|| wrong(allowed))
        };
        let whole = || text.parse().map(Some).map_err(|_| wrong("a whole number"));
        match name {
            "separator" => self.separator = sign(";\t, |", "comma, semicolon, tab, space, or one of , ; |")?,
            "decimal" => self.decimal = sign(".,", "point, comma, or one of . ,")?,
            "encoding" => {
                let allowed = "utf-8, utf-16, latin-1, shift_jis, or another name of the Encoding Standard";
                let label = text.to_ascii_lowercase().replace("latin-", "latin");
                let label = label.replace("cp932", "sjis");
                let encoding = Encoding::for_label(label.as_bytes());
                self.encoding = Some(encoding.ok_or_else(|| wrong(allowed))?);
            }
            "header_line" => self.header_line = whole()?,
            "skip" => self.skip = whole()?,
            "sheet" => self.sheet = Some(text.to_owned()),
            "unit" => self.unit = Some(text.to_owned()),
            _ => match name.strip_prefix("column_") {
                Some(kind) => self.columns.push((kind.to_owned(), text.to_owned())),
                None => return Err(format!("found an option `{name}`, which there is not")),
            },
        }
        Ok(())
    }
}
