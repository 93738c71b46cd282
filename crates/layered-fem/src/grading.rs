//! Where the lines of the mesh lie.
//!
//! Every field of the problem varies over the distance R to the load, so the spacing grows with it: h = α √(x² + c²), which
//! is x = c sinh(α i), for r and z alike. `α` sets the accuracy and the cost; `c` is the size of the block in the top layer
//! in which the load's singularity is taken out (see [`crate::load`]). Where the modulus varies within a layer the fields vary
//! over E/|E'| as well: the stretched coordinate is then asinh(z/c) + |ln E|, so that 1/h is the sum of both. In depth the same
//! spacing is fitted between the layers' interfaces, each layer having at least two elements on the coarsest mesh: a soft layer
//! between stiff ones shears and squeezes over its own thickness.

use ground_field::{Base, Soil, SoilLayer, SoilProfile};

use crate::FemError;

/// Largest size of the block around the load \[m\].
const LARGEST_BLOCK: f64 = 0.3;
/// Minimum number of elements in a layer.
const MIN_ELEMENTS: usize = 2;
/// Minimum length over which the spacing is even \[m\]: a top layer still thinner is not resolved around the load, which is
/// felt at depths of its own order only.
const SMALLEST_SCALE: f64 = 0.002;
/// Spacing ratio at which the outer boundary has its ordinary distance. It moves out as the spacing falls, so that two meshes
/// differ in everything that can be wrong with them.
const ORDINARY_ALPHA: f64 = 0.4;
/// Ordinary distance of the outer boundary in units of the ground's own length.
const REACH_HALF_SPACE: f64 = 50.0;
const REACH_MEMBRANE: f64 = 15.0;
const REACH_RIGID: f64 = 10.0;
/// The ground's own length is taken at least this large \[m\].
const MIN_LENGTH: f64 = 5.0;

/// Neighbouring rows of elements in one soil.
#[derive(Debug, Clone)]
pub(crate) struct Band {
    /// The layer; the base counts as one, as thick as the mesh is deep.
    pub(crate) layer: SoilLayer,
    /// Depth of the layer's top \[m\].
    pub(crate) top: f64,
    /// The first row below.
    pub(crate) end: usize,
}

impl Band {
    pub(crate) fn soil_at(&self, depth: f64) -> Soil {
        self.layer.soil_at(depth - self.top)
    }
}

/// The lines of one mesh.
#[derive(Debug, Clone)]
pub(crate) struct Lines {
    /// Radii of the vertical lines \[m\].
    pub(crate) radii: Vec<f64>,
    /// Depths of the horizontal lines \[m\].
    pub(crate) depths: Vec<f64>,
    /// The rows of elements from the surface down; the first band is that of the block around the load.
    pub(crate) bands: Vec<Band>,
    /// Columns of elements in the block around the load.
    pub(crate) block_columns: usize,
    /// Length c over which the spacing is even \[m\].
    pub(crate) scale: f64,
    /// Parts into which the intervals of the first mesh are cut.
    pub(crate) parts: usize,
}

/// Depth \[m\] of the block around the load: within the `top` layer, and where its modulus has not changed much.
fn block_depth(top: &SoilLayer) -> f64 {
    let thickness = top.thickness();
    let (first, last) = (top.young_modulus_at(0.0), top.young_modulus_at(thickness));
    let change = (last - first).abs() / first.min(last);
    // Never nothing: without a block a point load would be lost.
    let even = (thickness / change.max(1.0)).max(f64::MIN_POSITIVE);
    LARGEST_BLOCK.min(thickness).min(even)
}

/// Distance of the outer boundary \[m\].
///
/// A layer stiffer than the soil below spreads the load: as a plate over (E₁/E₂)^(1/3) of its thickness on a half-space, and
/// over (E₁/E₂)^(1/2) on a soft layer above rock. It also holds back the horizontal displacement, as a membrane, over E₁/E₂
/// of its thickness.
fn reach(profile: &SoilProfile) -> f64 {
    let ends = |layer: &SoilLayer| [0.0, layer.thickness()].map(|height| layer.young_modulus_at(height));
    let moduli = || profile.layers().iter().flat_map(ends);
    let stiffest = moduli().fold(0.0, f64::max);
    let depth = profile.base_depth();
    match profile.base() {
        Base::HalfSpace(soil) => {
            let base = soil.young_modulus();
            let plate = depth * (stiffest / base).max(1.0).cbrt();
            let stretch = |layer: &SoilLayer| layer.thickness() * ends(layer)[0].max(ends(layer)[1]) / base;
            let membrane: f64 = profile.layers().iter().map(stretch).sum();
            (REACH_HALF_SPACE * plate.max(MIN_LENGTH)).max(REACH_MEMBRANE * membrane)
        }
        Base::Rigid => {
            let softest = moduli().fold(f64::INFINITY, f64::min);
            REACH_RIGID * (depth * (stiffest / softest).sqrt()).max(MIN_LENGTH)
        }
    }
}

impl Lines {
    /// Lines for `profile` with the spacing ratio `alpha`, every interval cut into `parts`.
    ///
    /// # Errors
    ///
    /// [`FemError::TooLarge`] beyond `max_unknowns`.
    pub(crate) fn new(
        profile: &SoilProfile,
        alpha: f64,
        parts: usize,
        max_unknowns: usize,
    ) -> Result<Self, FemError> {
        let mut layers = profile.layers().to_vec();
        let block = layers.first().map_or(LARGEST_BLOCK, block_depth);
        let scale = (0.5 * block).max(SMALLEST_SCALE);
        let reach = ORDINARY_ALPHA / alpha * parts as f64 * reach(profile).max(50.0 * scale);
        let grade = Grade {
            scale,
            alpha,
            parts,
            max_unknowns,
        };
        if let Base::HalfSpace(soil) = profile.base() {
            let thickness = if layers.is_empty() { block + reach } else { reach };
            layers.extend(SoilLayer::uniform(thickness.min(f64::MAX), soil));
        }
        let (mut depths, mut bands, mut bottom) = (vec![0.0], Vec::new(), 0.0);
        for layer in layers {
            let top = bottom;
            bottom += layer.thickness();
            for end in [block, bottom] {
                if grade.fill(end, &mut depths, |depth| steepness(&layer, depth - top))? > 0 {
                    let end = depths.len() - 1;
                    bands.push(Band { layer, top, end });
                }
            }
        }
        let mut radii = vec![0.0];
        let block_columns = grade.fill(block, &mut radii, |_| 0.0)?;
        grade.fill(block + reach, &mut radii, |_| 0.0)?;
        grade.check(2 * (2 * radii.len() - 1) * (2 * depths.len() - 1))?;
        Ok(Self {
            radii,
            depths,
            bands,
            block_columns,
            scale,
            parts,
        })
    }
}

/// |ln E| at `height` below the layer's top, from there; 0 if the layer is uniform.
fn steepness(layer: &SoilLayer, height: f64) -> f64 {
    if layer.soil().is_some() {
        return 0.0;
    }
    // Rounding of the layer's bottom is not to leave the layer.
    let modulus = layer.young_modulus_at(height.clamp(0.0, layer.thickness()));
    (modulus / layer.young_modulus_at(0.0)).ln().abs()
}

struct Grade {
    scale: f64,
    alpha: f64,
    parts: usize,
    max_unknowns: usize,
}

impl Grade {
    /// Continues `lines` to `end` in a soil whose |ln E| is `steepness`, monotone in the depth, and returns the number of intervals added:
    /// none if `end` is there already.
    fn fill(
        &self,
        end: f64,
        lines: &mut Vec<f64>,
        steepness: impl Fn(f64) -> f64,
    ) -> Result<usize, FemError> {
        let start = lines.last().copied().unwrap_or(0.0);
        if end <= start {
            return Ok(0);
        }
        let stretched = |x: f64| (x / self.scale).asinh() + steepness(x);
        let (first, last) = (stretched(start), stretched(end));
        let count = (((last - first) / self.alpha).round() as usize)
            .max(MIN_ELEMENTS)
            .saturating_mul(self.parts);
        self.check(count.saturating_add(lines.len()))?;
        let uniform = steepness(start) == steepness(end);
        for k in 1..count {
            let wanted = first + (last - first) * k as f64 / count as f64;
            lines.push(if uniform {
                self.scale * wanted.sinh()
            } else {
                bisected(start, end, |x| stretched(x) < wanted)
            });
        }
        lines.push(end);
        Ok(count)
    }

    fn check(&self, needed: usize) -> Result<(), FemError> {
        let allowed = self.max_unknowns;
        if needed > allowed {
            return Err(FemError::TooLarge { needed, allowed });
        }
        Ok(())
    }
}

/// Where `below`, true at `low` and false at `high`, changes.
fn bisected(mut low: f64, mut high: f64, below: impl Fn(f64) -> bool) -> f64 {
    // To rounding.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        let end = if below(middle) { &mut low } else { &mut high };
        *end = middle;
    }
    0.5 * (low + high)
}
