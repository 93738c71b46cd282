//! The table as Apache Parquet: one optional column of doubles, 64-bit counts or text for each column of the table.

use std::fs::File;
use std::io;
use std::path::Path;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::record::Field;
use parquet::schema::types::Type;

use super::sink::{Cell, Cells, Column, Kind, Sink};
use crate::output::Draft;

/// Rows that are kept in memory before they are written.
const GROUP: usize = 8192;

pub struct Parquet {
    writer: SerializedFileWriter<Draft>,
    kinds: Vec<Kind>,
    /// Rows that wait to be written.
    rows: Vec<Vec<Cell>>,
}

impl Parquet {
    pub fn new(file: Draft, columns: &[Column]) -> io::Result<Self> {
        let fields = columns
            .iter()
            .map(field)
            .collect::<Result<_, _>>()
            .map_err(other)?;
        let schema = Type::group_type_builder("sweep").with_fields(fields).build();
        let schema = Arc::new(schema.map_err(other)?);
        let properties = WriterProperties::builder().set_key_value_metadata(Some(vec![units(columns)]));
        let properties = Arc::new(properties.build());
        Ok(Self {
            writer: SerializedFileWriter::new(file, schema, properties).map_err(other)?,
            kinds: columns.iter().map(|column| column.kind).collect(),
            rows: Vec::new(),
        })
    }

    fn flush(&mut self) -> Result<(), ParquetError> {
        if self.rows.is_empty() {
            return Ok(());
        }
        let mut group = self.writer.next_row_group()?;
        for (index, kind) in self.kinds.iter().enumerate() {
            let cells = self.rows.iter().map(|row| &row[index]);
            match kind {
                Kind::Number => next::<DoubleType>(&mut group, cells.map(number).collect())?,
                Kind::Count => next::<Int64Type>(&mut group, cells.map(count).collect())?,
                Kind::Text => next::<ByteArrayType>(&mut group, cells.map(text).collect())?,
            }
        }
        group.close()?;
        self.rows.clear();
        Ok(())
    }
}

impl Sink for Parquet {
    fn row(&mut self, cells: Vec<Cell>) -> io::Result<()> {
        self.rows.push(cells);
        if self.rows.len() == GROUP {
            self.flush().map_err(other)?;
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> io::Result<Draft> {
        self.flush().map_err(other)?;
        self.writer.into_inner().map_err(other)
    }
}

/// The units of columns as metadata of the file: `units`, a JSON object.
fn units(columns: &[Column]) -> KeyValue {
    let unit = |column: &Column| Some((column.name.clone(), column.unit?.into()));
    let units: serde_json::Map<_, _> = columns.iter().filter_map(unit).collect();
    KeyValue::new("units".into(), serde_json::Value::Object(units).to_string())
}

fn number(cell: &Cell) -> Option<f64> {
    if let Cell::Number(value) = cell {
        Some(*value)
    } else {
        None
    }
}

fn count(cell: &Cell) -> Option<i64> {
    if let Cell::Count(value) = cell {
        i64::try_from(*value).ok()
    } else {
        None
    }
}

fn text(cell: &Cell) -> Option<ByteArray> {
    if let Cell::Text(value) = cell {
        Some(value.as_str().into())
    } else {
        None
    }
}

fn field(column: &Column) -> Result<Arc<Type>, ParquetError> {
    let physical = match column.kind {
        Kind::Number => Physical::DOUBLE,
        Kind::Count => Physical::INT64,
        Kind::Text => Physical::BYTE_ARRAY,
    };
    let text = (column.kind == Kind::Text).then_some(LogicalType::String);
    Type::primitive_type_builder(&column.name, physical)
        .with_repetition(Repetition::OPTIONAL)
        .with_logical_type(text)
        .build()
        .map(Arc::new)
}

/// Writes the values of the group's next column.
fn next<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Draft>,
    values: Vec<Option<T::T>>,
) -> Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else {
        return Ok(());
    };
    let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    let present: Vec<T::T> = values.into_iter().flatten().collect();
    column.typed::<T>().write_batch(&present, Some(&levels), None)?;
    column.close()
}

fn other(error: ParquetError) -> io::Error {
    io::Error::other(error)
}

/// The columns of a file and its rows, each cell as it would be typed.
pub fn read(file: &Path) -> io::Result<Cells> {
    let reader = SerializedFileReader::new(File::open(file)?).map_err(other)?;
    let schema = reader.metadata().file_metadata().schema();
    let keys: Vec<String> = schema
        .get_fields()
        .iter()
        .map(|field| field.name().to_owned())
        .collect();
    let rows = reader.get_row_iter(None).map_err(other)?;
    let cells = |row: parquet::record::Row| -> Vec<String> {
        row.get_column_iter().map(|(_, cell)| typed(cell)).collect()
    };
    let rows = rows
        .map(|row| row.map(cells))
        .collect::<Result<_, _>>()
        .map_err(other)?;
    Ok((keys, rows))
}

fn typed(cell: &Field) -> String {
    match cell {
        Field::Null => String::new(),
        Field::Str(text) => text.trim().to_owned(),
        // Others show themselves with their types' marks.
        Field::Double(value) if value.is_nan() => String::new(),
        Field::Double(value) => value.to_string(),
        Field::Float(value) => value.to_string(),
        cell => cell.to_string(),
    }
}
