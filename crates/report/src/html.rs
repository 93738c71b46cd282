//! Elements of the page. Every text is escaped here and nowhere else.

use crate::words::Table;
use creepage_plan::shown::words_if;
use plain_figure::escaped;

/// A page in the making, with the elements that a report needs.
#[derive(Default)]
pub struct Html(String);

impl Html {
    /// Markup or a drawing as it is.
    pub fn raw(&mut self, markup: &str) {
        self.0.push_str(markup);
        self.0.push('\n');
    }

    /// A text in an element, which may have a class: `p` or `dd class="value"`.
    pub fn element(&mut self, tag: &str, text: &str) {
        let name = tag.split(' ').next().unwrap_or(tag);
        self.raw(&format!("<{tag}>{}</{name}>", escaped(text)));
    }

    pub fn paragraph(&mut self, text: &str) {
        self.element("p", text);
    }

    /// A list of points, nothing without any.
    pub fn list(&mut self, points: &[String]) {
        if !points.is_empty() {
            self.raw("<ul>");
            for point in points {
                self.element("li", point);
            }
            self.raw("</ul>");
        }
    }

    /// A table as wide as its content.
    pub fn table(&mut self, table: &Table) {
        let row = |tag: &str, row: &[String]| {
            let cell = |(column, text): (usize, &String)| {
                let class = words_if(column >= table.words, " class=\"number\"");
                format!("<{tag}{class}>{}</{tag}>", escaped(text))
            };
            let cells: String = row.iter().enumerate().map(cell).collect();
            format!("<tr>{cells}</tr>")
        };
        let head = row("th", &table.head);
        self.raw(&format!("<table>\n<thead>{head}</thead>\n<tbody>"));
        table.rows.iter().for_each(|cells| self.raw(&row("td", cells)));
        self.raw("</tbody>\n</table>");
    }

    /// What only some readers want: folded on a screen, open in print.
    pub fn details(&mut self, summary: &str, write: impl FnOnce(&mut Self)) {
        self.raw("<details>");
        self.element("summary", summary);
        write(self);
        self.raw("</details>");
    }

    pub fn figure(&mut self, svg: &str, caption: &str) {
        self.raw("<figure>");
        self.raw(svg);
        self.element("figcaption", caption);
        self.raw("</figure>");
    }

    pub fn finish(self) -> String {
        self.0
    }
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
        html.element("dd class=\"value\"", nasty);
        html.list(std::slice::from_ref(&text));
        let table = Table {
            head: vec![text.clone()],
            rows: vec![vec![text]],
            words: 0,
        };
        html.table(&table);
        html.details(nasty, |_| {});
        html.figure("<svg/>", nasty);
        let page = html.finish();
        assert_eq!(page.matches(safe).count(), 6, "{page}");
        assert!(!page.contains("<script"), "{page}");
    }
}
