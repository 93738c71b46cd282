//! Where the lines of the mesh lie.
//!
//! Every field of the problem varies over the distance R to the load, so the spacing grows with it: h = α √(x² + c²), which
//! is x = c sinh(α i), for r and z alike. `α` sets the accuracy and the cost; `c` is the size of the block in the top layer
//! in which the load's singularity is taken out (see [`crate::load`]). In depth the same spacing is fitted between the
//! layers' interfaces, with a least number of elements in each layer.

use ground_field::{Base, SoilProfile};

/// Largest size of the block around the load \[m\].
const LARGEST_BLOCK: f64 = 0.3;
/// The block's least size \[m\]: below, the point load is spread by the mesh itself, which is not felt at depths far above.
const SMALLEST_SCALE: f64 = 0.01;
/// Distance of the outer boundary in units of the ground's own length.
const REACH_HALF_SPACE: f64 = 50.0;
const REACH_RIGID: f64 = 10.0;
/// The ground's own length is taken at least this large \[m\].
const LEAST_LENGTH: f64 = 5.0;

/// The lines of one mesh.
#[derive(Debug, Clone)]
pub(crate) struct Lines {
    /// Radii of the vertical lines \[m\].
    pub(crate) radii: Vec<f64>,
    /// Depths of the horizontal lines \[m\].
    pub(crate) depths: Vec<f64>,
    /// Layer of each row of elements; the number of layers for the base.
    pub(crate) layer_of_row: Vec<usize>,
    /// Columns of elements in the block around the load.
    pub(crate) block_columns: usize,
    /// Rows of elements in the block around the load.
    pub(crate) block_rows: usize,
    /// Length c over which the spacing is even \[m\].
    pub(crate) scale: f64,
}

/// Depth \[m\] of the block around the load: within the top layer, and where its modulus has not changed much.
fn block_depth(profile: &SoilProfile) -> f64 {
    let Some(top) = profile.layers().first() else {
        return LARGEST_BLOCK;
    };
    let thickness = top.thickness();
    let (first, last) = (top.young_modulus_at(0.0), top.young_modulus_at(thickness));
    let change = (last - first).abs() / first.min(last);
    LARGEST_BLOCK.min(thickness).min(thickness / change.max(1.0))
}

/// Distance of the outer boundary \[m\].
///
/// A layer stiffer than the soil below spreads the load: as a plate over (E₁/E₂)^(1/3) of its thickness on a half-space, and
/// over (E₁/E₂)^(1/2) on a soft layer above rock.
fn reach(profile: &SoilProfile) -> f64 {
    let moduli = || {
        profile
            .layers()
            .iter()
            .flat_map(|layer| [layer.young_modulus_at(0.0), layer.young_modulus_at(layer.thickness())])
    };
    let stiffest = moduli().fold(0.0, f64::max);
    let depth = profile.base_depth();
    match profile.base() {
        Base::HalfSpace(soil) => {
            let ratio = (stiffest / soil.young_modulus()).max(1.0);
            REACH_HALF_SPACE * (depth * ratio.cbrt()).max(LEAST_LENGTH)
        }
        Base::Rigid => {
            let ratio = stiffest / moduli().fold(f64::INFINITY, f64::min);
            REACH_RIGID * (depth * ratio.sqrt()).max(LEAST_LENGTH)
        }
    }
}

impl Lines {
    /// Lines for `profile` with spacing ratio `alpha`, at least `least` elements in a layer, and the outer boundary at
    /// `stretch` times its ordinary distance.
    pub(crate) fn new(profile: &SoilProfile, alpha: f64, least: usize, stretch: f64) -> Self {
        let block = block_depth(profile);
        let scale = (0.5 * block).max(SMALLEST_SCALE);
        let reach = stretch * reach(profile).max(50.0 * scale);
        let graded = |from: f64, to: f64, least: usize, lines: &mut Vec<f64>| {
            let (first, last) = ((from / scale).asinh(), (to / scale).asinh());
            let count = (((last - first) / alpha).round() as usize).max(least);
            for k in 1..count {
                lines.push(scale * (first + (last - first) * k as f64 / count as f64).sinh());
            }
            lines.push(to);
            count
        };
        let mut depths = vec![0.0];
        let mut layer_of_row = Vec::new();
        let block_rows = graded(0.0, block, least, &mut depths);
        layer_of_row.extend(std::iter::repeat_n(0, block_rows));
        let mut bottom = 0.0;
        for (index, layer) in profile.layers().iter().enumerate() {
            let top = if index == 0 { block } else { bottom };
            bottom += layer.thickness();
            if bottom > top {
                let rows = graded(top, bottom, least, &mut depths);
                layer_of_row.extend(std::iter::repeat_n(index, rows));
            }
        }
        if matches!(profile.base(), Base::HalfSpace(_)) {
            let top = bottom.max(block);
            let rows = graded(top, top + reach, least, &mut depths);
            layer_of_row.extend(std::iter::repeat_n(profile.layers().len(), rows));
        }
        let mut radii = vec![0.0];
        let block_columns = graded(0.0, block, least, &mut radii);
        graded(block, block + reach, least, &mut radii);
        Self {
            radii,
            depths,
            layer_of_row,
            block_columns,
            block_rows,
            scale,
        }
    }
}
