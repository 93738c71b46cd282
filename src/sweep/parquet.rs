//! The table as Apache Parquet: one optional column of doubles, 64-bit counts or text for each column of the table.

use std::io;
use std::sync::Arc;

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{ByteArray, ByteArrayType, DataType, DoubleType, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::{SerializedFileWriter, SerializedRowGroupWriter};
use parquet::schema::types::Type;

use super::sink::{Cell, Column, Kind, Sink};
use crate::output::Draft;

/// Rows that are kept in memory before they are written.
const GROUP: usize = 8192;

/// Writes a Parquet file.
pub struct Parquet {
    writer: SerializedFileWriter<Draft>,
    columns: Vec<Values>,
    rows: usize,
}

/// Values of one column that wait to be written.
enum Values {
    Numbers(Vec<Option<f64>>),
    Counts(Vec<Option<i64>>),
    Texts(Vec<Option<ByteArray>>),
}

impl Parquet {
    pub fn new(file: Draft, columns: &[Column]) -> io::Result<Self> {
        let fields = columns
            .iter()
            .map(field)
            .collect::<Result<_, _>>()
            .map_err(other)?;
        let schema = Type::group_type_builder("sweep")
            .with_fields(fields)
            .build()
            .map_err(other)?;
        let properties = Arc::new(WriterProperties::builder().build());
        Ok(Self {
            writer: SerializedFileWriter::new(file, Arc::new(schema), properties).map_err(other)?,
            columns: columns
                .iter()
                .map(|column| match column.kind {
                    Kind::Number => Values::Numbers(Vec::new()),
                    Kind::Count => Values::Counts(Vec::new()),
                    Kind::Text => Values::Texts(Vec::new()),
                })
                .collect(),
            rows: 0,
        })
    }

    fn flush(&mut self) -> Result<(), ParquetError> {
        if self.rows == 0 {
            return Ok(());
        }
        let mut group = self.writer.next_row_group()?;
        for column in &mut self.columns {
            match column {
                Values::Numbers(values) => next::<DoubleType>(&mut group, values)?,
                Values::Counts(values) => next::<Int64Type>(&mut group, values)?,
                Values::Texts(values) => next::<ByteArrayType>(&mut group, values)?,
            }
        }
        group.close()?;
        self.rows = 0;
        Ok(())
    }
}

impl Sink for Parquet {
    fn row(&mut self, cells: &[Cell]) -> io::Result<()> {
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            match (column, cell) {
                (Values::Numbers(values), Cell::Number(value)) => values.push(*value),
                (Values::Counts(values), Cell::Count(value)) => {
                    values.push(value.and_then(|value| i64::try_from(value).ok()));
                }
                (Values::Texts(values), Cell::Text(value)) => values.push(value.map(ByteArray::from)),
                _ => return Err(io::Error::other("a value in a column of another kind")),
            }
        }
        self.rows += 1;
        if self.rows == GROUP {
            self.flush().map_err(other)?;
        }
        Ok(())
    }

    fn finish(mut self: Box<Self>) -> io::Result<Draft> {
        self.flush().map_err(other)?;
        self.writer.into_inner().map_err(other)
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

/// Writes the waiting values of the group's next column.
fn next<T: DataType>(
    group: &mut SerializedRowGroupWriter<'_, Draft>,
    values: &mut Vec<Option<T::T>>,
) -> Result<(), ParquetError> {
    let Some(mut column) = group.next_column()? else {
        return Ok(());
    };
    let levels: Vec<i16> = values.iter().map(|value| i16::from(value.is_some())).collect();
    let present: Vec<T::T> = values.drain(..).flatten().collect();
    column.typed::<T>().write_batch(&present, Some(&levels), None)?;
    column.close()
}

fn other(error: ParquetError) -> io::Error {
    io::Error::other(error)
}
