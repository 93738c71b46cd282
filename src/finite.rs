//! The last guard before an answer is given: every number in it is finite.
//!
//! JSON has no word for infinity, and serialises it as the `null` that stands for a missing value; a table would hold the text `inf`.
//! So a serializer that writes nothing goes through the answer before.

use std::fmt::Display;

use serde::ser::{self, Serialize, Serializer};

use crate::Error;

/// Makes sure that no number of the answer is infinite or NaN.
///
/// # Errors
///
/// [`Error::NotFinite`] with the first such number and where it stands.
pub fn check<T: Serialize + ?Sized>(answer: &T) -> Result<(), Error> {
    let found = answer.serialize(Finite::default());
    found.map_err(|NotFinite { field, value }| Error::NotFinite { field, value })
}

/// A number that is not finite, and the fields around it.
#[derive(Debug, thiserror::Error)]
#[error("{field} is {value}")]
struct NotFinite {
    field: String,
    value: f64,
}

impl NotFinite {
    fn within(mut self, name: &str) -> Self {
        let joined = self.field.is_empty() || self.field.starts_with('[');
        self.field = format!("{name}{}{}", if joined { "" } else { "." }, self.field);
        self
    }
}

impl ser::Error for NotFinite {
    fn custom<T: Display>(message: T) -> Self {
        Self {
            field: message.to_string(),
            value: f64::NAN,
        }
    }
}

type Checked = Result<(), NotFinite>;

/// Looks at numbers, goes through the parts of lists, maps and structures, and passes everything else.
#[derive(Default)]
struct Finite {
    /// How many parts without a name it has gone through.
    count: usize,
}

impl Finite {
    fn part<T: Serialize + ?Sized>(&mut self, name: Option<&str>, part: &T) -> Checked {
        let index = self.count;
        self.count += usize::from(name.is_none());
        part.serialize(Self::default()).map_err(|found| match name {
            Some(name) => found.within(name),
            None => found.within(&format!("[{index}]")),
        })
    }
}

/// Methods that look at none of their arguments.
macro_rules! answers {
    ($answer:expr, $result:ty; $($method:ident($($argument:ty),*)),*) => {
        $(fn $method(self, $(_: $argument),*) -> Result<$result, NotFinite> {
            Ok($answer)
        })*
    };
}

impl Serializer for Finite {
    type Ok = ();
    type Error = NotFinite;
    type SerializeSeq = Self;
    type SerializeTuple = Self;
    type SerializeTupleStruct = Self;
    type SerializeTupleVariant = Self;
    type SerializeMap = Self;
    type SerializeStruct = Self;
    type SerializeStructVariant = Self;

    answers!(
        (), ();
        serialize_bool(bool), serialize_i8(i8), serialize_i16(i16), serialize_i32(i32), serialize_i64(i64),
        serialize_u8(u8), serialize_u16(u16), serialize_u32(u32), serialize_u64(u64), serialize_char(char),
        serialize_str(&str), serialize_bytes(&[u8]), serialize_none(), serialize_unit(),
        serialize_unit_struct(&'static str), serialize_unit_variant(&'static str, u32, &'static str)
    );
    answers!(
        Self::default(), Self;
        serialize_seq(Option<usize>), serialize_tuple(usize), serialize_map(Option<usize>),
        serialize_tuple_struct(&'static str, usize), serialize_struct(&'static str, usize),
        serialize_tuple_variant(&'static str, u32, &'static str, usize),
        serialize_struct_variant(&'static str, u32, &'static str, usize)
    );

    fn serialize_f32(self, value: f32) -> Checked {
        self.serialize_f64(value.into())
    }

    fn serialize_f64(self, value: f64) -> Checked {
        if value.is_finite() {
            return Ok(());
        }
        let field = String::new();
        Err(NotFinite { field, value })
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Checked {
        value.serialize(self)
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(self, _: &'static str, value: &T) -> Checked {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        mut self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Checked {
        self.part(Some(variant), value)
    }
}

/// All that has parts is gone through in the same way; the parts of some have names.
macro_rules! goes_through {
    ($($kind:ident $method:ident $(($name:ident))?),*) => {
        $(impl ser::$kind for Finite {
            type Ok = ();
            type Error = NotFinite;

            fn $method<T: Serialize + ?Sized>(&mut self, $($name: &'static str,)? part: &T) -> Checked {
                self.part([$($name)?].first().copied(), part)
            }

            fn end(self) -> Checked {
                Ok(())
            }
        })*
    };
}

goes_through!(
    SerializeSeq serialize_element, SerializeTuple serialize_element, SerializeTupleStruct serialize_field,
    SerializeTupleVariant serialize_field, SerializeStruct serialize_field (name),
    SerializeStructVariant serialize_field (name)
);

impl ser::SerializeMap for Finite {
    type Ok = ();
    type Error = NotFinite;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, _: &T) -> Checked {
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Checked {
        self.part(None, value)
    }

    fn end(self) -> Checked {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use serde::Serialize;

    use super::{Error, check};

    #[derive(Serialize)]
    struct Answer {
        force: f64,
        none: Option<f64>,
        some: Option<f64>,
        list: Vec<[f64; 2]>,
        map: BTreeMap<&'static str, f32>,
        place: Place,
        pair: (u64, f64),
    }

    #[derive(Serialize)]
    enum Place {
        End,
        Clamp(f64),
        Spring { stiffness: f64 },
        Between(f64, f64),
    }

    fn answer() -> Answer {
        Answer {
            force: f64::MAX,
            none: None,
            some: Some(-5e-324),
            list: vec![[0.0, -0.0], [1.0, 2.0]],
            map: BTreeMap::from([("a", 1.0)]),
            place: Place::End,
            pair: (1, 2.0),
        }
    }

    #[track_caller]
    fn assert_found(answer: &Answer, place: &str) {
        let Err(Error::NotFinite { field, .. }) = check(answer) else {
            panic!("{place} is not found");
        };
        assert_eq!(field, place);
    }

    #[test]
    fn numbers_and_missing_values_pass() {
        check(&answer()).expect("finite");
        check::<[f64]>(&[]).expect("finite");
        check("inf").expect("a text");
    }

    #[test]
    fn what_is_no_number_is_found_wherever_it_stands() {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_found(
                &Answer {
                    force: bad,
                    ..answer()
                },
                "force",
            );
            let some = Some(bad);
            assert_found(&Answer { some, ..answer() }, "some");
            let list = vec![[0.0, 0.0], [0.0, bad]];
            assert_found(&Answer { list, ..answer() }, "list[1][1]");
            let map = BTreeMap::from([("a", 1.0), ("b", bad as f32)]);
            assert_found(&Answer { map, ..answer() }, "map[1]");
            let place = Place::Clamp(bad);
            assert_found(&Answer { place, ..answer() }, "place.Clamp");
            let place = Place::Spring { stiffness: bad };
            assert_found(&Answer { place, ..answer() }, "place.stiffness");
            let place = Place::Between(0.0, bad);
            assert_found(&Answer { place, ..answer() }, "place[1]");
            assert_found(
                &Answer {
                    pair: (0, bad),
                    ..answer()
                },
                "pair[1]",
            );
        }
    }
}
