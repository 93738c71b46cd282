//! A reading.

/// A reading of the load cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reading {
    /// Number of the pass after which it was taken, from 1.
    pub pass: u64,
    /// Force \[N\], compression positive.
    pub force: f64,
    /// Its standard deviation \[N\], where the file gives it.
    pub sigma: Option<f64>,
    /// Line of the file, from 1.
    pub line: u64,
}
