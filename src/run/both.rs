//! Two meshes at a time.

use crate::Error;

/// Runs two computations side by side where a thread is free; the first error wins.
pub fn both<A: Send, B: Send>(
    first: impl FnOnce() -> Result<A, Error> + Send,
    second: impl FnOnce() -> Result<B, Error> + Send,
) -> Result<(A, B), Error> {
    let (first, second) = rayon::join(first, second);
    Ok((first?, second?))
}
