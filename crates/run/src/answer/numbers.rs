//! The numbers of a run, by their fields: the computation has failed where one of them is none.

use super::along_cable::{ForceProfile, FrictionProfile, SlipRecord, Stage};
use super::error_estimate::{ErrorEstimate, ErrorShares};
use super::heat::{DayExtremes, DayPoint, HeatRecord, RestraintRange};
use super::record::{
    DuctMotionSummary, ExtremePass, ForceRange, PassRecord, PlanSummary, Quantiles, RandomSpread,
    RestraintRecord, Run, Saturation,
};
use creepage_plan::finite;

finite::numbers! {
    Run: plan duct_motion passes saturation range random extremes days heat force_profile restraints stages slip_lengths error_estimate;
    PlanSummary: node_spacing_m vehicle_step_m;
    DuctMotionSummary: peak_longitudinal_m peak_vertical_m;
    PassRecord: years downstream_force_n downstream_peak_n upstream_force_n upstream_peak_n max_compression_n upstream_displacement_m
        downstream_displacement_m dissipated_energy_j downstream_least_n upstream_least_n;
    Stage: force_profile friction;
    FrictionProfile: vehicle_position_m positions_m friction_n_per_m slip_lengths;
    ExtremePass: after restraints_n restraint_peaks_n;
    RestraintRecord: position_m stiffness_n_per_m force_n after_passes_n during_passes_n slipped_after_passes_m slipped_m;
    SlipRecord: forward_m backward_m;
    Saturation: force_n downstream_force_n upstream_force_n;
    ForceRange: downstream_min_n downstream_max_n upstream_min_n upstream_max_n;
    RandomSpread: downstream upstream;
    Quantiles: q05_n q50_n q95_n max_n;
    ErrorEstimate: relative parts;
    ErrorShares: mesh ground inertia road passes temperature law movement;
    ForceProfile: positions_m force_n;
    DayExtremes: downstream_max_n downstream_min_n upstream_max_n upstream_min_n max_compression_n max_tension_n upstream_displacement_max_m
        upstream_displacement_min_m downstream_displacement_max_m downstream_displacement_min_m restraints;
    RestraintRange: max_n min_n;
    DayPoint: hour warming_k upstream_force_n downstream_force_n upstream_displacement_m downstream_displacement_m;
    HeatRecord: all_days drift_per_day_m drift_per_year_m cycle hot_profile cold_profile;
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use serde_json::Value;

    use creepage_plan::Error;
    use creepage_plan::finite::{Numbers, check};
    use creepage_scene::SceneFile;

    /// The names of the fields that hold numbers with a point, in a JSON document.
    fn names<'v>(value: &'v Value, field: &'v str, found: &mut BTreeSet<&'v str>) {
        match value {
            Value::Number(number) if number.is_f64() => {
                found.insert(field);
            }
            Value::Array(list) => list.iter().for_each(|part| names(part, field, found)),
            Value::Object(map) => map.iter().for_each(|(key, part)| names(part, key, found)),
            _ => {}
        }
    }

    /// Runs with everything that a run may have: what JSON shows is checked, and one number that is
    /// none is an error.
    #[test]
    fn every_number_of_a_run_is_checked() {
        let heated =
            "traffic.passes=20 traffic.per_day=4 heat.expansion=17e-6 heat.daily_swing=20 heat.offset=0";
        let several = "traffic.passes=30 traffic.order=\"random\" traffic.seed=1 traffic.per_day=10";
        for more in [heated, several] {
            let file = SceneFile::read("../../examples/scenes/full-scale-upper.toml").expect("an example");
            let mut changes: Vec<&str> = more.split(' ').collect();
            changes.extend([
                "solver.tolerance=0.2",
                "restraints=[{ position = 10, stiffness = 1e6, holds = 50 }]",
            ]);
            let scene = file.with(&changes).expect("a scene").scene().expect("a scene");
            let options = crate::RunOptions {
                stages: &[1],
                ..crate::RunOptions::default()
            };
            let run = crate::run_with(&scene, &options).expect("a run");
            check(&run).expect("finite");
            let document = serde_json::to_value(&run).expect("JSON");
            let mut expected = BTreeSet::new();
            names(&document, "", &mut expected);
            let mut seen = BTreeSet::new();
            run.each("", &mut |field, _| {
                seen.insert(field);
            });
            assert_eq!(expected, seen);

            for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                let mut wrong = run.clone();
                wrong.passes[0].upstream_force_n = bad;
                let Err(Error::NotFinite { field, value }) = check(&wrong) else {
                    panic!("{bad} is not found");
                };
                assert_eq!(
                    (field.as_str(), value.to_bits()),
                    ("upstream_force_n", bad.to_bits())
                );
                let mut wrong = run.clone();
                wrong.force_profile.force_n[3] = bad;
                assert!(matches!(check(&wrong), Err(Error::NotFinite { .. })));
            }
        }
    }
}
