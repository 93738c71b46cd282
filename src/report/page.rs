//! The page: its head, its style, and its sections in their order.

use super::Report;
use super::html::{Html, escaped};
use super::sections;
use crate::figure::dark_style;

const STYLE: &str = include_str!("style.css");

pub fn page(report: &Report) -> String {
    let mut html = Html::default();
    html.raw("<!DOCTYPE html>\n<html lang=\"en\">\n<head>");
    html.raw("<meta charset=\"utf-8\"/>");
    html.raw("<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>");
    // Nothing is ever loaded, whatever a text on the page may say.
    html.raw("<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\"/>");
    html.raw("<meta name=\"color-scheme\" content=\"light dark\"/>");
    // By this a page of ours is known from another.
    let version = env!("CARGO_PKG_VERSION");
    html.raw(&format!(
        "<meta name=\"generator\" content=\"creepage {version}\"/>"
    ));
    let title = escaped(&report.scene.title);
    html.raw(&format!("<title>{title}: cable creepage</title>"));
    html.raw(&format!(
        "<style>\n{STYLE}@media screen and (prefers-color-scheme: dark) {{\n{}}}\n</style>",
        dark_style()
    ));
    html.raw("</head>\n<body>\n<main>");
    sections::heading(&mut html, report);
    for (title, write) in SECTIONS {
        html.raw("<section>");
        html.element("h2", title);
        write(&mut html, report);
        html.raw("</section>");
    }
    html.raw("</main>\n</body>\n</html>");
    html.finish()
}

type Section = (&'static str, fn(&mut Html, &Report));

const SECTIONS: [Section; 7] = [
    ("Warnings", sections::warnings),
    ("Scene", sections::scene),
    ("Force and movement", sections::force),
    ("Why the cable creeps", sections::cause),
    ("Ways to hold the cable", sections::holding),
    ("How it was computed", sections::plan),
    ("What is left out", sections::limits),
];
