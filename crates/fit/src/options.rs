//! What a calibration is given.

use calibrate::Loss;

use crate::readings::Readings;
use crate::unknown::Unknown;
use creepage_run::Progress;
use creepage_scene::Scene;

/// A scene and what was measured in it.
#[derive(Debug, Clone, Copy)]
pub struct Series<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Readings of its load cell.
    pub readings: &'a Readings,
}

/// A measured deflection: how far the duct went down under the first vehicle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deflection {
    /// Measured peak \[m\].
    pub value: f64,
    /// Its standard deviation \[m\].
    pub sigma: f64,
}

/// How to calibrate.
#[derive(Debug, Clone, Default)]
pub struct CalibrateOptions<'a> {
    /// What to fit; if empty, the dynamic coefficient and, but for Coulomb's law, the shape factor.
    pub unknowns: Vec<Unknown>,
    /// Prior knowledge of the ground's stiffness, which is then fitted as well.
    pub deflection: Option<Deflection>,
    /// Standard deviation of a load cell's zero before the readings \[N\], if it is fitted; a
    /// quarter of the largest force if left out.
    pub zero_offset_sigma: Option<f64>,
    /// That of its drift \[N per pass\]; if left out, a quarter of that force over all passes.
    pub drift_sigma: Option<f64>,
    /// Whether the model may be wrong by a smooth function of the passes: its standard deviation,
    /// as a share of the largest reading, 1e-4 to 10. Least squares only.
    pub discrepancy: Option<f64>,
    /// How much residuals count.
    pub loss: Loss,
    /// Called after each model run with its share of [`MAX_RUNS`](crate::MAX_RUNS); it may stop
    /// the calibration.
    pub progress: Progress<'a>,
}
