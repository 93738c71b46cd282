//! Tables in and out by Arrow's C stream interface, which pyarrow, polars, pandas and others speak: `__arrow_c_stream__`
//! (arrow.apache.org/docs/format/CDataInterface/PyCapsuleInterface.html).

use std::ffi::CStr;
use std::sync::Arc;

use arrow_array::cast::AsArray;
use arrow_array::ffi_stream::{FFI_ArrowArrayStream, RecordBatchStreamReader};
use arrow_array::types::{
    Decimal128Type, Decimal256Type, Float32Type, Float64Type, Int8Type, Int16Type, Int32Type, Int64Type,
    UInt8Type, UInt16Type, UInt32Type, UInt64Type,
};
use arrow_array::{
    Array, ArrayRef, BooleanArray, Float64Array, Int64Array, RecordBatch, RecordBatchIterator, StringArray,
};
use arrow_schema::{DataType, Field, Schema};
use creepage::sweep::AnswerValues;
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyCapsuleMethods};

use crate::failure::Failure;

/// Name of a stream's capsule.
const STREAM: &CStr = c"arrow_array_stream";

/// How pandas names the column of an index without a name.
const INDEX: &str = "__index_level_";

/// Columns by name, each cell as it would be typed; empty where it is null.
pub type Columns = Vec<(String, Vec<String>)>;

/// The columns of anything with `__arrow_c_stream__`.
#[allow(
    unsafe_code,
    reason = "the stream is a C structure, which the capsule's name vouches for"
)]
pub fn columns(py: Python<'_>, rows: &Bound<'_, PyAny>) -> PyResult<Columns> {
    let capsule = rows.call_method0("__arrow_c_stream__")?;
    let capsule = capsule.cast::<PyCapsule>()?;
    let pointer = capsule.pointer_checked(Some(STREAM))?;
    // SAFETY: a capsule of this name holds a valid stream, which is moved out of it.
    let stream =
        unsafe { RecordBatchStreamReader::from_raw(pointer.as_ptr().cast::<FFI_ArrowArrayStream>()) };
    let wrong = |error: arrow_schema::ArrowError| Failure::input(&error).raised(py);
    let stream = stream.map_err(wrong)?;
    let schema = arrow_array::RecordBatchReader::schema(&stream);
    let names = schema.fields().iter().map(|field| field.name().clone());
    let mut columns: Columns = names.map(|name| (name, Vec::new())).collect();
    for batch in stream {
        let batch = batch.map_err(wrong)?;
        for ((name, cells), array) in columns.iter_mut().zip(batch.columns()) {
            cells.extend(texts(name, array).map_err(|failure| failure.raised(py))?);
        }
    }
    columns.retain(|(name, _)| !name.starts_with(INDEX));
    Ok(columns)
}

/// The cells of an array.
fn texts(name: &str, array: &ArrayRef) -> Result<Vec<String>, Failure> {
    macro_rules! shown {
        ($values:expr) => {
            $values
                .iter()
                .map(|value| value.map_or_else(String::new, |value| value.to_string()))
                .collect()
        };
    }
    macro_rules! real {
        ($values:expr) => {
            $values
                .iter()
                .map(|value| match value {
                    Some(value) if !value.is_nan() => value.to_string(),
                    _ => String::new(),
                })
                .collect()
        };
    }
    macro_rules! decimal {
        ($values:expr) => {
            (0..array.len())
                .map(|row| {
                    if array.is_null(row) {
                        String::new()
                    } else {
                        $values.value_as_string(row)
                    }
                })
                .collect()
        };
    }
    let trimmed = |text: Option<&str>| text.unwrap_or_default().trim().to_owned();
    Ok(match array.data_type() {
        DataType::Null => vec![String::new(); array.len()],
        DataType::Boolean => shown!(array.as_boolean()),
        DataType::Utf8 => array.as_string::<i32>().iter().map(trimmed).collect(),
        DataType::LargeUtf8 => array.as_string::<i64>().iter().map(trimmed).collect(),
        DataType::Utf8View => array.as_string_view().iter().map(trimmed).collect(),
        DataType::Float64 => real!(array.as_primitive::<Float64Type>()),
        DataType::Float32 => real!(array.as_primitive::<Float32Type>()),
        DataType::Decimal128(..) => decimal!(array.as_primitive::<Decimal128Type>()),
        DataType::Decimal256(..) => decimal!(array.as_primitive::<Decimal256Type>()),
        DataType::Int8 => shown!(array.as_primitive::<Int8Type>()),
        DataType::Int16 => shown!(array.as_primitive::<Int16Type>()),
        DataType::Int32 => shown!(array.as_primitive::<Int32Type>()),
        DataType::Int64 => shown!(array.as_primitive::<Int64Type>()),
        DataType::UInt8 => shown!(array.as_primitive::<UInt8Type>()),
        DataType::UInt16 => shown!(array.as_primitive::<UInt16Type>()),
        DataType::UInt32 => shown!(array.as_primitive::<UInt32Type>()),
        DataType::UInt64 => shown!(array.as_primitive::<UInt64Type>()),
        DataType::Dictionary(..) => {
            let dictionary = array.as_any_dictionary();
            let values = texts(name, dictionary.values())?;
            if values.is_empty() {
                return Ok(vec![String::new(); array.len()]);
            }
            let keys = dictionary.normalized_keys();
            let cell = |(row, key): (usize, usize)| {
                if array.is_null(row) {
                    String::new()
                } else {
                    values[key].clone()
                }
            };
            keys.into_iter().enumerate().map(cell).collect()
        }
        other => return Err(Failure::column(name, other)),
    })
}

/// A table that anything with Arrow can take over: `pyarrow.table(t)`, `polars.DataFrame(t)`, `pandas.DataFrame.from_arrow(t)`.
#[pyclass(frozen, module = "creepage")]
pub struct Table(RecordBatch);

impl Table {
    /// A table of named columns.
    pub fn of(columns: impl Iterator<Item = (String, AnswerValues)>) -> Result<Self, Failure> {
        let count = |value: Option<u64>| value.and_then(|value| i64::try_from(value).ok());
        let arrays = columns.map(|(name, values)| {
            let array: ArrayRef = match values {
                AnswerValues::Numbers(values) => Arc::new(Float64Array::from(values)),
                AnswerValues::Counts(values) => {
                    Arc::new(values.into_iter().map(count).collect::<Int64Array>())
                }
                AnswerValues::Flags(values) => Arc::new(BooleanArray::from(values)),
                AnswerValues::Texts(values) => Arc::new(StringArray::from(values)),
            };
            (Field::new(name, array.data_type().clone(), true), array)
        });
        let (fields, arrays): (Vec<Field>, Vec<ArrayRef>) = arrays.unzip();
        let batch = RecordBatch::try_new(Arc::new(Schema::new(fields)), arrays);
        batch.map(Self).map_err(|error| Failure::computation(&error))
    }
}

#[pymethods]
impl Table {
    /// The table as a stream of one batch.
    #[pyo3(signature = (requested_schema=None))]
    #[allow(unused_variables, reason = "the interface has it, and allows to ignore it")]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<&Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        let batches = RecordBatchIterator::new([Ok(self.0.clone())], self.0.schema());
        let stream = FFI_ArrowArrayStream::new(Box::new(batches));
        PyCapsule::new_with_value(py, stream, STREAM)
    }

    /// Names of its columns.
    #[getter]
    fn column_names(&self) -> Vec<String> {
        self.0
            .schema()
            .fields()
            .iter()
            .map(|field| field.name().clone())
            .collect()
    }

    fn __len__(&self) -> usize {
        self.0.num_rows()
    }

    fn __repr__(&self) -> String {
        format!(
            "<creepage.Table of {} rows: {}>",
            self.0.num_rows(),
            self.column_names().join(", ")
        )
    }
}
