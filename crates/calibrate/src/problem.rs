//! What is given: a model, its parameters, and the observations that they are fitted to.

use std::sync::Arc;

use crate::{CalibrationError, Emulator, Model, Options, Parameter, Part};

/// Least noise of the model itself, as a share of its predictions: what an emulator resolves.
const RESOLUTION: f64 = 1e-7;

/// A model to be fitted to observations.
#[derive(Clone)]
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
    pub coarse: Option<Arc<Emulator>>,
}

impl<'a> Problem<'a> {
    /// Parameters of `model` to be fitted to `observations`, whose noise is the same for all.
    pub fn new(
        model: &'a dyn Model,
        parameters: Vec<Parameter>,
        observations: Vec<f64>,
    ) -> Result<Self, CalibrationError> {
        for (index, parameter) in parameters.iter().enumerate() {
            let name = parameter.name().to_owned();
            if parameters[..index].iter().any(|other| other.name() == name) {
                return Err(CalibrationError::DuplicateParameter { name });
            }
            let entries = parameter.column().map_or(observations.len(), <[f64]>::len);
            check_count(
                &format!("entries in the column of {name}"),
                entries,
                observations.len(),
            )?;
        }
        check_each(&observations, "value", "finite", |_| true)?;
        Ok(Self {
            model,
            asked: parameters.len(),
            parameters,
            sigmas: vec![1.0; observations.len()],
            observations,
            knows_noise: false,
            options: Options::default(),
            coarse: None,
        })
    }

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

    /// What acts on which predictions: by default every parameter of the model on all.
    pub fn parts(&self) -> Result<Vec<Part>, CalibrationError> {
        let (observations, count) = (self.observations.len(), self.of_model().len());
        let mut parts = self.model.parts();
        if parts.is_empty() {
            parts.push(Part {
                predictions: observations,
                parameters: (0..count).collect(),
            });
        }
        let predictions = parts.iter().map(|part| part.predictions).sum();
        check_count("predictions of the model's parts", predictions, observations)?;
        let mut indices = parts.iter().flat_map(|part| &part.parameters);
        if let Some(&index) = indices.find(|&&index| index >= count) {
            let (what, allowed) = ("index of a parameter of a part", "below the number of parameters");
            return Err(CalibrationError::invalid(what, index as f64, allowed));
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
        Ok(())
    }
}

/// Refuses another number of things than of observations.
pub fn check_count(what: &str, found: usize, wanted: usize) -> Result<(), CalibrationError> {
    if found == wanted {
        return Ok(());
    }
    let what = format!("number of {what}");
    Err(CalibrationError::invalid(
        what,
        found as f64,
        "one for each observation",
    ))
}

/// Refuses a value for an observation that does not hold.
pub fn check_each(
    values: &[f64],
    quantity: &str,
    allowed: &'static str,
    holds: impl Fn(f64) -> bool,
) -> Result<(), CalibrationError> {
    let Some(index) = values
        .iter()
        .position(|&value| !(value.is_finite() && holds(value)))
    else {
        return Ok(());
    };
    let what = format!("{quantity} of observation {index}");
    Err(CalibrationError::invalid(what, values[index], allowed))
}
