//! Progress bars on a terminal.

use std::io::{self, IsTerminal};
use std::ops::ControlFlow;
use std::sync::Once;

use indicatif::{ProgressBar, ProgressStyle};

use crate::Progress;

/// A bar with the percentage done.
pub const PERCENT: &str = "{bar:40} {percent} %, {eta} left";
/// A bar that counts the points of a sweep.
pub const POINTS: &str = "{bar:40} {pos}/{len} points, {eta} left";
/// A count of model runs; how many are needed is not known before.
pub const MODEL_RUNS: &str = "{spinner} {pos} model runs";
/// Steps of a bar of percentages.
pub const PER_MILLE: usize = 1000;

/// Computes something with a bar of `length` steps that looks like `template`, on a terminal only.
pub fn with_bar<T>(template: &str, length: usize, compute: impl FnOnce(Progress<'_>) -> T) -> T {
    if !io::stderr().is_terminal() {
        return compute(Progress::default());
    }
    let bar = ProgressBar::new(length as u64);
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    let begun = Once::new();
    let show = |share: f64| {
        bar.set_position((share * length as f64).round() as u64);
        // What an earlier run had done took no time of this one.
        begun.call_once(|| bar.reset_eta());
        ControlFlow::Continue(())
    };
    let answer = compute(Progress::new(&show));
    bar.finish_and_clear();
    answer
}
