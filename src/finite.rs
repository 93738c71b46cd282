//! The last guard before an answer is given: every number in it is finite.
//!
//! JSON has no word for infinity, and serialises it as the `null` that stands for a missing value; a table would hold the text `inf`.
//! So a serializer that writes nothing goes through the answer before.

use std::fmt::{self, Display};

use serde::ser::{self, Serialize, Serializer};

use crate::Error;

/// Makes sure that no number of the answer is infinite or NaN.
///
/// # Errors
///
/// [`Error::NotFinite`] with the first such number and where it stands.
pub fn check<T: Serialize + ?Sized>(answer: &T) -> Result<(), Error> {
    answer.serialize(Finite).map_err(|found| Error::NotFinite {
        field: found.field,
        value: found.value,
    })
}

/// A number that is not finite, and the fields around it.
#[derive(Debug)]
struct NotFinite {
    field: String,
    value: f64,
}

impl NotFinite {
    fn within(mut self, name: &str) -> Self {
        let dot = if self.field.is_empty() || self.field.starts_with('[') {
            ""
        } else {
            "."
        };
        self.field = format!("{name}{dot}{}", self.field);
        self
    }
}

impl Display for NotFinite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} is {}", self.field, self.value)
    }
}

impl std::error::Error for NotFinite {}

impl ser::Error for NotFinite {
    fn custom<T: Display>(message: T) -> Self {
        Self {
            field: message.to_string(),
            value: f64::NAN,
        }
    }
}

type Checked = Result<(), NotFinite>;

/// Looks at numbers and passes everything else.
struct Finite;

/// Looks at the items of a list, which it counts, or of a map.
#[derive(Default)]
struct Items {
    count: usize,
}

impl Items {
    fn item<T: Serialize + ?Sized>(&mut self, item: &T) -> Checked {
        let index = self.count;
        self.count += 1;
        item.serialize(Finite)
            .map_err(|found| found.within(&format!("[{index}]")))
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
    type SerializeSeq = Items;
    type SerializeTuple = Items;
    type SerializeTupleStruct = Items;
    type SerializeTupleVariant = Items;
    type SerializeMap = Items;
    type SerializeStruct = Items;
    type SerializeStructVariant = Items;

    answers!(
        (), ();
        serialize_bool(bool), serialize_i8(i8), serialize_i16(i16), serialize_i32(i32), serialize_i64(i64),
        serialize_u8(u8), serialize_u16(u16), serialize_u32(u32), serialize_u64(u64), serialize_char(char),
        serialize_str(&str), serialize_bytes(&[u8]), serialize_none(), serialize_unit(),
        serialize_unit_struct(&'static str), serialize_unit_variant(&'static str, u32, &'static str)
    );
    answers!(
        Items::default(), Items;
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
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Checked {
        value.serialize(self).map_err(|found| found.within(variant))
    }
}

/// Lists of every kind are gone through in the same way, and so are fields of every kind.
macro_rules! goes_through {
    (items: $($list:ident $method:ident),*; fields: $($fields:ident),*) => {
        $(impl ser::$list for Items {
            type Ok = ();
            type Error = NotFinite;

            fn $method<T: Serialize + ?Sized>(&mut self, item: &T) -> Checked {
                self.item(item)
            }

            fn end(self) -> Checked {
                Ok(())
            }
        })*
        $(impl ser::$fields for Items {
            type Ok = ();
            type Error = NotFinite;

            fn serialize_field<T: Serialize + ?Sized>(&mut self, name: &'static str, value: &T) -> Checked {
                value.serialize(Finite).map_err(|found| found.within(name))
            }

            fn end(self) -> Checked {
                Ok(())
            }
        })*
    };
}

goes_through!(
    items: SerializeSeq serialize_element, SerializeTuple serialize_element, SerializeTupleStruct serialize_field,
        SerializeTupleVariant serialize_field;
    fields: SerializeStruct, SerializeStructVariant
);

impl ser::SerializeMap for Items {
    type Ok = ();
    type Error = NotFinite;

    fn serialize_key<T: Serialize + ?Sized>(&mut self, _: &T) -> Checked {
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Checked {
        self.item(value)
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
