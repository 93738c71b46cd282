//! What readers read, on the terminal, on the page and in a workbook: the one place that knows digits, units of a reader, times, tables
//! and sentences.

mod answer;
pub mod measures;
mod number;
mod reader;
mod scene;
mod table;

pub use answer::{Answer, Fact};
pub use number::{count, range, round_below, significant};
pub use reader::Reader;
pub use scene::{held_by, middle};
pub use table::{Table, after_pass, candidates, error_parts, over_day, solved};
