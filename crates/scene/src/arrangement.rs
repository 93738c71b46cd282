//! Several cables in one duct: how hard each presses on what it lies on.
//!
//! Three cables of diameter d and weight W per metre in a duct of inner diameter D, s = d/(D − d), in equilibrium without friction between
//! them:
//!
//! | | normal force |
//! |---|---|
//! | trefoil, a lower cable on the duct | 1.5 W/√(1 − s²) |
//! | trefoil, the upper one on both lower ones | W/cos 30° |
//! | cradled, an outer cable | W |
//! | cradled, the one in the middle | W (1 + 4 s²) |
//!
//! Summed over the cables these are the weight correction factors of pulling calculations, triangular 1/√(1 − s²) and cradled 1 + 4 s²/3
//! (R. C. Rifenburg, Trans. AIEE 72 (1953) 1275). They are factors for cables that are computed one by one: computed together, the lower ones
//! also carry the upper one's friction.

use crate::section::file_words;

/// Minimum D/d with which three cables fit into a duct: 1 + 2/√3.
pub const CLOSEST: f64 = 2.154_700_538_379_251_5;
/// D/d between which one of three cables may wedge itself between the others as they are pulled in (the same calculations' jam ratio).
pub const JAMMING: std::ops::RangeInclusive<f64> = 2.8..=3.2;

/// How a cable lies in its duct, alone or as one of three.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Arrangement {
    /// Alone.
    #[default]
    Single,
    /// On two others.
    TrefoilUpper,
    /// Under a third one, beside another.
    TrefoilLower,
    /// At the side of three in a row on the bottom of the duct.
    CradledOuter,
    /// Between two others on the bottom of the duct.
    CradledMiddle,
}

file_words! {
    Arrangement: Single "single", TrefoilUpper "trefoil-upper", TrefoilLower "trefoil-lower", CradledOuter "cradled-outer",
    CradledMiddle "cradled-middle"
}

impl Arrangement {
    /// Whether it is one of three cables.
    pub fn is_of_three(self) -> bool {
        self != Self::Single
    }

    /// Normal force as a multiple of the cable's weight, for a cable of `diameter` d \[m\] in a duct of `inner_diameter` D \[m\].
    ///
    /// Not a number where d and D leave no room for the cables; scenes with less than D = 2.155 d are refused.
    ///
    /// ```
    /// use creepage_scene::Arrangement;
    ///
    /// let factor = |arrangement: Arrangement| arrangement.normal_load_factor(0.2, 0.067);
    /// // Triangular, and cradled: all three on the duct relative to three times the weight of one.
    /// assert!((2.0 * factor(Arrangement::TrefoilLower) / 3.0 - 1.158).abs() < 5e-4);
    /// let cradled = 2.0 * factor(Arrangement::CradledOuter) + factor(Arrangement::CradledMiddle);
    /// assert!((cradled / 3.0 - 1.338).abs() < 5e-4);
    /// ```
    pub fn normal_load_factor(self, inner_diameter: f64, diameter: f64) -> f64 {
        let s = diameter / (inner_diameter - diameter);
        match self {
            Self::Single | Self::CradledOuter => 1.0,
            Self::TrefoilLower => 1.5 / (1.0 - s * s).sqrt(),
            Self::TrefoilUpper => 2.0 / 3.0_f64.sqrt(),
            Self::CradledMiddle => 1.0 + 4.0 * s * s,
        }
    }
}
