//! What crosses the crates of the workspace: the paper's numbers, ground models against each other, the command line and its files.
//!
//! One program, since each one that is linked costs as much time as its tests. Programs of their own are what other pages name or
//! what takes minutes.

#[path = "answers/main.rs"]
mod answers;
#[path = "calibrate_command.rs"]
mod calibrate_command;
#[path = "calibration.rs"]
mod calibration;
#[path = "cli.rs"]
mod cli;
#[path = "command.rs"]
mod command;
#[path = "design/main.rs"]
mod design;
#[path = "discrepancy.rs"]
mod discrepancy;
#[path = "example_scenes.rs"]
mod example_scenes;
#[path = "explore/main.rs"]
mod explore;
#[path = "faulty_cells.rs"]
mod faulty_cells;
#[path = "files/main.rs"]
mod files;
#[path = "fuzz/main.rs"]
mod fuzz;
#[path = "generated_pages.rs"]
mod generated_pages;
#[path = "ground_models/main.rs"]
mod ground_models;
#[path = "ground_once.rs"]
mod ground_once;
#[path = "heat.rs"]
mod heat;
#[path = "house.rs"]
mod house;
#[path = "lanes.rs"]
mod lanes;
#[path = "measures.rs"]
mod measures;
#[path = "messages.rs"]
mod messages;
#[path = "methods.rs"]
mod methods;
#[path = "occurrence.rs"]
mod occurrence;
#[path = "pages.rs"]
mod pages;
#[path = "paper/main.rs"]
mod paper;
#[path = "planner/main.rs"]
mod planner;
#[path = "reading_shapes.rs"]
mod reading_shapes;
#[path = "readings.rs"]
mod readings;
#[path = "report.rs"]
mod report;
#[path = "route.rs"]
mod route;
#[path = "scene/main.rs"]
mod scene;
#[path = "seldom/main.rs"]
mod seldom;
#[path = "several_kinds.rs"]
mod several_kinds;
#[path = "slope.rs"]
mod slope;
#[path = "studies.rs"]
mod studies;
#[path = "sweep.rs"]
mod sweep;
#[path = "sweep_rows.rs"]
mod sweep_rows;
#[path = "threads.rs"]
mod threads;
#[path = "workbook.rs"]
mod workbook;
#[path = "../crates/figure/tests/xml/mod.rs"]
mod xml;
