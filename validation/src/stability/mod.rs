//! Where methods fail, mapped. Each map is a file here: a grid of runs coloured by outcome.

pub mod bends;
pub mod burmister;
pub mod calibration;
pub mod explicit;
pub mod fem;
pub mod heat;
pub mod implicit;
pub mod long_term;
pub mod sections;
pub mod sigmoid;
