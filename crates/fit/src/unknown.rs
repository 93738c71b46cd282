//! What can be fitted, and between which bounds.

use std::fmt;
use std::str::FromStr;

use creepage_scene::Scene;

/// A quantity that can be fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Quantity {
    /// μ_d, dynamic friction coefficient.
    DynamicCoefficient,
    /// b \[1/m\], how steeply friction builds up before the cable slips. From about 1e9 1/m on no
    /// force tells it from Coulomb's law, which is the upper bound's meaning.
    ShapeFactor,
    /// How many times stiffer the ground is than the scene's: the duct's motion is divided by it.
    GroundStiffness,
    /// What a load cell reads too much of any force \[N\].
    ZeroOffset,
    /// How much more it reads too much with every pass \[N\].
    Drift,
    /// μ_d of the section of the route with this index.
    SectionCoefficient(usize),
}

/// Of what is not known beforehand.
const ANY: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);

/// Names, units (1 for a number), and the least and the largest value that a fit considers; those of a cell's
/// errors follow from the readings.
const QUANTITIES: [(Quantity, &str, &str, (f64, f64)); 5] = [
    (
        Quantity::DynamicCoefficient,
        "dynamic_coefficient",
        "1",
        (0.03, 1.0),
    ),
    (Quantity::ShapeFactor, "shape_factor", "1/m", (1e5, 1e9)),
    (Quantity::GroundStiffness, "ground_stiffness", "1", (0.1, 10.0)),
    (Quantity::ZeroOffset, "zero_offset", "N", ANY),
    (Quantity::Drift, "drift", "N/pass", ANY),
];

/// Its name; of a section its key, `route.1.dynamic_coefficient`.
impl fmt::Display for Quantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Self::SectionCoefficient(index) = self {
            return write!(f, "route.{index}.dynamic_coefficient");
        }
        f.pad(self.row().1)
    }
}

impl FromStr for Quantity {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let named = QUANTITIES.iter().find(|(_, name, ..)| *name == text);
        let section = || text.strip_prefix("route.")?.strip_suffix(".dynamic_coefficient");
        let section = || section()?.parse().ok().map(Self::SectionCoefficient);
        let found = named.map(|(quantity, ..)| *quantity).or_else(section);
        found.ok_or_else(|| {
            let names = QUANTITIES.map(|(_, name, ..)| name).join(", ");
            format!("found \"{text}\"; allowed: {names}, route.1.dynamic_coefficient")
        })
    }
}

impl Quantity {
    /// What is known of it: the coefficient of a section is one like any.
    fn row(self) -> &'static (Self, &'static str, &'static str, (f64, f64)) {
        let row = QUANTITIES.iter().find(|(quantity, ..)| *quantity == self);
        row.unwrap_or(&QUANTITIES[0])
    }

    /// Its unit; 1 for a number.
    pub fn unit(self) -> &'static str {
        self.row().2
    }

    /// Whether it is an error of a load cell, not a property of cable or ground.
    pub fn is_of_cell(self) -> bool {
        matches!(self, Self::ZeroOffset | Self::Drift)
    }

    /// Minimum and maximum value that a fit considers.
    pub(super) fn bounds(self) -> (f64, f64) {
        self.row().3
    }

    /// Sets its value in a scene; the ground's stiffness acts on the motion instead.
    pub(super) fn set(self, scene: &mut Scene, value: f64) {
        match self {
            Self::DynamicCoefficient => scene.friction.dynamic_coefficient = value,
            Self::ShapeFactor => scene.friction.shape_factor = Some(value),
            Self::SectionCoefficient(index) => scene.route[index].dynamic_coefficient = Some(value),
            Self::GroundStiffness | Self::ZeroOffset | Self::Drift => {}
        }
    }
}

/// A quantity to be fitted, of one series or of all.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Unknown {
    /// The quantity.
    pub quantity: Quantity,
    /// Index of the series that it belongs to; `None` if all share one value.
    pub series: Option<usize>,
}

impl Unknown {
    /// One value for all series.
    pub const fn shared(quantity: Quantity) -> Self {
        Self {
            quantity,
            series: None,
        }
    }

    /// A value of one series alone.
    pub const fn of(quantity: Quantity, series: usize) -> Self {
        Self {
            quantity,
            series: Some(series),
        }
    }

    /// Whether it acts on the series of this index.
    pub(super) fn acts_on(self, series: usize) -> bool {
        self.series.is_none_or(|own| own == series)
    }
}

/// As it is printed: a quantity's name, or one with the number of its series, from 1.
impl FromStr for Unknown {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if let Some((quantity, number)) = text.rsplit_once('_')
            && let (Ok(quantity), Ok(number @ 1..)) = (quantity.parse(), number.parse::<usize>())
        {
            return Ok(Self::of(quantity, number - 1));
        }
        text.parse().map(Self::shared)
    }
}

/// The quantity's name, with the number of its series, from 1, if it has one.
impl fmt::Display for Unknown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.series {
            None => write!(f, "{}", self.quantity),
            Some(series) => write!(f, "{}_{}", self.quantity, series + 1),
        }
    }
}
