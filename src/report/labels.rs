//! What stands beside the ground in the cross-section: layers, rock, the depth of the duct.

use ground_field::{Base, Modulus};

use super::content::Report;
use super::figure::WIDTH;
use crate::figure::{Anchor, Drawing, Ink};

/// Where they begin \[px\].
const LABELS: f64 = 232.0;
/// Labels at most, and the height that one of two lines takes \[px\].
pub const MOST: usize = 4;
pub const ROOM: f64 = 2.0 * Drawing::LINE;

/// A text beside the ground, and the depths that it is about \[m\].
struct Label {
    text: String,
    about: [f64; 2],
    is_duct: bool,
}

/// Thickness and modulus of the layers, the base, and the depth of the duct, from above to below; where there
/// are too many, layers below the first are counted only.
fn labels(report: &Report) -> Vec<Label> {
    let Report { scene, shown, .. } = report;
    let profile = &scene.ground.profile;
    let mut labels = Vec::new();
    let mut top = 0.0;
    for layer in profile.layers() {
        let (thickness, modulus) = (shown.depth(layer.thickness()), shown.moduli(layer.modulus()));
        labels.push(Label {
            text: format!("{thickness}, {modulus}"),
            about: [top, top + layer.thickness()],
            is_duct: false,
        });
        top += layer.thickness();
    }
    // Room for the duct, the base and those that are counted.
    let own = MOST - 2;
    if labels.len() > own {
        let rest = labels.split_off(own - 1);
        labels.push(Label {
            text: format!("{} more layers to {}", rest.len(), shown.depth(top)),
            about: [rest[0].about[0], top],
            is_duct: false,
        });
    }
    let base = match profile.base() {
        Base::HalfSpace(soil) => {
            let modulus = shown.moduli(Modulus::Uniform(soil.young_modulus()));
            let below = if top > 0.0 { "below, " } else { "" };
            format!("{below}{modulus}")
        }
        Base::Rigid => format!("rock from {} on", shown.depth(top)),
    };
    labels.push(Label {
        text: base,
        about: [top, f64::INFINITY],
        is_duct: false,
    });
    labels.push(Label {
        text: format!("duct, {} deep", shown.depth(scene.duct.depth)),
        about: [scene.duct.depth; 2],
        is_duct: true,
    });
    labels
}

/// Draws them beside the ground, which is `high` from `surface` on, each with a line from what it is about:
/// the duct, which ends at `duct`, or the ground, which ends at `edge` \[px\]. `place` says how far below the
/// surface a depth is drawn.
pub fn draw(
    drawing: &mut Drawing,
    report: &Report,
    (surface, high): (f64, f64),
    (duct, edge): (f64, f64),
    place: impl Fn(f64) -> f64,
) {
    let labels = labels(report).into_iter().map(|label| {
        let [from, to] = label.about.map(&place);
        (surface + 0.5 * (from + to), label)
    });
    let mut labels: Vec<(f64, Label)> = labels.collect();
    labels.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut middle = f64::NEG_INFINITY;
    for (k, (about, label)) in labels.iter().enumerate() {
        let about = *about;
        // Two lines below the one before, and with room for those that follow.
        let lowest = surface + high - ROOM * ((labels.len() - k) as f64 - 0.5);
        middle = about.max(middle + ROOM).min(lowest);
        let leader = [(duct, about), (edge, about), (LABELS - 4.0, middle)];
        if label.is_duct {
            drawing.dashed(&leader, Ink::Dark);
        } else {
            drawing.line(&leader[1..], Ink::Grey, 0.8);
        }
        let lines = match label.text.split_once(", ") {
            Some((first, rest)) if Drawing::text_width(&label.text) > WIDTH - LABELS => {
                vec![format!("{first},"), rest.to_owned()]
            }
            _ => vec![label.text.clone()],
        };
        let first = middle - 0.5 * Drawing::LINE * (lines.len() - 1) as f64;
        for (k, line) in lines.iter().enumerate() {
            let y = first + Drawing::LINE * k as f64;
            drawing.text(line, (LABELS, y), Anchor::Start);
        }
    }
}
