//! Values that may be a word or a number, or else a table, and the pair of a time and a temperature.

use cable_dem::End;
use ground_field::Modulus;

use crate::document::{Content, Node};
use crate::error::{SceneError, WrongKind};
use crate::key::{Form, Keys, Kind, Visit, keys};
use crate::kind::{Optional, Text, Whole, Word, section};
use crate::range::{ANY_WHOLE, MODULUS, MODULUS_AT_AN_END, SPRING, TEMPERATURE, TIME_OF_DAY};
use crate::units::Dimension;
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

/// What holds an end: a word, or a table with a spring.
pub struct EndKind;

const HELD: &[(&str, End)] = &[("free", End::Free), ("fixed", End::Fixed)];
const END: &str = "\"free\", \"fixed\" or { spring = \"3 MN/m\" }";

impl Kind for EndKind {
    type Value = End;

    fn read(&self, value: &Value) -> Result<End, SceneError> {
        if value.is_table() {
            return Ok(End::Spring(section::<SpringKeys>().read(value)?.spring));
        }
        let spring = Dimension::ForcePerLength.parse(&value.text(END)?);
        let meant = spring.map_or_else(
            |_| String::new(),
            |_| format!("; did you mean {{ spring = {} }}?", value.written()),
        );
        value.word(HELD, &format!("{END}{meant}"))
    }

    fn write(&self, value: &End) -> Option<Content> {
        match value {
            End::Spring(spring) => section().write(&SpringKeys { spring: *spring }),
            held => Word::of(HELD).write(held),
        }
    }

    fn each(&self, value: &End, path: &str, visit: &mut Visit) {
        if let End::Spring(spring) = value {
            SpringKeys { spring: *spring }.each(path, visit);
        }
    }

    fn form(&self) -> Form {
        let words = HELD.iter().map(|(word, _)| *word).collect();
        Form::Either(Box::new(Form::Words(words, None)), SpringKeys::keys(), Some(END))
    }
}

/// A modulus, or a table with those at the top and at the bottom of a layer.
pub struct ModulusKind;

impl Kind for ModulusKind {
    type Value = Modulus;

    fn read(&self, value: &Value) -> Result<Modulus, SceneError> {
        if !value.is_table() {
            return value.quantity(MODULUS).map(Modulus::Uniform);
        }
        let GradedKeys { top, bottom } = section().read(value)?;
        Ok(Modulus::Linear { top, bottom })
    }

    fn write(&self, value: &Modulus) -> Option<Content> {
        match *value {
            Modulus::Uniform(modulus) => MODULUS.write(&modulus),
            Modulus::Linear { top, bottom } => section().write(&GradedKeys { top, bottom }),
        }
    }

    fn each(&self, value: &Modulus, path: &str, visit: &mut Visit) {
        match *value {
            Modulus::Uniform(modulus) => visit(path, modulus, MODULUS),
            Modulus::Linear { top, bottom } => GradedKeys { top, bottom }.each(path, visit),
        }
    }

    fn form(&self) -> Form {
        Form::Either(Box::new(Form::Quantity(MODULUS)), GradedKeys::keys(), None)
    }
}

/// The name of a table of axles, or a table that says how it is to be read.
pub struct HistogramKind;

const HISTOGRAM: &str = "the name of a table, such as \"axles.csv\", with the columns load, count and, if wanted, contact_radius, \
                         or { file = \"axles.csv\", decimal = \"comma\" }";

impl Kind for HistogramKind {
    type Value = HistogramKeys;

    fn read(&self, value: &Value) -> Result<HistogramKeys, SceneError> {
        if value.is_table() {
            return section::<HistogramKeys>().read(value);
        }
        Ok(HistogramKeys {
            file: value.text(TABLE)?,
            ..HistogramKeys::default()
        })
    }

    fn write(&self, value: &HistogramKeys) -> Option<Content> {
        section::<HistogramKeys>().write(value)
    }

    fn form(&self) -> Form {
        Form::Either(
            Box::new(Form::Text(TABLE)),
            HistogramKeys::keys(),
            Some(HISTOGRAM),
        )
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
        Ok((time.quantity(TIME_OF_DAY)?, kelvin.quantity(TEMPERATURE)?))
    }

    fn write(&self, (time, kelvin): &(f64, f64)) -> Option<Content> {
        let items = [TIME_OF_DAY.write(time)?, TEMPERATURE.write(kelvin)?];
        Some(Content::Array(items.map(Node::of_program).into()))
    }

    fn each(&self, (time, kelvin): &(f64, f64), path: &str, visit: &mut Visit) {
        visit(&format!("{path}.0"), *time, TIME_OF_DAY);
        visit(&format!("{path}.1"), *kelvin, TEMPERATURE);
    }

    fn form(&self) -> Form {
        Form::Text("a point of the day: [\"15 h\", \"20 K\"]")
    }
}
