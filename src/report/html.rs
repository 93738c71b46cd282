//! Elements of the page. Every text is escaped here and nowhere else.

/// A page in the making, with the elements that a report needs.
#[derive(Default)]
pub struct Html(String);

impl Html {
    /// Markup or a drawing as it is.
    pub fn raw(&mut self, markup: &str) {
        self.0.push_str(markup);
        self.0.push('\n');
    }

    pub fn element(&mut self, tag: &str, text: &str) {
        self.raw(&format!("<{tag}>{}</{tag}>", escaped(text)));
    }

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

    /// A table as wide as its content, with `texts` columns of text before those of numbers.
    pub fn table(&mut self, texts: usize, head: &[&str], rows: impl IntoIterator<Item = Vec<String>>) {
        let cell = |tag: &str, column: usize, text: &str| {
            let class = if column >= texts { " class=\"number\"" } else { "" };
            format!("<{tag}{class}>{}</{tag}>", escaped(text))
        };
        let head = head.iter().enumerate();
        let head: String = head.map(|(k, text)| cell("th", k, text)).collect();
        self.raw("<table>");
        self.raw(&format!("<thead><tr>{head}</tr></thead>"));
        self.raw("<tbody>");
        for row in rows {
            let row = row.iter().enumerate();
            let cells: String = row.map(|(k, text)| cell("td", k, text)).collect();
            self.raw(&format!("<tr>{cells}</tr>"));
        }
        self.raw("</tbody>");
        self.raw("</table>");
    }

    /// A number at the top of the page: what it is, the number with its unit, and a remark.
    pub fn headline(&mut self, name: &str, value: &str, note: &str) {
        self.raw("<div>");
        self.element("dt", name);
        self.raw(&format!("<dd class=\"value\">{}</dd>", escaped(value)));
        self.element("dd", note);
        self.raw("</div>");
    }

    /// Whether each limit is kept, and in what words.
    pub fn verdicts(&mut self, verdicts: impl IntoIterator<Item = (bool, String)>) {
        let points: Vec<String> = verdicts
            .into_iter()
            .map(|(kept, words)| {
                let class = if kept { "kept" } else { "exceeded" };
                format!("<li class=\"{class}\">{}</li>", escaped(&words))
            })
            .collect();
        if !points.is_empty() {
            self.raw(&format!("<ul class=\"verdicts\">{}</ul>", points.concat()));
        }
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
        html.table(0, &[nasty], [vec![text]]);
        html.headline(nasty, nasty, nasty);
        html.verdicts([(true, nasty.to_owned())]);
        html.details(nasty, |_| {});
        html.figure("<svg/>", nasty);
        let page = html.finish();
        assert_eq!(page.matches(safe).count(), 10, "{page}");
        assert!(!page.contains("<script"), "{page}");
    }
}
