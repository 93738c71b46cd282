//! What a calibration answers. Fields have the names of the JSON document, units included.

use serde::Serialize;

/// A calibrated scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Calibrated {
    /// The scenes' titles.
    pub titles: Vec<String>,
    /// The fitted parameters.
    pub parameters: Vec<FittedParameter>,
    /// Their correlation; null if one of them has no standard error.
    pub correlation: Vec<Vec<Option<f64>>>,
    /// Root of the mean square of the residuals of the forces that are kept \[N\]; 0 without any.
    pub residual_rms_n: f64,
    /// How large the residuals are, of each kind of reading.
    pub residuals: Vec<ResidualSize>,
    /// Share of the forces' variance that the model explains; null if they do not vary.
    pub r_squared: Option<f64>,
    /// Runs of the model, all meshes together.
    pub evaluations: usize,
    /// What the user should know before trusting the answer.
    pub warnings: Vec<String>,
    /// Whether the residuals are noise.
    pub lack_of_fit: LackOfFit,
    /// What the answer takes from the scene that these readings do not show, and what an error of
    /// it would do.
    pub assumptions: Vec<String>,
    /// Standard deviation of the noise \[N\] as estimated; null if every reading has its own.
    pub noise_n: Option<f64>,
    /// Readings less the parameters that they determine.
    pub degrees_of_freedom: f64,
    /// How it was fitted.
    pub method: FitMethod,
    /// What the meshes do to the answer.
    pub model_error: ModelErrorEstimate,
    /// Readings and what the calibrated model says to them.
    pub fit: Vec<FittedReading>,
}

/// R² of a model whose residuals are three times the spread of the readings: it does not follow
/// them at all, however few they are.
const MISSED: f64 = -8.0;

/// How many times the spread of the readings the residuals are, if the model does not follow them.
pub fn misses_by(r_squared: Option<f64>) -> Option<f64> {
    let missed = r_squared.filter(|explained| *explained < MISSED)?;
    Some((1.0 - missed).sqrt())
}

impl Calibrated {
    /// How many times their spread the model misses the readings by, if it does not follow them at
    /// all.
    pub fn misses_by(&self) -> Option<f64> {
        misses_by(self.r_squared)
    }
}

/// A fitted parameter.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedParameter {
    /// Its name.
    pub name: String,
    /// Its unit; 1 for a number.
    pub unit: &'static str,
    /// Best value.
    pub value: f64,
    /// Standard error; null if the readings say nothing about it.
    pub standard_error: Option<f64>,
    /// Interval that holds the true value in 95 % of all cases; null is an end that is not closed.
    pub interval_95: [Option<f64>; 2],
    /// Whether the interval is closed on both sides, and the fit not suspicious.
    pub identifiable: bool,
    /// Likelihood along the parameter.
    pub profile: Vec<ProfilePoint>,
}

/// A point of a profile.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ProfilePoint {
    /// Value of the parameter.
    pub value: f64,
    /// Rise of the deviance above its minimum, all others fitted, in squared standard errors.
    pub rise: f64,
}

/// How it was fitted.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FitMethod {
    /// Solver of the cable.
    pub cable: String,
    /// Where the first reading of each series was taken.
    pub load_cell: Vec<String>,
    /// Distance between nodes \[m\], of each series.
    pub node_spacing_m: Vec<f64>,
    /// Advance of the vehicle per step \[m\], of each series.
    pub vehicle_step_m: Vec<f64>,
    /// Loss.
    pub loss: &'static str,
    /// How sure the intervals are, and what they are made of.
    pub intervals: String,
}

/// What is left of the error of the mesh, half the difference to one twice as fine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelErrorEstimate {
    /// Of a force, as a share of the largest.
    pub relative: f64,
    /// Of each parameter, in standard errors.
    pub standard_errors: Vec<f64>,
}

/// A reading and what the calibrated model says to it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FittedReading {
    /// Number of the series, from 1.
    pub series: usize,
    /// Number of the pass, as the file has it.
    pub pass: u64,
    /// Measured force \[N\]; null if something else was measured.
    pub force_n: Option<f64>,
    /// Force of the calibrated model \[N\].
    pub fitted_n: Option<f64>,
    /// Measured less fitted \[N\].
    pub residual_n: Option<f64>,
    /// How much the reading counts: 1, less for an outlier in a robust fit.
    pub weight: f64,
    /// Name of its run; empty if there is one run.
    pub run: String,
    /// Line of the file, from 1.
    pub line: u64,
    /// What was measured.
    pub measured: &'static str,
    /// Where: an end, or metres from the upstream one.
    pub at: String,
    /// Measured value, forces included, in `unit`.
    pub value: f64,
    /// The calibrated model's.
    pub fitted: f64,
    /// Measured less fitted.
    pub residual: f64,
    /// Unit of these three; 1 for a number.
    pub unit: &'static str,
}

/// Whether the residuals are noise.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LackOfFit {
    /// Probability of so few changes of sign by chance.
    pub p_runs: f64,
    /// Probability that noise alone shows so much drift; null if it is fitted or not known.
    pub p_trend: Option<f64>,
    /// Probability that noise alone shows a zero that is off by so much; null as before.
    pub p_offset: Option<f64>,
    /// Probability of residuals so much larger than neighbouring readings differ: of an R² below
    /// what the noise explains.
    pub p_noise: Option<f64>,
    /// Probability of residuals so much larger than the sigmas of the readings; null if these
    /// have none.
    pub p_sigma: Option<f64>,
    /// Whether any of these is below 0.01 (0.03 of the second and third), readings are outliers, or
    /// the data look mistaken: then no parameter is called identifiable.
    pub suspicious: bool,
}

/// How large the residuals of one kind of reading are.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ResidualSize {
    /// What was measured.
    pub measured: &'static str,
    /// Root of the mean square of the residuals of the readings that the fit keeps, in `unit`.
    pub rms: f64,
    /// Its unit; 1 for a number.
    pub unit: &'static str,
    /// Readings that it keeps.
    pub readings: usize,
    /// Outliers that a robust fit leaves out.
    pub left_out: usize,
}

impl std::fmt::Display for ResidualSize {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.measured, self.unit) {
            ("force", unit) => write!(f, "{:.2} {unit} rms", self.rms)?,
            (measured, "1") => write!(f, "{measured} {:.2e} rms", self.rms)?,
            (measured, unit) => write!(f, "{measured} {:.2e} {unit} rms", self.rms)?,
        }
        match self.left_out {
            0 => Ok(()),
            count => write!(f, " of {} readings, {count} left out", self.readings),
        }
    }
}
