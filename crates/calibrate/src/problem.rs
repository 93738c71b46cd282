//! What is given: model, parameters, observations and options.

use std::sync::Arc;

use crate::{CalibrationError, Discrepancy, Emulator, Loss, Model, Options, Parameter, Part};

/// Least noise of the model itself, as a share of its predictions: what an emulator resolves.
const RESOLUTION: f64 = 1e-7;

#[derive(Clone)]
pub(crate) struct Problem<'a> {
    pub model: &'a dyn Model,
    pub parameters: Vec<Parameter>,
    pub observations: Vec<f64>,
    /// 1 where the noise is to be estimated.
    pub sigmas: Vec<f64>,
    pub knows_noise: bool,
    pub options: Options,
    pub discrepancy: Option<Discrepancy>,
    pub coarse: Option<Arc<Emulator>>,
}

impl Problem<'_> {
    /// Indices of the parameters that the model takes.
    pub fn of_model(&self) -> Vec<usize> {
        let of_model = |&k: &usize| self.parameters[k].column().is_none();
        (0..self.parameters.len()).filter(of_model).collect()
    }

    /// Those of the model.
    pub fn model_parameters(&self) -> Vec<Parameter> {
        let own = self.of_model().into_iter().map(|k| self.parameters[k].clone());
        own.collect()
    }

    /// Number of parameters with prior knowledge.
    pub fn priors(&self) -> usize {
        self.parameters.iter().filter(|p| p.prior().is_some()).count()
    }

    /// Noise of the predictions as a share of them.
    pub fn relative_noise(&self) -> f64 {
        self.options.relative_noise.max(RESOLUTION)
    }

    /// Noise that the model's predictions have at least, in units of the sigmas.
    pub fn least_noise(&self) -> f64 {
        let share = self.relative_noise();
        let sizes = self.observations.iter().zip(&self.sigmas);
        let noise = sizes.map(|(value, sigma)| share * value.abs() / sigma);
        noise.fold(f64::MIN_POSITIVE, f64::max)
    }

    /// What acts on which predictions: by default every parameter of the model on all.
    pub fn parts(&self) -> Result<Vec<Part>, CalibrationError> {
        let (observations, parameters) = (self.observations.len(), self.of_model().len());
        let parts = self.model.parts();
        if parts.is_empty() {
            return Ok(vec![Part {
                predictions: observations,
                parameters: (0..parameters).collect(),
            }]);
        }
        let predictions: usize = parts.iter().map(|part| part.predictions).sum();
        if predictions != observations {
            let allowed = "as many as there are observations";
            return Err(CalibrationError::invalid(
                "predictions of the model's parts",
                predictions as f64,
                allowed,
            ));
        }
        let mut indices = parts.iter().flat_map(|part| &part.parameters);
        if let Some(&index) = indices.find(|&&index| index >= parameters) {
            let allowed = "below the number of the model's parameters";
            return Err(CalibrationError::invalid(
                "index of a parameter of the model's parts",
                index as f64,
                allowed,
            ));
        }
        Ok(parts)
    }

    /// Priors count as observations; noise to be estimated needs one more, and at least two of the data.
    pub fn check(&self) -> Result<(), CalibrationError> {
        let (observations, parameters) = (self.observations.len(), self.parameters.len());
        let unknown = parameters - self.priors();
        let needed = if self.knows_noise {
            unknown.max(1)
        } else {
            (unknown + 1).max(2)
        };
        if parameters == 0 || observations < needed {
            return Err(CalibrationError::TooFewObservations {
                observations,
                parameters,
                needed,
            });
        }
        match self.options.loss {
            Loss::Tukey { threshold } if self.discrepancy.is_some() => {
                let allowed = "least squares beside a discrepancy";
                Err(CalibrationError::invalid(
                    "threshold of the loss",
                    threshold,
                    allowed,
                ))
            }
            _ => Ok(()),
        }
    }
}
