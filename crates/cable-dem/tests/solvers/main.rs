//! Every solver on every test model, through one harness; and the laws of nature that all of them must keep.
//!
//! [`models`] holds problems with their exact answers, [`harness`] runs any solver on any problem.

mod agreement;
mod friction_symmetry;
mod harness;
#[path = "../shared/mirrored.rs"]
mod mirrored;
mod models;
mod opposing_traffic;
mod rate;
mod restart;
mod slope;
mod stiff_ends;
mod test_models;
