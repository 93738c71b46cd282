//! Chains whose answer is known in closed form, and what is refused.

use friction_chain::{Chain, ChainError, Clamp, ImplicitStep, Load};

/// EA \[N\], h \[m\] and q \[N/m\] of all chains here, and what friction bears on all of it \[N\].
const STIFFNESS: f64 = 8e6;
const SPACING: f64 = 0.25;
const LIMIT: f64 = 20.0;
const NODES: usize = 81;
const BORNE: f64 = LIMIT * SPACING * (NODES - 1) as f64;

fn chain(compliance: f64, ends: [Option<f64>; 2], clamps: Vec<Clamp>) -> Result<Chain, ChainError> {
    Chain::new(STIFFNESS, SPACING, compliance, &[LIMIT; NODES], ends, clamps)
}

/// A chain that was at rest, when `pull` \[N\] has come to its first node.
fn pulled(chain: Chain, pull: f64) -> Result<ImplicitStep, ChainError> {
    let mut step = ImplicitStep::new(chain);
    step.begin(&[0.0; NODES], 1e-3);
    loop {
        let mut support = [0.0; NODES];
        support[0] = pull;
        step.chain.add_clamp_loads(&mut support, |_| 0.0);
        let load = Load {
            adhesion: &[0.0; NODES],
            support: &support,
            anchor: &[0.0; NODES],
        };
        let free = step.chain.free();
        step.solve(&load, free)?;
        let ImplicitStep { chain, trial, .. } = &mut step;
        if !chain.correct_clamps(free, |i| trial.r[i]) {
            chain.settle_clamps(free, |i| trial.r[i], &mut 0.0);
            return Ok(step);
        }
    }
}

#[track_caller]
fn near(found: f64, expected: f64) {
    assert!(
        (found / expected - 1.0).abs() < 1e-6,
        "{found:e}, not {expected:e}"
    );
}

#[test]
fn a_pulled_end_moves_by_the_square_of_the_pull_and_back_by_half_of_it() -> Result<(), ChainError> {
    let pull = 0.5 * BORNE;
    let mut step = pulled(chain(0.0, [Some(0.0); 2], Vec::new())?, pull)?;
    let moved = pull * pull / (2.0 * LIMIT * STIFFNESS);
    near(step.trial.r[0], moved);
    assert!(step.trial.g.iter().all(|g| g.abs() <= LIMIT));
    // Let go, it comes back by half (Masing's rule).
    let before = step.trial.r.clone();
    step.begin(&before, 0.0);
    let load = Load {
        adhesion: &[0.0; NODES],
        support: &[0.0; NODES],
        anchor: &before,
    };
    step.solve(&load, step.chain.free())?;
    near(step.trial.r[0], 0.5 * moved);
    Ok(())
}

#[test]
fn a_sheath_that_sticks_fades_by_its_screening_length() -> Result<(), ChainError> {
    // λ = √(EA γ) of two spacings, and nothing slips: (1 + 2 s) r = s (both neighbours), s = (λ/h)².
    let compliance = (2.0 * SPACING).powi(2) / STIFFNESS;
    let step = pulled(chain(compliance, [Some(0.0), None], Vec::new())?, 1e-3)?;
    let half = 0.5 / 4.0_f64;
    let ratio = 1.0 + half - (half * (half + 2.0)).sqrt();
    for i in 0..20 {
        near(step.trial.r[i + 1] / step.trial.r[i], ratio);
    }
    Ok(())
}

#[test]
fn a_clamp_bears_what_friction_leaves_until_it_slips() -> Result<(), ChainError> {
    let (last, spring, holds) = (NODES - 1, 2e5, 50.0);
    let ends = [Some(0.0), Some(spring)];
    // Both springs share what friction leaves; beyond the holding force the end takes the rest.
    let clamp = Clamp::new(last, spring, holds);
    let step = pulled(chain(0.0, ends, vec![clamp])?, BORNE + 80.0)?;
    near(step.trial.r[last], 40.0 / spring);
    assert_eq!(step.chain.clamps()[0].slip, 0.0);
    let step = pulled(chain(0.0, ends, vec![clamp])?, BORNE + 300.0)?;
    near(step.trial.r[last], 250.0 / spring);
    near(step.chain.clamps()[0].slip, 200.0 / spring);
    Ok(())
}

#[test]
fn what_nothing_holds_is_an_error() -> Result<(), ChainError> {
    let free = chain(0.0, [Some(0.0); 2], Vec::new())?;
    assert!(!free.is_held());
    assert!(pulled(free.clone(), 0.99 * BORNE).is_ok());
    for pull in [1.01 * BORNE, f64::NAN, f64::INFINITY] {
        let failed = pulled(free.clone(), pull);
        assert!(matches!(failed, Err(ChainError::NoEquilibrium { .. })), "{pull}");
    }
    Ok(())
}

#[test]
fn a_chain_that_cannot_be_is_refused() {
    let (free, limits) = ([Some(0.0); 2], [LIMIT; 3]);
    for bad in [f64::NAN, -1.0, 0.0] {
        assert!(Chain::new(bad, SPACING, 0.0, &limits, free, Vec::new()).is_err());
        assert!(Chain::new(STIFFNESS, bad, 0.0, &limits, free, Vec::new()).is_err());
    }
    for bad in [f64::NAN, -1.0] {
        assert!(Chain::new(STIFFNESS, SPACING, bad, &limits, free, Vec::new()).is_err());
        assert!(Chain::new(STIFFNESS, SPACING, 0.0, &[LIMIT, bad], free, Vec::new()).is_err());
        assert!(chain(0.0, [Some(0.0), Some(bad)], Vec::new()).is_err());
        assert!(chain(0.0, free, vec![Clamp::new(0, bad, 1.0)]).is_err());
        assert!(chain(0.0, free, vec![Clamp::new(0, 1.0, bad)]).is_err());
    }
    assert!(chain(0.0, free, vec![Clamp::new(NODES, 1.0, 1.0)]).is_err());
    assert!(Chain::new(STIFFNESS, SPACING, 0.0, &[LIMIT], free, Vec::new()).is_err());
    let message = Chain::new(STIFFNESS, SPACING, 0.0, &[LIMIT; 2], [None; 2], Vec::new()).unwrap_err();
    assert_eq!(
        message.to_string(),
        "nodes = 2.0: must be two or more, and one of them free"
    );
}
