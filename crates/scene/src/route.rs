//! `[[route]]`: a duct that slopes, bends or rubs otherwise on some of its length.

use cable_dem::Section;

use crate::key::Form::Number;
use crate::key::keys;
use crate::range::{BEND_RADIUS, COEFFICIENT, SECTION_LENGTH, SLOPE};
use crate::scene::Scene;

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
    fn angle(&self) -> (f64, f64) {
        let hypotenuse = 1.0_f64.hypot(self.slope);
        (self.slope / hypotenuse, 1.0 / hypotenuse)
    }
}

impl Scene {
    /// The sections of the duct from x = 0 on, each with friction, weight along the duct and bend; one if there is no route.
    pub fn sections(&self) -> Vec<Section> {
        let whole = RouteSection {
            length: Some(self.duct.length),
            slope: self.duct.slope,
            ..RouteSection::default()
        };
        let route = if self.route.is_empty() {
            &[whole][..]
        } else {
            &self.route
        };
        let section = |section: &RouteSection| {
            let (sine, cosine) = section.angle();
            let friction = section
                .dynamic_coefficient
                .unwrap_or(self.friction.dynamic_coefficient);
            Section::new(
                section.length.unwrap_or(0.0),
                friction * self.normal_load() * cosine,
            )
            .with_body_force(-self.cable.weight * sine)
            .with_bend(section.bend_radius.map_or(0.0, |radius| friction / radius))
        };
        route.iter().map(section).collect()
    }

    /// Largest friction per length of cable, q = μ_d N′ cos θ \[N/m\], with the friction coefficient of the scene and the mean of cos θ.
    pub fn friction_limit(&self) -> f64 {
        self.friction.dynamic_coefficient * self.normal_load() * self.mean(|section| section.angle().1)
    }

    /// Force of the cable's weight along the duct per length, p = −w sin θ \[N/m\], positive toward growing x; its mean over the duct.
    pub fn body_force(&self) -> f64 {
        -self.cable.weight * self.mean(|section| section.angle().0)
    }

    /// The mean over the duct's length.
    fn mean(&self, of: impl Fn(&RouteSection) -> f64) -> f64 {
        let whole = RouteSection {
            slope: self.duct.slope,
            ..RouteSection::default()
        };
        let first = of(self.route.first().unwrap_or(&whole));
        if self.route.iter().all(|section| of(section) == first) {
            return first;
        }
        let part = |section: &RouteSection| of(section) * section.length.unwrap_or(0.0);
        self.route.iter().map(part).sum::<f64>() / self.duct.length
    }

    /// Gives the last section of the route what is left of the duct.
    pub(crate) fn complete_route(&mut self) {
        if let Some((last, others)) = self.route.split_last_mut() {
            let used: f64 = others.iter().filter_map(|section| section.length).sum();
            let left = Some(self.duct.length - used).filter(|left| *left > 0.0);
            last.length = last.length.or(left);
        }
    }
}
