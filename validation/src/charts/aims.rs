//! Table of aims: what each kind of answer is meant to cost, what it costs, and how far that is from the least it could cost.
//!
//! *Least.* The nodes that a run eliminates, each at the price of a node in a bare tridiagonal solve (Thomas) of a system in the cache: no
//! motion of the duct, no contact states, no corrections, no records. The price is measured together with the runs.

use std::fmt::Write as _;
use std::hint::black_box;
use std::path::Path;

use testkit::tridiagonal;

use super::cost::pool;
use crate::Failure;
use crate::computations::{Aim, aims};
use crate::stopwatch::timed;

/// Unknowns of the bare solve: a window of the cable.
const NODES: usize = 256;
const SOLVES: usize = 1000;
/// The least of so many times counts: other work on the machine only adds to it.
const REPEATED: usize = 3;

pub fn run(out: &Path) -> Result<(), Failure> {
    let price = bare_solve()?;
    println!("a node in a bare solve: {:.2} ns", 1e9 * price);
    let mut table = String::from("computation,aim_s,seconds,node_updates,least_s\n");
    let one = pool(1)?;
    for Aim {
        name,
        seconds: aim,
        of,
        work,
    } in aims()?
    {
        let (mut updates, mut seconds) = (None, f64::INFINITY);
        for _ in 0..REPEATED {
            let (counted, taken) = timed(|| one.install(&work))?;
            (updates, seconds) = (counted, seconds.min(taken));
        }
        let each = seconds / of as f64;
        let updates = updates.map(|updates| updates as f64 / of as f64);
        let counted = updates.map_or(String::new(), |updates| format!("{updates:.0}"));
        let least = updates.map_or(String::new(), |updates| format!("{:.3e}", price * updates));
        println!("{name}: {each:.4} s, meant {aim} s, least {least}");
        writeln!(table, "{name},{aim},{each:.3e},{counted},{least}")?;
    }
    crate::table::write(&out.join("aims.csv"), &table)?;
    Ok(())
}

/// Time per unknown of solving r_i − a (r_{i−1} + r_{i+1}) = b \[s\], in a crate that is fully optimised.
fn bare_solve() -> Result<f64, Failure> {
    let (mut factor, mut value) = ([0.0; NODES], [0.0; NODES]);
    let solves = || -> Result<(), Failure> {
        for _ in 0..SOLVES {
            tridiagonal::solve(black_box(0.499), black_box(1.0), &mut factor, &mut value);
            black_box(&value);
        }
        Ok(())
    };
    Ok(timed(solves)?.1 / (NODES * SOLVES) as f64)
}
