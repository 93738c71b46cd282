//! What crosses the crates of the workspace: the paper's numbers, ground models against each other, the command line and its files.
//!
//! One program, since each one that is linked costs as much time as its tests. Programs of their own are what other pages name or
//! what takes minutes.

mod answers;
mod calibrate_command;
mod calibration;
mod cli;
mod command;
mod design;
mod discrepancy;
mod example_scenes;
mod explore;
mod faulty_cells;
mod files;
mod fuzz;
mod generated_pages;
mod ground_models;
mod ground_once;
mod heat;
mod house;
mod lanes;
mod measures;
mod messages;
mod methods;
mod occurrence;
mod pages;
mod paper;
mod planner;
mod progress;
mod reading_shapes;
mod readings;
mod report;
mod route;
mod scene;
mod scenes;
mod seldom;
mod several_kinds;
mod slope;
mod studies;
mod sweep;
mod sweep_rows;
mod threads;
mod workbook;
#[path = "../crates/figure/tests/xml/mod.rs"]
mod xml;
