//! Distributions that a key's values are drawn from.

use statrs::distribution::{ContinuousCDF, LogNormal, Normal, Uniform};

use super::numbers::{number, numbers};

/// A distribution of a key's value.
#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    law: Law,
    /// Unit behind every drawn number; may be empty.
    unit: String,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Law {
    Normal(Normal),
    LogNormal(LogNormal),
    Uniform(Uniform),
}

impl Distribution {
    /// Reads `normal(MEAN, SD)`, `lognormal(MEDIAN, SIGMA)` or `uniform(LOW, HIGH)`; the error is what is allowed. `None` for a text that
    /// is no call.
    pub(super) fn parse(text: &str) -> Option<Result<Self, &'static str>> {
        let (name, rest) = text.split_once('(')?;
        let (name, parameters) = (name.trim(), rest.strip_suffix(')')?);
        let is_name = name.chars().all(|c| c.is_ascii_alphabetic());
        is_name.then(|| distribution(name, parameters))
    }

    /// The value below which the share `probability` of all draws lies, and its text with the unit; NaN unless it is from 0 to 1.
    pub fn quantile(&self, probability: f64) -> (f64, String) {
        let value = match &self.law {
            _ if !(0.0..=1.0).contains(&probability) => f64::NAN,
            Law::Normal(law) => law.inverse_cdf(probability),
            Law::LogNormal(law) => law.inverse_cdf(probability),
            Law::Uniform(law) => law.inverse_cdf(probability),
        };
        (value, format!("{value:?} {}", self.unit).trim_end().to_owned())
    }
}

fn distribution(name: &str, parameters: &str) -> Result<Distribution, &'static str> {
    let parts: Vec<&str> = parameters.split(',').collect();
    let (law, unit) = match name {
        "normal" => {
            let allowed = "normal(MEAN, SD) with SD > 0, in one unit";
            let ([mean, deviation], unit) = numbers(&parts).ok_or(allowed)?;
            (
                Law::Normal(Normal::new(mean, deviation).map_err(|_| allowed)?),
                unit,
            )
        }
        "lognormal" => {
            let allowed = "lognormal(MEDIAN, SIGMA) with MEDIAN > 0 and SIGMA > 0, the standard deviation of the logarithm, a bare number";
            let [median, sigma] = parts[..] else {
                return Err(allowed);
            };
            let (median, unit) = number(median).ok_or(allowed)?;
            let (sigma, none) = number(sigma).ok_or(allowed)?;
            if median <= 0.0 || !none.is_empty() {
                return Err(allowed);
            }
            let law = LogNormal::new(median.ln(), sigma).map_err(|_| allowed)?;
            (Law::LogNormal(law), unit.to_owned())
        }
        "uniform" => {
            let allowed = "uniform(LOW, HIGH) with LOW < HIGH, in one unit";
            let ([low, high], unit) = numbers(&parts).ok_or(allowed)?;
            (Law::Uniform(Uniform::new(low, high).map_err(|_| allowed)?), unit)
        }
        _ => return Err("normal(MEAN, SD), lognormal(MEDIAN, SIGMA) or uniform(LOW, HIGH)"),
    };
    Ok(Distribution { law, unit })
}

#[cfg(test)]
mod tests {
    use super::Distribution;

    #[test]
    fn quantiles_of_distributions_are_theirs() {
        // Standard normal deviate of 97.5 %.
        let z = 1.959963984540054;
        let quantile = |text: &str, p| {
            let distribution = Distribution::parse(text)
                .expect("a call")
                .expect("a distribution");
            distribution.quantile(p)
        };
        let close = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-9, "{a} {b}");
        close(quantile("normal(0.25, 0.03)", 0.975).0, 0.25 + 0.03 * z);
        close(quantile("lognormal(2, 0.5)", 0.975).0, 2.0 * (0.5 * z).exp());
        close(quantile("uniform(3, 7)", 0.25).0, 4.0);
        assert_eq!(quantile("uniform(10 tf, 20 tf)", 0.5).1, "15.0 tf");
    }
}
