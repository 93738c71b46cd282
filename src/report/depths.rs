//! What depth lies where in a drawing: to scale, and where the ground goes deeper than there is room, below a break.

use ground_field::Base;

use crate::Scene;

/// Most and least height of the ground \[px\], that of what lies below a break, and of the break.
const MOST: f64 = 250.0;
const LEAST: f64 = 84.0;
const STRIP: f64 = 22.0;
const BREAK: f64 = 14.0;
/// Where the break lies \[px\].
const CUT: f64 = 185.0;
/// Rock that is shown \[px\].
const ROCK: f64 = 14.0;
/// Ground that is always shown to scale \[depths of the duct\], and half-space below its layers.
const SHOWN: f64 = 1.4;
const BELOW: f64 = 0.5;

pub struct Depths {
    /// Pixels a metre.
    scale: f64,
    /// Depths of the layers' lower sides that lie below the break \[m\]; `None` where all is to scale.
    beyond: Option<Vec<f64>>,
    height: f64,
}

impl Depths {
    /// The largest scale \[px/m\] with which a duct at this depth \[m\] lies well above the break.
    pub fn largest_scale(depth: f64) -> f64 {
        CUT / (SHOWN * depth)
    }

    pub fn new(scene: &Scene, scale: f64) -> Self {
        let profile = &scene.ground.profile;
        let mut deepest = 0.0;
        let mut sides = Vec::new();
        for layer in profile.layers() {
            deepest += layer.thickness();
            sides.push(deepest);
        }
        let depth = scene.duct.depth;
        let wanted = match profile.base() {
            // Of rock nothing is needed but its surface.
            Base::Rigid => (scale * deepest.max(depth) + ROCK).max(scale * SHOWN * depth),
            Base::HalfSpace(_) => (scale * (deepest + BELOW * depth).max(SHOWN * depth)).max(LEAST),
        };
        if wanted <= MOST {
            return Self {
                scale,
                beyond: None,
                height: wanted,
            };
        }
        sides.retain(|side| scale * side > CUT);
        // What lies below the last side has a strip too.
        let strips = sides.len() as f64 + 1.0;
        Self {
            scale,
            beyond: Some(sides),
            height: CUT + BREAK + STRIP * strips,
        }
    }

    /// How far below the surface a depth \[m\] is drawn \[px\].
    pub fn place(&self, depth: f64) -> f64 {
        match &self.beyond {
            Some(sides) if self.scale * depth > CUT => {
                let above = sides.iter().filter(|side| **side <= depth).count();
                CUT + BREAK + STRIP * above as f64
            }
            _ => self.scale * depth,
        }
    }

    /// Height of all ground \[px\].
    pub fn height(&self) -> f64 {
        self.height
    }

    pub fn is_cut(&self) -> bool {
        self.beyond.is_some()
    }

    /// Where the break is \[px\].
    pub fn cut(&self) -> Option<f64> {
        self.is_cut().then_some(CUT + 0.5 * BREAK)
    }
}
