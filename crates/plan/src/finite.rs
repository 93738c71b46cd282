//! Every number of an answer is finite: checked where the answer is made, so that what comes later
//! need not look.
//!
//! JSON has no word for infinity, and serialises it as the `null` that stands for a missing value;
//! a table would hold the text `inf`.

use crate::error::Error;

/// Makes sure that no number of the answer is infinite or NaN.
///
/// # Errors
///
/// [`Error::NotFinite`] with the first such number and its field.
pub fn check<T: Numbers + ?Sized>(answer: &T) -> Result<(), Error> {
    let mut found = Ok(());
    answer.each("", &mut |field, value| {
        if found.is_ok() && !value.is_finite() {
            let field = field.to_owned();
            found = Err(Error::NotFinite { field, value });
        }
    });
    found
}

/// What holds numbers: shows each with the name of its field.
pub trait Numbers {
    /// Shows all numbers; one that has no field of its own is called `field`.
    fn each(&self, field: &'static str, see: &mut dyn FnMut(&'static str, f64));
}

impl Numbers for f64 {
    fn each(&self, field: &'static str, see: &mut dyn FnMut(&'static str, f64)) {
        see(field, *self);
    }
}

/// Of several parts, those of each.
macro_rules! of_parts {
    ($([$($generics:tt)+] $list:ty;)+) => {
        $(impl<$($generics)+> Numbers for $list {
            fn each(&self, field: &'static str, see: &mut dyn FnMut(&'static str, f64)) {
                for part in self.iter() {
                    part.each(field, see);
                }
            }
        })+
    };
}

of_parts! {
    [T: Numbers] Option<T>;
    [T: Numbers] [T];
    [T: Numbers] Vec<T>;
    [T: Numbers, const N: usize] [T; N];
}

/// The fields of records that are numbers or hold some.
#[doc(hidden)]
#[macro_export]
macro_rules! numbers {
    ($($record:ty: $($field:ident)*;)*) => {
        $(impl $crate::finite::Numbers for $record {
            fn each(&self, _: &'static str, see: &mut dyn FnMut(&'static str, f64)) {
                $($crate::finite::Numbers::each(&self.$field, stringify!($field), see);)*
            }
        })*
    };
}
pub use crate::numbers;
