//! What a computation costs in processor time, which other programs on the machine disturb less than the clock on the wall.

use std::time::Instant;

/// A batch is repeated until it has taken this long \[s\]; the system counts in hundredths of a second.
const BATCH: f64 = 0.12;
/// The least mean of so many batches counts, or of fewer where they take longer than this altogether \[s\].
const BATCHES: usize = 4;
const PATIENCE: f64 = 1.0;

/// Time \[s\] that this process has taken on all processors together, `None` if the system does not tell.
fn processor_seconds() -> Option<f64> {
    // proc(5): utime and stime, in hundredths of a second, are the 14th and 15th field; the 2nd, in brackets, may hold blanks.
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = text.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |index: usize| fields.get(index)?.parse::<f64>().ok();
    Some((ticks(11)? + ticks(12)?) / 100.0)
}

/// What `work` returns and the time it takes \[s\]: processor time of all threads where the system tells it, else time on the wall.
pub fn timed<T, E>(mut work: impl FnMut() -> Result<T, E>) -> Result<(T, f64), E> {
    let start = Instant::now();
    let now = || processor_seconds().unwrap_or_else(|| start.elapsed().as_secs_f64());
    let begin = now();
    let mut least = f64::INFINITY;
    for batch in 1.. {
        let from = now();
        for run in 1.. {
            let result = work()?;
            let taken = now() - from;
            if taken < BATCH {
                continue;
            }
            least = least.min(taken / f64::from(run));
            if batch >= BATCHES || now() - begin > PATIENCE {
                return Ok((result, least));
            }
            break;
        }
    }
    unreachable!("the last batch returns")
}
