//! Two springs at once, clamps and their limits, heat and slopes: each answer against a grid of runs that know nothing of the search.

mod clamps;
mod days;
mod grid;
mod pairs;
