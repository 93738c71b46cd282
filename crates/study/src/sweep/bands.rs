//! Quantiles of the forces where a sweep draws samples.

use serde::{Deserialize, Serialize};
use statrs::statistics::{Data, Distribution, OrderStatistics};

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
    /// Force on the downstream end \[N\]; `None` where fewer than two samples have an answer.
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
    /// What the samples at each point of the grid say; nothing where nothing is drawn.
    pub(super) fn bands(&self, columns: &[AnswerColumn], rows: &[Row]) -> Vec<Band> {
        if self.samples.count == 0 {
            return Vec::new();
        }
        let groups = rows.chunks(self.samples.count).enumerate();
        let band = |(group, rows): (usize, &[Row])| {
            let listed = self.axes.iter().zip(self.given(group));
            let listed =
                listed.filter(|(axis, value)| !value.is_empty() && drawn(&axis.key, value).is_none());
            let failed = rows.iter().filter_map(error_of).count();
            Band {
                at: listed
                    .map(|(axis, value)| (axis.key.clone(), value.to_owned()))
                    .collect(),
                samples: rows.len() - failed,
                failed,
                downstream_force_n: quantiles(numbers("downstream_force_n", columns, rows)),
                upstream_force_n: quantiles(numbers("upstream_force_n", columns, rows)),
                max_compression_n: quantiles(numbers("max_compression_n", columns, rows)),
            }
        };
        groups.map(band).collect()
    }
}

/// Quantiles are the median-unbiased ones (R. J. Hyndman and Y. Fan, The American Statistician 50
/// (1996) 361, type 8).
fn quantiles(values: Vec<Option<f64>>) -> Option<Quantiles> {
    let values: Vec<f64> = values.into_iter().flatten().collect();
    if values.len() < 2 {
        return None;
    }
    let mut data = Data::new(values);
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
