//! The fit on the mesh that the plan takes, and what a finer one says more.

use calibrate::Fit;

use crate::model::MeshOf;
use crate::problem::Problem;
use creepage_run::Error;

pub struct Final {
    pub fit: Fit,
    /// How much more a mesh twice as fine says at the optimum, which was added to what the mesh
    /// predicts, and how many standard errors that moved each parameter.
    pub difference: Vec<f64>,
    pub shift: Vec<f64>,
    /// Model runs, all meshes together.
    pub evaluations: usize,
}

/// Fits with profiles or without: on the coarsest mesh, whose runs cost least, then on that of the
/// plan, then on the same with what a mesh twice as fine says more at the optimum.
pub fn fit(problem: &Problem<'_>, profiles: bool) -> Result<Final, Error> {
    let none = vec![0.0; problem.rows.len()];
    let (mut evaluations, mut coarse) = (1, None);
    if !problem.models.iter().any(|model| model.levels.named) {
        let guess = problem.fit(MeshOf::Guess, &none, profiles, None)?;
        evaluations += guess.evaluations;
        coarse = Some(guess.emulator.of_finer());
    }
    let first = problem.fit(MeshOf::Answer, &none, false, coarse)?;
    let finer = problem.predict(MeshOf::Check, 1.0, &first.values())?;
    let difference: Vec<f64> = finer.iter().zip(&first.fitted).map(|(a, b)| a - b).collect();
    let (shift, _) = first.shift(&difference);
    let fit = problem.fit(MeshOf::Answer, &difference, profiles, Some(first.emulator))?;
    Ok(Final {
        evaluations: evaluations + fit.evaluations,
        fit,
        difference,
        shift,
    })
}
