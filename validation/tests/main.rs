//! What docs/charts.md concludes holds: the tables behind it, coarse grids of its maps, few of its random scenes.

mod calibration_coverage;
mod charts;
mod honest;
mod occurrence;
mod ordinary_scenes;
mod stability_cable;
mod stability_calibration;
mod stability_ground;
mod whole_range;
