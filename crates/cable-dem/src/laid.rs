//! The cable as laid.

use crate::lumped::{Lumped, WholeStep};
use crate::step::{Chain, Stretch, Support};
use crate::tridiagonal::{self, Row};
use crate::{CableError, CableState, DuctedCable, FrictionLaw, Mesh, Statistics};

/// Mass per metre \[kg/m\] where nothing moves: any.
const MASS: f64 = 1.0;

/// `cable` on `mesh` as laid: in a level duct without displacement or friction, under a body force p at rest after one step from there,
///
/// K u = w (f + p),
///
/// with the ground at rest and friction f by its law. Where |p| < q friction alone holds the cable; where |p| > q it has slid against
/// what holds it.
///
/// ```
/// use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh, laid};
///
/// // A duct that rises by 30 % in a duct where friction takes 25 % of the weight.
/// let friction = Friction::new(FrictionLaw::Coulomb, 26.0)?;
/// let cable = DuctedCable::new(30.0, 8.01e6, friction)?.with_ends(End::Fixed, End::Free)?.with_body_force(-31.3)?;
/// let state = laid(&cable, &Mesh::for_depth(30.0, 1.2, 6.0)?)?;
/// assert!((state.end_forces(&cable)?.upstream - (31.3 - 26.0) * 30.0).abs() < 1e-6);
/// # Ok::<(), cable_dem::CableError>(())
/// ```
///
/// # Errors
///
/// [`CableError::InvalidParameter`] unless the mesh is as long as the cable, [`CableError::NothingHolds`] where |p| ≥ q and no end and
/// no clamp holds the cable, [`CableError::NoConvergence`] where no equilibrium is found.
pub fn laid(cable: &DuctedCable, mesh: &Mesh) -> Result<CableState, CableError> {
    let mut state = CableState::at_rest(mesh);
    let body_force = cable.body_force();
    if body_force == 0.0 {
        return Ok(state);
    }
    mesh.check_length(cable.length())?;
    let (friction, limit) = (cable.friction(), cable.friction().limit());
    let held: f64 = Support::of(cable, mesh)
        .iter()
        .map(|support| support.stiffness.unwrap_or(f64::INFINITY))
        .sum();
    if held == 0.0 && body_force.abs() >= limit {
        return Err(CableError::NothingHolds { body_force, limit });
    }
    if limit == 0.0 {
        state.displacement = without_friction(cable, mesh);
        return Ok(state);
    }
    let lumped = Lumped::new(cable.clone(), *mesh, MASS)?;
    // How far what friction does not hold can stretch the cable and what holds it.
    let sliding = (body_force.abs() - limit).max(0.0) * cable.length();
    let stretch = cable.length() / cable.axial_stiffness();
    let give = if held > 0.0 { 1.0 / held } else { 0.0 };
    let largest = sliding * (stretch + give) + friction.compliance() * limit;
    let still = vec![0.0; mesh.nodes()];
    let solved = WholeStep::new(&lumped).follow(&still, largest, &mut state, &mut Statistics::default());
    solved.map_err(|violation| CableError::NoConvergence {
        vehicle_position: f64::NEG_INFINITY,
        violation,
    })?;
    if friction.law() == FrictionLaw::Coulomb {
        // Between a fixed end and its neighbour nothing slips, and friction holds as everywhere else.
        for node in [0, mesh.elements()] {
            if lumped.holds(node) {
                state.friction[node] = (-body_force).clamp(-limit, limit);
            }
        }
    }
    Ok(state)
}

/// K u = w p, by elimination.
fn without_friction(cable: &DuctedCable, mesh: &Mesh) -> Vec<f64> {
    let chain = Chain::new(cable, mesh);
    let (body, mut u, mut factors) = (
        cable.body_loads(mesh),
        vec![0.0; mesh.nodes()],
        vec![0.0; mesh.nodes()],
    );
    let Stretch { lo, hi } = chain.free;
    let row = |k: usize| {
        let share = 1.0 / chain.nodes[lo + k].diagonal;
        let value = share * body[lo + k] * chain.per_stiffness;
        Row { share, value }
    };
    tridiagonal::solve([0.0, 0.0], row, &mut factors, &mut u[lo..=hi]);
    u
}
