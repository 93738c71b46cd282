//! The longest time step of the explicit scheme.

use super::nodes::MovingNodes;
use crate::FrictionLaw;

/// Limits of the explicit scheme's time step for one cable on one mesh.
///
/// With the stiffness row sums Σ_j |K_ij| (Gershgorin) the highest elastic frequency is at most ω_e,
/// ω_e² = max_i Σ_j |K_ij|/m_i, which is 4 EA/(m′h²) without springs. Linearised about stuck contact,
///
/// | law | stuck node | stable while |
/// |---|---|---|
/// | elastic-plastic | ü + (ω_e² + q b/(2m′)) u = 0 | Δt² ω_e²/4 + Δt² q b/(8 m′) < 1 |
/// | sigmoid | ü + (q b Δt/(2m′)) u̇ + ω_e² u = 0, drag lagging by half a step | Δt² ω_e²/4 + Δt² q b/(4 m′) < 1 |
/// | Coulomb | friction found together with the velocity, by projection | Δt² ω_e²/4 < 1 |
///
/// (roots of the central difference's characteristic polynomial at z = −1). Each left side is a sum of two terms: the
/// *elastic limit* Δt_e = 2/ω_e and the *friction limit* Δt_f are the steps that each would allow alone, and together
///
/// 1/Δt² = 1/Δt_e² + 1/Δt_f²,
///
/// a little shorter than the smaller of both. For the sigmoid Δt_f is where Δt·q/(m′ v_b) = 2 with v_b = 2/(b Δt).
///
/// That is stability, not accuracy: stuck nodes that swing on their contact near the friction limit slip in the wrong
/// places (3 % of the force at 0.9 Δt_f and b = 3e9 1/m, where friction returns 0.5 % of its heat), while at half of it the
/// answer no longer depends on the step. A node that swings on an end spring does the same; the waves of the plain chain
/// do no such harm. The advised step is therefore 0.9 of what Δt_e and Δt_f/2 allow together, springs counted four times in
/// Δt_e.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct StepLimits {
    /// Longest stable step of the cable's and its supports' springs alone, Δt_e \[s\].
    pub elastic: f64,
    /// Longest stable step of the friction law's slope alone, Δt_f \[s\]; infinite for Coulomb's law.
    pub friction: f64,
    /// Elastic limit with springs to the ground counted four times, so that the swing of a node on one is resolved.
    resolving_springs: f64,
}

impl StepLimits {
    pub(super) fn new(nodes: &MovingNodes) -> Self {
        let chain = &nodes.chain;
        // Springs to the ground count `weight` times.
        let fastest = |weight: f64| {
            let row = |i: usize| {
                let neighbours = 2.0 * chain.neighbours(i) * chain.stiffness();
                (neighbours + weight * chain.spring(i)) / chain.nodes()[i].tributary
            };
            // A node that is held does not swing.
            let rows = chain.free().nodes().map(row);
            rows.fold(0.0, f64::max) / nodes.mass_per_metre
        };

        let friction = nodes.cable.friction();
        let per_mass = friction.limit() * friction.law().shape_factor() / nodes.mass_per_metre;
        Self {
            elastic: 2.0 / fastest(1.0).sqrt(),
            friction: match friction.law() {
                FrictionLaw::Coulomb => f64::INFINITY,
                FrictionLaw::ElasticPlastic { .. } => (8.0 / per_mass).sqrt(),
                FrictionLaw::Sigmoid { .. } => (4.0 / per_mass).sqrt(),
            },
            resolving_springs: 2.0 / fastest(4.0).sqrt(),
        }
    }

    /// Longest stable step \[s\]: both limits together.
    pub fn together(&self) -> f64 {
        1.0 / (1.0 / self.elastic).hypot(1.0 / self.friction)
    }

    /// The step \[s\] to take: 0.9 of what the elastic limit and half the friction limit allow together, springs to the
    /// ground at half of theirs too.
    pub fn advised(&self) -> f64 {
        0.9 / (1.0 / self.resolving_springs).hypot(2.0 / self.friction)
    }
}
