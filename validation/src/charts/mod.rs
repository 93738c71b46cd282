//! Speed against accuracy, drawn. Each chart is a file here. Accuracy is measured against independent or far finer answers,
//! cost in seconds and in a count that knows no machine.

pub mod aims;
pub mod cable;
pub mod cost;
pub mod discrepancy;
pub mod ground;
pub mod opensees;
pub mod whole;
