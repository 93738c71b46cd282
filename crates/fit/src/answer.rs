//! From the final fit to what the user reads.

use cable_dem::Mesh;
use calibrate::{Estimate, Fit, Loss};

use crate::diagnosis::{LEFT_OUT, diagnose};
use crate::ground;
use crate::instrument::each_once;
use crate::meshes::Final;
use crate::model::{MeshOf, SeriesModel};
use crate::parameters::Fitted;
use crate::problem::Problem;
use crate::readings::{Measured, Reading};
use crate::result::{
    Calibrated, FitMethod, FittedParameter, FittedReading, ModelErrorEstimate, ProfilePoint, ResidualSize,
};
use creepage_plan::finite;
use creepage_run::Error;
use creepage_scene::four_digits;

/// Shift of a parameter by the mesh, in standard errors, which an interval does not hide.
const MESH_SHIFT: f64 = 0.8;

pub fn answer(problem: &Problem<'_>, found: &Final, mistakes: Vec<String>) -> Result<Calibrated, Error> {
    let (fit, models) = (&found.fit, problem.models);
    let readings = readings(problem, found);
    let r_squared = explained(&readings);
    let (lack_of_fit, mut warnings) = diagnose(problem, found, mistakes, r_squared)?;
    warnings.extend(fit.warnings.iter().map(ToString::to_string));
    let model_error = model_error(found);
    for (Estimate { name, .. }, error) in fit.estimates.iter().zip(&model_error.standard_errors) {
        if *error > MESH_SHIFT {
            let words = "standard errors: its interval is too narrow";
            warnings.push(format!("the mesh may move {name} by {error:.1} {words}"));
        }
    }
    warnings.extend(models.iter().flat_map(|model| &model.readings.notes).cloned());
    let parameters = fit.estimates.iter().zip(problem.fitted);
    let parameter = |(estimate, fitted): (&Estimate, _)| parameter(estimate, fitted, lack_of_fit.suspicious);
    let residuals = residuals(&readings);
    let forces = residuals.iter().find(|size| size.unit == "N");
    // Where readings have their own sigmas, there is no single noise.
    let own_sigmas = problem.rows.iter().all(|row| row.sigma.is_some());
    let answer = Calibrated {
        titles: models.iter().map(|model| model.scene.title.clone()).collect(),
        parameters: parameters.map(parameter).collect(),
        correlation: fit.correlation.clone(),
        residual_rms_n: forces.map_or(0.0, |forces| forces.rms),
        residuals,
        r_squared,
        evaluations: found.evaluations,
        warnings,
        lack_of_fit,
        assumptions: ground::assumption(problem, found)?.into_iter().collect(),
        noise_n: (!own_sigmas).then_some(fit.noise),
        degrees_of_freedom: fit.degrees_of_freedom,
        method: method(problem, fit)?,
        model_error,
        fit: readings,
    };
    finite::check(&answer)?;
    Ok(answer)
}

/// Half the difference to a mesh twice as fine.
fn model_error(found: &Final) -> ModelErrorEstimate {
    let most = |forces: &[f64]| forces.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
    let (error, largest) = (0.5 * most(&found.difference), most(&found.fit.fitted));
    ModelErrorEstimate {
        relative: if largest > 0.0 { error / largest } else { 0.0 },
        standard_errors: found.shift.iter().map(|shift| 0.5 * shift.abs()).collect(),
    }
}

fn parameter(estimate: &Estimate, fitted: &Fitted, suspicious: bool) -> FittedParameter {
    let profile = estimate.profile.iter();
    FittedParameter {
        name: estimate.name.clone(),
        unit: fitted.unknown.quantity.unit(),
        value: estimate.value,
        standard_error: estimate.standard_error,
        interval_95: [estimate.interval.lower, estimate.interval.upper],
        identifiable: estimate.identifiable && !suspicious,
        profile: profile
            .map(|&(value, rise)| ProfilePoint { value, rise })
            .collect(),
    }
}

fn method(problem: &Problem<'_>, fit: &Fit) -> Result<FitMethod, Error> {
    let (models, options) = (problem.models, problem.options);
    let mesh = |model: &SeriesModel<'_>| model.levels.mesh(model.level(MeshOf::Answer));
    let meshes = models.iter().map(mesh).collect::<Result<Vec<_>, _>>()?;
    let places = models.iter().map(|model| model.rows[0].measured.place());
    let freedom = four_digits(fit.degrees_of_freedom);
    let noise = if fit.noise_estimated {
        format!(", Student's t with {freedom} degrees of freedom")
    } else {
        " with the given sigmas".into()
    };
    let error = options.discrepancy.map_or_else(String::new, |share| {
        let percent = four_digits(100.0 * share);
        format!(", besides a smooth error of the model of {percent} % of the largest reading")
    });
    Ok(FitMethod {
        cable: models[0].method().to_string(),
        load_cell: places.collect(),
        node_spacing_m: meshes.iter().map(Mesh::spacing).collect(),
        vehicle_step_m: meshes.iter().map(Mesh::vehicle_step).collect(),
        loss: match options.loss {
            Loss::Squares => "squares",
            _ => "tukey",
        },
        intervals: format!("profile likelihood{noise}{error}"),
    })
}

fn readings(problem: &Problem<'_>, found: &Final) -> Vec<FittedReading> {
    let fit = &found.fit;
    let fitted = |(k, reading): (usize, &Reading)| {
        let measured = reading.measured;
        let force = |value: f64| matches!(measured, Measured::Force(_)).then_some(value);
        let (fitted, residual) = (fit.fitted[k] + found.difference[k], fit.residuals[k]);
        FittedReading {
            series: reading.series + 1,
            pass: reading.pass,
            force_n: force(reading.value),
            fitted_n: force(fitted),
            residual_n: force(residual),
            weight: fit.weights[k],
            run: problem.models[reading.series].readings.runs[reading.run].clone(),
            line: reading.line,
            measured: measured.name(),
            at: measured.place(),
            value: reading.value,
            fitted,
            residual,
            unit: measured.unit(),
        }
    };
    problem.rows.iter().enumerate().map(fitted).collect()
}

/// The share of the variance of the readings that are kept which the model explains; `None` if
/// they do not vary.
fn explained(readings: &[FittedReading]) -> Option<f64> {
    let kept = || readings.iter().filter(|reading| reading.weight >= LEFT_OUT);
    let mean = kept().map(|reading| reading.value).sum::<f64>() / kept().count().max(1) as f64;
    let variation: f64 = kept().map(|reading| (reading.value - mean).powi(2)).sum();
    let left: f64 = kept().map(|reading| reading.residual.powi(2)).sum();
    (variation > 0.0).then(|| 1.0 - left / variation)
}

/// By kind of reading, in the order of the file.
fn residuals(readings: &[FittedReading]) -> Vec<ResidualSize> {
    let size = |(measured, unit)| {
        let all = readings.iter().filter(|reading| reading.measured == measured);
        let (kept, left): (Vec<_>, Vec<_>) = all.partition(|reading| reading.weight >= LEFT_OUT);
        let squares: f64 = kept
            .iter()
            .map(|reading| reading.residual * reading.residual)
            .sum();
        ResidualSize {
            measured,
            rms: (squares / kept.len().max(1) as f64).sqrt(),
            unit,
            readings: kept.len(),
            left_out: left.len(),
        }
    };
    let kinds = readings.iter().map(|reading| (reading.measured, reading.unit));
    each_once(kinds).into_iter().map(size).collect()
}
