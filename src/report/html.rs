//! Elements of the page. Every text is escaped here and nowhere else.

/// A page in the making, with the elements that a report needs.
#[derive(Default)]
pub struct Html(String);

/// A table: its head, rows of cells, and for each column whether it holds numbers.
pub struct Table {
    pub head: Vec<String>,
    pub rows: Vec<Vec<String>>,
    /// Columns set to the right.
    pub numbers: Vec<bool>,
}

/// A number at the top of the page: what it is, the number with its unit, and a remark.
pub struct Headline {
    pub name: &'static str,
    pub value: String,
    pub note: String,
}

impl Html {
    /// Markup or a drawing as it is.
    pub fn raw(&mut self, markup: &str) {
        self.0.push_str(markup);
        self.0.push('\n');
    }

    /// `<tag>text</tag>`.
    pub fn element(&mut self, tag: &str, text: &str) {
        self.raw(&format!("<{tag}>{}</{tag}>", escaped(text)));
    }

    /// A paragraph.
    pub fn paragraph(&mut self, text: &str) {
        self.element("p", text);
    }

    /// A list of points, nothing without any.
    pub fn list(&mut self, points: &[String]) {
        if points.is_empty() {
            return;
        }
        self.raw("<ul>");
        for point in points {
            self.element("li", point);
        }
        self.raw("</ul>");
    }

    /// A table as wide as its content.
    pub fn table(&mut self, table: &Table) {
        let row = |tag: &str, cells: &[String]| {
            let cell = |(column, text): (usize, &String)| {
                let is_number = table.numbers.get(column) == Some(&true);
                let class = if is_number { " class=\"number\"" } else { "" };
                format!("<{tag}{class}>{}</{tag}>", escaped(text))
            };
            let cells: Vec<String> = cells.iter().enumerate().map(cell).collect();
            format!("<tr>{}</tr>", cells.concat())
        };
        self.raw("<table>");
        self.raw(&format!("<thead>{}</thead>", row("th", &table.head)));
        self.raw("<tbody>");
        for cells in &table.rows {
            self.raw(&row("td", cells));
        }
        self.raw("</tbody>");
        self.raw("</table>");
    }

    /// Numbers side by side.
    pub fn headlines(&mut self, headlines: &[Headline]) {
        self.raw("<dl class=\"headlines\">");
        for Headline { name, value, note } in headlines {
            self.raw("<div>");
            self.element("dt", name);
            self.raw(&format!("<dd class=\"value\">{}</dd>", escaped(value)));
            self.element("dd", note);
            self.raw("</div>");
        }
        self.raw("</dl>");
    }

    /// A drawing with words below it.
    pub fn figure(&mut self, svg: &str, caption: &str) {
        self.raw("<figure>");
        self.raw(svg);
        self.element("figcaption", caption);
        self.raw("</figure>");
    }

    /// What was made.
    pub fn finish(self) -> String {
        self.0
    }
}

/// Text for HTML, in elements and in attributes; characters that have no place in a text become a replacement mark.
pub fn escaped(text: &str) -> String {
    let unknown = |letter: char| letter.is_control() || matches!(letter, '\u{fffe}' | '\u{ffff}');
    text.replace(['\n', '\t'], " ")
        .replace(unknown, "\u{fffd}")
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
        .replace('\'', "&apos;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_text_is_escaped() {
        let nasty = "<script>alert('1')</script> & \"\u{0}";
        let safe = "&lt;script&gt;alert(&apos;1&apos;)&lt;/script&gt; &amp; &quot;\u{fffd}";
        let text = nasty.to_owned();
        let mut html = Html::default();
        html.paragraph(nasty);
        html.list(std::slice::from_ref(&text));
        html.table(&Table {
            head: vec![text.clone()],
            rows: vec![vec![text.clone()]],
            numbers: vec![true],
        });
        html.headlines(&[Headline {
            name: nasty,
            value: text.clone(),
            note: text,
        }]);
        html.figure("<svg/>", nasty);
        let page = html.finish();
        assert_eq!(page.matches(safe).count(), 8, "{page}");
        assert!(!page.contains("<script"), "{page}");
    }
}
