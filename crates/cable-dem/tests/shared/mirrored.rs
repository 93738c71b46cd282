//! A cable seen in a mirror.

use cable_dem::{CableError, DuctedCable, Section};

/// `cable` seen in a mirror across the duct's middle.
pub fn mirrored(cable: &DuctedCable) -> Result<DuctedCable, CableError> {
    let mut clamps = cable.restraints().to_vec();
    for clamp in &mut clamps {
        clamp.position = cable.length() - clamp.position;
    }
    let turned = |section: &Section| section.with_body_force(-section.body_force);
    let sections: Vec<Section> = cable.sections().iter().rev().map(turned).collect();
    let [upstream, downstream] = cable.end_positions();
    DuctedCable::new(cable.length(), cable.axial_stiffness(), cable.friction())?
        .with_ends(cable.downstream(), cable.upstream())?
        .with_end_positions([-downstream, -upstream])?
        .with_restraints(clamps)?
        .with_sections(&sections)
}
