//! Values that may be a word or a number, or else a table, and the pair of a time and a temperature.

use cable_dem::End;
use ground_field::Modulus;

use crate::document::{Content, Node};
use crate::error::{SceneError, WrongKind};
use crate::key::{Form, Keys, Kind, Visit, keys};
use crate::kind::{Optional, Text, Whole, Word, section};
use crate::range::{ANY_WHOLE, MODULUS, MODULUS_AT_AN_END, Quantity, SPRING, TEMPERATURE, TIME_OF_DAY};
use crate::value::Value;

keys! {
    #[derive(Copy)]
    pub struct SpringKeys {
        /// Stiffness of the spring at this end; `stiffness` is understood too.
        spring: f64 = SPRING;
    }
}

keys! {
    #[derive(Copy)]
    pub struct GradedKeys {
        /// Young's modulus at the top of a layer in which it varies.
        top: f64 = MODULUS_AT_AN_END;
        /// The same at the bottom.
        bottom: f64 = MODULUS_AT_AN_END;
    }
}

pub const TABLE: &str = "the name of a table, such as \"axles.csv\"";
const TEXT: Text = Text("a text in quotes");

keys! {
    #[derive(Default)]
    pub struct HistogramKeys {
        /// The table, from the folder of the scene on.
        file: String = Text(TABLE);
        /// What stands between its cells.
        separator: Option<String> = Optional(Text("comma, semicolon, tab, space or |, in quotes")), "recognised";
        /// What stands before its decimals.
        decimal: Option<String> = Optional(Text("\"point\" or \"comma\"")), "recognised";
        /// How its characters are written.
        encoding: Option<String> = Optional(Text("utf-8, utf-16, latin-1, shift_jis, …, in quotes")), "recognised";
        /// Its line with the names of the columns.
        header_line: Option<u64> = Optional(Whole(ANY_WHOLE)), "recognised";
        /// Rows below the names that hold no axles.
        skip: Option<u64> = Optional(Whole(ANY_WHOLE)), "recognised";
        /// Sheet of a workbook.
        sheet: Option<String> = Optional(TEXT), "the first with rows";
        /// Unit of the loads.
        unit: Option<String> = Optional(Text("a unit of force, in quotes")), "that of the header";
        /// Name of the column with the loads.
        column_load: Option<String> = Optional(TEXT), "recognised";
        /// Name of the column with the numbers of axles.
        column_count: Option<String> = Optional(TEXT), "recognised";
        /// Name of the column with the radii.
        column_contact_radius: Option<String> = Optional(TEXT), "recognised";
    }
}

pub const POINTS: &str = "two points of the day or more, such as [[\"0 h\", \"0 K\"], [\"15 h\", \"20 K\"]], their times ascending";

/// A value that is no table, or a table with the keys of `T`.
pub struct Either<K: Kind, T, V> {
    plain: K,
    /// What is allowed, if that is more than what is allowed of the plain value.
    allowed: Option<&'static str>,
    of_plain: fn(K::Value) -> V,
    of_table: fn(T) -> V,
    /// Its table, or else its plain value.
    parts: fn(&V) -> Result<T, K::Value>,
}

const HELD: Word<End> = Word {
    words: &[("free", End::Free), ("fixed", End::Fixed)],
    allowed: Some("\"free\", \"fixed\" or { spring = \"3 MN/m\" }"),
    gone: None,
};

/// What holds an end.
pub const END: Either<Word<End>, SpringKeys, End> = Either {
    plain: HELD,
    allowed: None,
    of_plain: |held| held,
    of_table: |keys| End::Spring(keys.spring),
    parts: |end| match *end {
        End::Spring(spring) => Ok(SpringKeys { spring }),
        held => Err(held),
    },
};

/// A modulus, the same everywhere or changing with depth.
pub const LAYER_MODULUS: Either<Quantity, GradedKeys, Modulus> = Either {
    plain: MODULUS,
    allowed: None,
    of_plain: Modulus::Uniform,
    of_table: |GradedKeys { top, bottom }| Modulus::Linear { top, bottom },
    parts: |modulus| match *modulus {
        Modulus::Uniform(modulus) => Err(modulus),
        Modulus::Linear { top, bottom } => Ok(GradedKeys { top, bottom }),
    },
};

/// The name of a table of axles, or a table that says how it is to be read.
pub const HISTOGRAM: Either<Text, HistogramKeys, HistogramKeys> = Either {
    plain: Text(TABLE),
    allowed: Some(
        "the name of a table, such as \"axles.csv\", with the columns load, count and, if wanted, contact_radius, or { file = \
         \"axles.csv\", decimal = \"comma\" }",
    ),
    of_plain: |file| HistogramKeys {
        file,
        ..HistogramKeys::default()
    },
    of_table: |keys| keys,
    parts: |keys| Ok(keys.clone()),
};

impl<K: Kind, T: Keys, V> Kind for Either<K, T, V> {
    type Value = V;

    fn read(&self, value: &Value) -> Result<V, SceneError> {
        if let Content::Table(_) = value.node.content {
            return section::<T>().read(value).map(self.of_table);
        }
        self.plain.read(value).map(self.of_plain).map_err(|mut error| {
            // What stands there may belong into the table: `"3 MN/m"` in place of `{ spring = "3 MN/m" }`.
            if let (SceneError::Wrong(wrong), Some(key)) = (&mut error, T::keys().first())
                && let (Form::Quantity(quantity), Content::Text(text)) = (&key.form, &value.node.content)
                && quantity
                    .dimension
                    .is_some_and(|dimension| dimension.parse(text).is_ok())
            {
                let meant = [key.name, " = ", &value.written(), " }?"];
                wrong
                    .allowed
                    .extend(["; did you mean { "].into_iter().chain(meant));
            }
            error
        })
    }

    fn write(&self, value: &V) -> Option<Content> {
        match (self.parts)(value) {
            Ok(table) => section().write(&table),
            Err(plain) => self.plain.write(&plain),
        }
    }

    fn each(&self, value: &V, path: &str, visit: &mut Visit) {
        match (self.parts)(value) {
            Ok(table) => table.each(path, visit),
            Err(plain) => self.plain.each(&plain, path, visit),
        }
    }

    fn form(&self) -> Form {
        Form::Either(Box::new(self.plain.form()), T::keys(), self.allowed)
    }
}

/// A time of the day and a temperature.
pub struct PointKind;

impl Kind for PointKind {
    type Value = (f64, f64);

    fn read(&self, value: &Value) -> Result<(f64, f64), SceneError> {
        let [time, kelvin] = &value.items(POINTS)?[..] else {
            let allowed = "a point of the day: [\"15 h\", \"20 K\"]";
            return Err(value.wrong(WrongKind::Value, value.written(), allowed));
        };
        Ok((TIME_OF_DAY.read(time)?, TEMPERATURE.read(kelvin)?))
    }

    fn write(&self, (time, kelvin): &(f64, f64)) -> Option<Content> {
        let items = [TIME_OF_DAY.write(time)?, TEMPERATURE.write(kelvin)?];
        Some(Content::List(items.map(Node::from).into()))
    }

    fn each(&self, (time, kelvin): &(f64, f64), path: &str, visit: &mut Visit) {
        visit(&format!("{path}.0"), *time, TIME_OF_DAY);
        visit(&format!("{path}.1"), *kelvin, TEMPERATURE);
    }

    fn form(&self) -> Form {
        Form::Text("a point of the day: [\"15 h\", \"20 K\"]")
    }
}
