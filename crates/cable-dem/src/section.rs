//! Sections of a duct: along each of them slope, bend and surface are the same.

use crate::error::{checked, not_negative, positive};
use crate::{CableError, Mesh};

/// A share of a node's length that is less is rounding.
const ROUNDING: f64 = 1e-9;

/// A section of the duct.
///
/// ```
/// use cable_dem::Section;
///
/// // 30 m that rise by 3 %, under a cable of 108.8 N/m with μ = 0.25, and a bend of 10 m radius.
/// let slope = Section::new(30.0, 0.25 * 108.8).with_body_force(-0.03 * 108.8);
/// let bend = Section::new(15.7, 0.25 * 108.8).with_bend(0.25 / 10.0);
/// assert_eq!(slope.limit_under(1000.0), 0.25 * 108.8);
/// assert!(bend.limit_under(1000.0) > bend.limit);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Section {
    /// Length \[m\].
    pub length: f64,
    /// Friction limit μ N of a cable that nothing presses sideways \[N/m\].
    pub limit: f64,
    /// Force p along the duct on every metre of cable \[N/m\], positive toward growing x: −w sin θ on a slope.
    pub body_force: f64,
    /// Friction limit for each newton of force in the cable, μ/R in a horizontal bend of radius R \[1/m\]; 0 if straight.
    pub bend: f64,
}

impl Section {
    /// A level and straight one of `length` \[m\] with the friction `limit` μ N \[N/m\].
    pub fn new(length: f64, limit: f64) -> Self {
        Self {
            length,
            limit,
            body_force: 0.0,
            bend: 0.0,
        }
    }

    /// The same with a force p along the duct on every metre \[N/m\].
    #[must_use]
    pub fn with_body_force(self, body_force: f64) -> Self {
        Self { body_force, ..self }
    }

    /// The same in a horizontal bend, `bend` = μ/R \[1/m\].
    #[must_use]
    pub fn with_bend(self, bend: f64) -> Self {
        Self { bend, ..self }
    }

    /// Friction limit \[N/m\] with the `force` F \[N\] in the cable, which presses it sideways with F/R in a bend: q = √((μ N)² + (μ F/R)²).
    pub fn limit_under(&self, force: f64) -> f64 {
        if self.bend == 0.0 {
            self.limit
        } else {
            self.limit.hypot(self.bend * force)
        }
    }

    /// Refuses values that have no meaning for a cable with the friction `limit` \[N/m\].
    pub(crate) fn check(&self, limit: f64) -> Result<(), CableError> {
        positive("section length", self.length)?;
        let rubs = |v: f64| if limit == 0.0 { v == 0.0 } else { v > 0.0 };
        let allowed = "positive, or 0 without friction";
        checked("friction limit of a section", self.limit, allowed, rubs)?;
        checked("body force of a section", self.body_force, "finite", |_| true)?;
        not_negative("bend of a section", self.bend)?;
        Ok(())
    }

    /// Whether slope, bend and surface are those of `other`.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        let length = self.length;
        *self == Self { length, ..*other }
    }
}

/// The `sections` on which `node` of `mesh` lies, each with its share of the node's length.
pub(crate) fn shares<'a>(
    sections: &'a [Section],
    mesh: &Mesh,
    node: usize,
) -> impl Iterator<Item = (f64, &'a Section)> {
    let tributary = mesh.tributary_length(node);
    let place = mesh.spacing() * node as f64;
    let from = (place - 0.5 * mesh.spacing()).max(0.0);
    let to = (place + 0.5 * mesh.spacing()).min(mesh.length());
    let mut begin = 0.0;
    let share = move |section: &'a Section| {
        let end = begin + section.length;
        let share = (to.min(end) - from.max(begin)) / tributary;
        begin = end;
        // What rounding leaves over at a border is nothing.
        (if share > 1.0 - ROUNDING { 1.0 } else { share }, section)
    };
    sections.iter().map(share).filter(|(share, _)| *share > ROUNDING)
}
