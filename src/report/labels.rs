//! What stands beside the ground in the cross-section: layers, rock, the depth of the duct.

use ground_field::{Base, Modulus};

use super::content::Report;
use super::depths::Depths;
use super::figure::WIDTH;
use crate::figure::{Anchor, Drawing, Ink};

/// Where they begin \[px\].
const LABELS: f64 = 232.0;

/// A text beside the ground, and the height that it is about.
pub struct Label {
    lines: Vec<String>,
    /// \[px\] below the surface, then from the top.
    about: f64,
    top: f64,
    is_duct: bool,
}

impl Label {
    fn new(text: &str, about: f64, is_duct: bool) -> Self {
        let fits = Drawing::text_width(text) <= WIDTH - LABELS;
        let lines = match text.split_once(", ") {
            Some((first, rest)) if !fits => vec![format!("{first},"), rest.to_owned()],
            _ => vec![text.to_owned()],
        };
        Self {
            lines,
            about,
            top: 0.0,
            is_duct,
        }
    }

    fn height(&self) -> f64 {
        Drawing::LINE * self.lines.len() as f64
    }

    pub fn bottom(&self) -> f64 {
        self.top + self.height()
    }

    /// Draws it with a line from what it is about: the duct, which ends at `duct`, or the ground, which ends at `edge` \[px\].
    pub fn draw(&self, drawing: &mut Drawing, duct: f64, edge: f64) {
        let middle = self.top + 0.5 * Drawing::LINE;
        let leader = [(duct, self.about), (edge, self.about), (LABELS - 4.0, middle)];
        if self.is_duct {
            drawing.dashed(&leader, Ink::Dark);
        } else {
            drawing.line(&leader[1..], Ink::Grey, 0.8);
        }
        for (k, line) in self.lines.iter().enumerate() {
            let y = middle + Drawing::LINE * k as f64;
            drawing.text(line, (LABELS, y), Anchor::Start);
        }
    }
}

/// Thickness and modulus of each layer, the base, and the depth of the duct, from above to below.
pub fn labels(report: &Report, depths: &Depths) -> Vec<Label> {
    let Report { scene, shown, .. } = report;
    let profile = &scene.ground.profile;
    let mut labels = Vec::new();
    let mut top = 0.0;
    let between = |from: f64, to: f64| 0.5 * (from + to);
    for layer in profile.layers() {
        let bottom = top + layer.thickness();
        let text = format!(
            "{}, {}",
            shown.depth(layer.thickness()),
            shown.moduli(layer.modulus())
        );
        let about = between(depths.place(top), depths.place(bottom));
        labels.push(Label::new(&text, about, false));
        top = bottom;
    }
    let text = match profile.base() {
        Base::HalfSpace(soil) => format!("below, {}", shown.moduli(Modulus::Uniform(soil.young_modulus()))),
        Base::Rigid => format!("rock from {} on", shown.depth(top)),
    };
    let about = between(depths.place(top), depths.height());
    labels.push(Label::new(
        if top == 0.0 {
            text.trim_start_matches("below, ")
        } else {
            &text
        },
        about,
        false,
    ));
    let text = format!("duct, {} deep", shown.depth(scene.duct.depth));
    labels.push(Label::new(&text, depths.place(scene.duct.depth), true));
    labels.sort_by(|a, b| a.about.total_cmp(&b.about));
    labels
}

/// Moves labels apart, each as near to what it is about as it can be.
pub fn spread(labels: &mut [Label], surface: f64, bottom: f64) {
    let mut next = surface - 0.5 * Drawing::LINE;
    for label in labels.iter_mut() {
        label.about += surface;
        label.top = next.max(label.about - 0.5 * Drawing::LINE);
        next = label.bottom();
    }
    // What was moved beyond the ground goes up again as far as there is room.
    let total: f64 = labels.iter().map(Label::height).sum();
    let mut last = bottom.max(surface - 0.5 * Drawing::LINE + total);
    for label in labels.iter_mut().rev() {
        label.top = label.top.min(last - label.height());
        last = label.top;
    }
}
