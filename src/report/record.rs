//! What the page was made from, and by what.

use super::content::Report;
use super::html::Html;

impl Report {
    /// When, by which program and from which file the page was made.
    pub(super) fn made(&self) -> String {
        let date = self
            .date
            .as_ref()
            .map_or(String::new(), |date| format!(" on {date}"));
        let file = self.sources.first().filter(|_| self.is_from_file);
        let from = file.map_or(String::new(), |source| format!(" from {}", source.name));
        format!("computed{date} by creepage {}{from}", env!("CARGO_PKG_VERSION"))
    }
}

/// The record by which the page can be checked later.
pub fn record(html: &mut Html, report: &Report) {
    let made = report.made();
    let [first, rest] = [&made[..1], &made[1..]];
    html.paragraph(&format!("{}{rest}.", first.to_uppercase()));
    if !report.overrides.is_empty() {
        html.paragraph("Set on top of the scene’s file:");
        html.list(&report.overrides);
    }
    let rows = report
        .sources
        .iter()
        .map(|source| vec![source.name.clone(), source.sha256.clone()]);
    html.raw("<div class=\"digests\">");
    html.table(2, &["read", "SHA-256"], rows);
    html.raw("</div>");
}
