//! `[[route]]`: a duct that slopes, bends or rubs otherwise on some of its length.

use crate::key::Form::Number;
use crate::range::{BEND_RADIUS, COEFFICIENT, SECTION_LENGTH, SLOPE};
use crate::section::keys;

keys! {
    /// A section of the duct, in SI; the first begins at x = 0.
    #[derive(Copy, Default)]
    pub struct RouteSection {
        /// Length of the section along the duct.
        length: Option<f64> = Number(SECTION_LENGTH), "in the last section: all that is left of the duct";
        /// How steeply the section rises with x: tan θ.
        slope: f64 = Number(SLOPE), "0";
        /// Radius of a horizontal bend.
        bend_radius: Option<f64> = Number(BEND_RADIUS), "straight";
        /// Friction of the slipping cable in normal forces, μ_d, on this section.
        dynamic_coefficient: Option<f64> = Number(COEFFICIENT), "that of [friction]";
    }
}

impl RouteSection {
    /// sin θ and cos θ of its slope.
    pub(crate) fn angle(&self) -> (f64, f64) {
        let hypotenuse = 1.0_f64.hypot(self.slope);
        (self.slope / hypotenuse, 1.0 / hypotenuse)
    }
}
