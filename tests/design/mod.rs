//! Springs and clamps that keep limits, one or two at once, with heat and slopes: each answer against runs that know nothing of the search.

mod clamps;
mod days;
mod grid;
mod one_spring;
mod pairs;
