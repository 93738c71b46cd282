//! Fits parameters of a creepage model to load-cell data.
