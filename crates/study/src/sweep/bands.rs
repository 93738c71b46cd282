//! Quantiles of the forces where a sweep draws samples.

use serde::{Deserialize, Serialize};
use statrs::statistics::{Data, Distribution, OrderStatistics};

use super::axis::Axis;
use super::columns::{AnswerColumn, Row, error_of, numbers};
use super::distribution::drawn;
use super::grid::Sweep;

/// What the samples at one point of the grid say.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Band {
    /// The listed keys and their values.
    pub at: Vec<(String, String)>,
    /// Samples with an answer.
    pub samples: usize,
    /// Samples that failed, which the quantiles leave out.
    pub failed: usize,
    /// Force on the downstream end \[N\]; `None` if fewer than two samples have an answer.
    pub downstream_force_n: Option<Quantiles>,
    /// Force on the upstream end \[N\].
    pub upstream_force_n: Option<Quantiles>,
    /// Largest compression along the cable \[N\].
    pub max_compression_n: Option<Quantiles>,
}

/// Mean, standard deviation and quantiles of the samples.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Quantiles {
    /// Mean.
    pub mean: f64,
    /// Standard deviation.
    pub standard_deviation: f64,
    /// 5 % of the samples are below.
    pub p05: f64,
    /// A quarter is below.
    pub p25: f64,
    /// Half is below.
    pub p50: f64,
    /// Three quarters are below.
    pub p75: f64,
    /// 95 % are below.
    pub p95: f64,
}

impl Sweep {
    /// What the samples at each point of the grid say; nothing if nothing is drawn.
    pub(super) fn bands(&self, columns: &[AnswerColumn], rows: &[Row]) -> Vec<Band> {
        let is_listed = |axis: &Axis, value: &str| !value.is_empty() && drawn(&axis.key, value).is_none();
        let band = |(group, rows): (usize, &[Row])| {
            let given = self.axes.iter().zip(self.given(group));
            let listed = given.filter(|(axis, value)| is_listed(axis, value));
            let failed = rows.iter().filter_map(error_of).count();
            let of = |name| quantiles(numbers(name, columns, rows));
            Band {
                at: listed
                    .map(|(axis, value)| (axis.key.clone(), value.to_owned()))
                    .collect(),
                samples: rows.len() - failed,
                failed,
                downstream_force_n: of("downstream_force_n"),
                upstream_force_n: of("upstream_force_n"),
                max_compression_n: of("max_compression_n"),
            }
        };
        match self.samples.count {
            0 => Vec::new(),
            count => rows.chunks(count).enumerate().map(band).collect(),
        }
    }
}

/// Quantiles are the median-unbiased ones (R. J. Hyndman and Y. Fan, The American Statistician 50
/// (1996) 361, type 8).
fn quantiles(values: Vec<Option<f64>>) -> Option<Quantiles> {
    let mut data = Data::new(values.into_iter().flatten().collect::<Vec<f64>>());
    if data.len() < 2 {
        return None;
    }
    Some(Quantiles {
        mean: data.mean()?,
        standard_deviation: data.std_dev()?,
        p05: data.quantile(0.05),
        p25: data.quantile(0.25),
        p50: data.quantile(0.5),
        p75: data.quantile(0.75),
        p95: data.quantile(0.95),
    })
}
