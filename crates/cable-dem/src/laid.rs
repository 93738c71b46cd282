//! The cable as laid.

use friction_chain::tridiagonal::Row;

use crate::chain::chain;
use crate::clamps::ClampShares;
use crate::{CableError, CableState, DuctedCable, FrictionLaw, Mesh, RestingCable, Section};

/// `cable` on `mesh` as laid: in a level duct without displacement or friction, under a body force p at rest after one step from there,
///
/// K u = w (f + p),
///
/// with the ground at rest and friction f by its law (the sigmoid's as in [`crate::Explicit`]).
/// Where |p| < q friction alone holds the cable; where |p| > q it has slid against what holds it.
///
/// ```
/// use cable_dem::{DuctedCable, End, Friction, FrictionLaw, Mesh, laid};
///
/// // A duct that rises by 30 %, where friction takes 25 % of the weight.
/// let friction = Friction::new(FrictionLaw::Coulomb, 26.0)?;
/// let cable = DuctedCable::new(30.0, 8.01e6, friction)?.with_ends(End::Fixed, End::Free)?.with_body_force(-31.3)?;
/// let state = laid(&cable, &Mesh::for_depth(30.0, 1.2, 6.0)?)?;
/// assert!((state.end_forces(&cable)?.upstream - (31.3 - 26.0) * 30.0).abs() < 1e-6);
/// # Ok::<(), cable_dem::CableError>(())
/// ```
///
/// # Errors
///
/// [`CableError::InvalidParameter`] unless the mesh is as long as the cable, [`CableError::NothingHolds`] if p over the whole duct is no less than q and no end and
/// no clamp holds the cable, [`CableError::NoConvergence`] if no equilibrium is found.
pub fn laid(cable: &DuctedCable, mesh: &Mesh) -> Result<CableState, CableError> {
    let cable = &cable.clone().with_end_positions([0.0; 2])?;
    let mut state = CableState::at_rest(mesh);
    let (sections, limit) = (cable.sections(), cable.friction().limit());
    if sections.iter().all(|section| section.body_force == 0.0) {
        return Ok(state);
    }
    mesh.check_length(cable.length())?;
    let chain = chain(cable, mesh, ClampShares::new(cable, mesh).stuck(&[]))?;
    let mean = |of: fn(&Section) -> f64| {
        let whole: f64 = sections.iter().map(|section| of(section) * section.length).sum();
        whole / cable.length()
    };
    let (body_force, limit_of_all) = (mean(|section| section.body_force), mean(|section| section.limit));
    if !chain.is_held() && body_force.abs() >= limit_of_all {
        let limit = limit_of_all;
        return Err(CableError::NothingHolds { body_force, limit });
    }
    // Without friction, K u = w p.
    let elastic = if chain.is_held() {
        let load = cable.loads(mesh, 0.0);
        chain.solve(|i| {
            let share = 1.0 / chain.nodes()[i].diagonal;
            let value = share * load[i] * (1.0 / chain.stiffness());
            Row { share, value }
        })
    } else {
        vec![0.0; mesh.nodes()]
    };
    if limit == 0.0 {
        state.displacement = elastic;
        return Ok(state);
    }
    // It moves no farther than what friction does not hold can stretch it, and its sheath shears.
    let unheld = |section: &Section| (1.0 - section.limit / section.body_force.abs()).max(0.0);
    let unheld = sections.iter().map(unheld).fold(0.0, f64::max);
    let farthest = unheld * elastic.iter().fold(0.0, |largest: f64, u| largest.max(u.abs()))
        + cable.friction().compliance() * limit;
    RestingCable::with_memory(cable, mesh)?.follow(&mut state, None, 0.0, farthest)?;
    if cable.friction().law() == FrictionLaw::Coulomb {
        // Between a fixed end and its neighbour nothing slips, and friction holds as everywhere else.
        for node in (0..mesh.nodes()).filter(|node| !chain.free().nodes().contains(node)) {
            let Section {
                body_force, limit, ..
            } = sections[if node == 0 { 0 } else { sections.len() - 1 }];
            state.friction[node] = (-body_force).clamp(-limit, limit);
        }
    }
    Ok(state)
}
