//! Answers for the reader at a terminal.

use std::io::Write;

use super::{Failure, terminal};
use crate::answer::selected;
use crate::occurrence::Occurrence;
use crate::shown::{rounded, share, time};
use crate::{Part, PlanReport, Profile, Run, Scene};

pub fn run(run: &Run) -> Result<(), Failure> {
    let mut out = terminal::out();
    writeln!(out, "{}", terminal::line(&run.title))?;
    writeln!(
        out,
        "duct motion: {:.2} µm along, {:.1} µm down",
        1e6 * run.duct_motion.peak_longitudinal_m,
        1e6 * run.duct_motion.peak_vertical_m
    )?;
    writeln!(out)?;
    writeln!(
        out,
        "{:>9} {:>23} {:>23} {:>12}",
        "", "force after pass, N", "end moved, mm", "largest"
    )?;
    writeln!(
        out,
        "{:>9} {:>11} {:>11} {:>11} {:>11} {:>12}",
        "pass", "upstream", "downstream", "upstream", "downstream", "in cable, N"
    )?;
    for record in selected(&run.passes) {
        writeln!(
            out,
            "{:>9} {:>11} {:>11} {:>11} {:>11} {:>12}",
            record.pass,
            rounded(record.upstream_force_n, 1),
            rounded(record.downstream_force_n, 1),
            rounded(1e3 * record.upstream_displacement_m, 4),
            rounded(1e3 * record.downstream_displacement_m, 4),
            rounded(record.max_compression_n, 1)
        )?;
    }
    writeln!(out)?;
    match &run.saturation {
        Some(saturation) => writeln!(
            out,
            "saturation: {:.1} N, 95 % of it after {} passes",
            saturation.force_n, saturation.passes_to_95_percent
        )?,
        None => writeln!(out, "saturation: not reached within these passes")?,
    }
    for restraint in &run.restraints {
        writeln!(
            out,
            "clamp at {} m: {:.1} N, moved {:.4} mm",
            restraint.position_m,
            restraint.force_n,
            1e3 * restraint.force_n / restraint.stiffness_n_per_m
        )?;
    }
    if let Some(slip) = &run.slip_lengths {
        writeln!(
            out,
            "slipping as the vehicle passes the middle: {:.2} m forward, {:.2} m backward",
            slip.forward_m, slip.backward_m
        )?;
    }
    writeln!(
        out,
        "estimated error: {:.2} % ({})",
        100.0 * run.error_estimate.relative,
        run.error_estimate.method
    )?;
    writeln!(
        out,
        "plan: ground {}, cable {}, node spacing {:.3} m, vehicle step {:.3} m",
        run.plan.ground, run.plan.cable, run.plan.node_spacing_m, run.plan.vehicle_step_m
    )?;
    for reason in &run.plan.reasons {
        writeln!(out, "  {}", terminal::sentence(reason))?;
    }
    Ok(())
}

/// Every candidate, the chosen ones marked.
pub fn plan(plan: &PlanReport) -> Result<(), Failure> {
    let mut out = terminal::out();
    writeln!(out, "{}", terminal::line(&plan.title))?;
    let error = plan.estimated_error.map_or_else(
        || "not known before the run".to_owned(),
        |error| format!("about {:.2} %", 100.0 * error),
    );
    writeln!(
        out,
        "ground {}, cable {}, node spacing {:.3} m, vehicle step {:.3} m; error {error}, time {}",
        plan.ground,
        plan.cable,
        plan.node_spacing_m,
        plan.vehicle_step_m,
        time(plan.estimated_seconds)
    )?;
    if let Some(occurrence) = &plan.occurrence {
        self::occurrence(&mut out, occurrence)?;
    }
    for part in [Part::Ground, Part::Cable, Part::Mesh] {
        let candidates: Vec<_> = plan
            .candidates
            .iter()
            .filter(|candidate| candidate.part == part)
            .collect();
        if candidates.is_empty() {
            continue;
        }
        writeln!(out)?;
        writeln!(out, "{part:<14} {:>10} {:>10}  why, or why not", "error", "time")?;
        for candidate in candidates {
            writeln!(
                out,
                "{} {:<12} {:>10} {:>10}  {}",
                if candidate.chosen { '→' } else { ' ' },
                candidate.name,
                candidate.estimated_error.map_or_else(String::new, share),
                candidate.estimated_seconds.map_or_else(String::new, time),
                terminal::sentence(&candidate.reason)
            )?;
        }
    }
    Ok(())
}

/// A go or no-go before anything is run.
fn occurrence(out: &mut impl Write, occurrence: &Occurrence) -> Result<(), Failure> {
    write!(out, "Q = q z²/(EA max|D_l|) = {:.2}: ", occurrence.q_number)?;
    if occurrence.creeps() {
        write!(
            out,
            "{:.0} % of the friction stays locked in at saturation; at most about {:.0} N in this duct, whatever the friction",
            100.0 * occurrence.locked_share,
            occurrence.ceiling_n
        )?;
    } else {
        write!(out, "nothing creeps")?;
    }
    let rough = if occurrence.rough {
        " (rough: the numbers are those of one concentrated load on a half-space)"
    } else {
        ""
    };
    writeln!(out, "{rough}")?;
    Ok(())
}

pub fn profile(profile: &Profile) -> Result<(), Failure> {
    let mut out = terminal::out();
    writeln!(out, "ground: {}", profile.ground)?;
    writeln!(
        out,
        "{:>10} {:>12} {:>12} {:>14}",
        "ξ, m", "D_l, µm", "D_v, µm", "V_l, µm/s"
    )?;
    for i in 0..profile.positions_m.len() {
        writeln!(
            out,
            "{:>10.3} {:>12.4} {:>12.4} {:>14.3}",
            profile.positions_m[i],
            1e6 * profile.longitudinal_m[i],
            1e6 * profile.vertical_m[i],
            1e6 * profile.longitudinal_velocity_m_per_s[i]
        )?;
    }
    Ok(())
}

pub fn checked(scene: &Scene) -> Result<(), Failure> {
    let mut out = terminal::out();
    writeln!(
        out,
        "{}: valid; {} passes over a duct of {} m at {} m depth",
        terminal::line(&scene.title),
        scene.traffic.passes,
        scene.duct.length,
        scene.duct.depth
    )?;
    Ok(())
}
