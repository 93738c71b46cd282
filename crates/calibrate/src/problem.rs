//! What is given: a model, its parameters, and the observations that they are fitted to.

use crate::{CalibrationError, Emulator, Model, Options, Parameter, Part};

/// Least noise of the model itself, as a share of its predictions: what an emulator resolves.
const RESOLUTION: f64 = 1e-7;

/// A model to be fitted to observations.
#[derive(Debug, Clone)]
pub struct Problem<'a> {
    pub model: &'a dyn Model,
    /// Those asked for, and in a fit with a discrepancy its coefficients.
    pub parameters: Vec<Parameter>,
    pub observations: Vec<f64>,
    /// 1 where the noise is to be estimated.
    pub sigmas: Vec<f64>,
    pub knows_noise: bool,
    pub options: Options,
    /// How many parameters are asked for.
    pub asked: usize,
    /// What is known of the model beforehand.
    pub emulator: Option<Emulator>,
}

impl Problem<'_> {
    /// The indices of the parameters that the model takes.
    pub fn of_model(&self) -> Vec<usize> {
        let of_model = |&k: &usize| self.parameters[k].column().is_none();
        (0..self.parameters.len()).filter(of_model).collect()
    }

    /// Number of parameters with prior knowledge.
    pub fn priors(&self) -> usize {
        self.parameters.iter().filter(|p| p.prior.is_some()).count()
    }

    /// Noise of each prediction of the model itself, in units of the sigmas.
    pub fn model_noise(&self) -> impl Iterator<Item = f64> {
        let share = self.options.relative_noise.max(RESOLUTION);
        let sizes = self.observations.iter().zip(&self.sigmas);
        sizes.map(move |(value, sigma)| share * value.abs() / sigma)
    }

    /// What is known of the model before the fit.
    pub fn first_emulator(&self) -> Result<Emulator, CalibrationError> {
        let parameters = self.of_model().into_iter().map(|k| self.parameters[k].clone());
        let fresh = Emulator::new(parameters.collect(), self.parts()?);
        let emulator = match &self.emulator {
            Some(known) if !known.is_like(&fresh) => {
                let what = "number of parameters of a fit that begins with an earlier one";
                let allowed = "the same parameters and number of observations as there";
                let count = self.of_model().len() as f64;
                return Err(CalibrationError::invalid(what, count, allowed));
            }
            Some(known) => known.clone(),
            None => fresh,
        };
        Ok(emulator.with_noise(self.options.relative_noise))
    }

    /// What acts on which predictions: by default every parameter of the model on all.
    fn parts(&self) -> Result<Vec<Part>, CalibrationError> {
        let (observations, count) = (self.observations.len(), self.of_model().len());
        let mut parts = self.model.parts();
        if parts.is_empty() {
            parts.push(Part {
                predictions: observations,
                parameters: (0..count).collect(),
            });
        }
        let predictions = parts.iter().map(|part| part.predictions).sum();
        CalibrationError::check_count("predictions of the model's parts", predictions, observations)?;
        let mut indices = parts.iter().flat_map(|part| &part.parameters);
        match indices.find(|&&index| index >= count) {
            None => Ok(parts),
            Some(&index) => {
                let (what, allowed) = ("index of a parameter of a part", "below the number of parameters");
                Err(CalibrationError::invalid(what, index as f64, allowed))
            }
        }
    }

    /// Refuses too few observations: priors count as one; noise to be estimated needs one more, and at least
    /// two of the data.
    pub fn check(&self) -> Result<(), CalibrationError> {
        let (observations, parameters) = (self.observations.len(), self.parameters.len());
        let unknown = parameters - self.priors();
        let needed = if self.knows_noise {
            unknown.max(1)
        } else {
            (unknown + 1).max(2)
        };
        if parameters > 0 && observations >= needed {
            return Ok(());
        }
        let allowed = format!(
            "{needed} or more to determine {parameters} parameters: one more than parameters without prior knowledge \
             if the noise is to be estimated as well"
        );
        Err(CalibrationError::invalid(
            "number of observations",
            observations as f64,
            allowed,
        ))
    }
}
