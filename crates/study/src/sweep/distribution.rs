//! Distributions that a key's values are drawn from.

use statrs::distribution::{ContinuousCDF, LogNormal, Normal, Triangular, Uniform};

use super::numbers::{number, numbers};

/// The column that is carried over: it names a row and is no key of a scene.
pub const ID: &str = "id";
/// Keys whose text is never a number or a distribution.
pub const TEXTS: [&str; 3] = ["title", "name", ID];

/// A distribution of a key's value, whole or between two bounds.
pub struct Distribution {
    law: Box<dyn ContinuousCDF<f64, f64>>,
    /// Minimum and maximum value that is drawn, in the unit.
    bounds: [f64; 2],
    /// Unit behind every drawn number; may be empty.
    unit: String,
}

const LAWS: &str = "normal(MEAN, SD), lognormal(MEDIAN, SIGMA) with the standard deviation SIGMA of the logarithm, uniform(LOW, HIGH) or \
    triangular(LOW, MODE, HIGH), with SD > 0, SIGMA > 0, MEDIAN > 0 and LOW < HIGH, all but SIGMA in one unit";
const BOUNDS: &str = "min=LOW and max=HIGH behind the parameters, in their unit, with at least a thousandth of all values between them";

/// Share of a law that lies between its bounds at least: of what lies farther out the distribution
/// function has too few digits.
const MIN_SHARE: f64 = 1e-3;

impl Distribution {
    /// Reads `normal(MEAN, SD)`, `lognormal(MEDIAN, SIGMA)` with the standard deviation SIGMA of
    /// the logarithm, `uniform(LOW, HIGH)` or `triangular(LOW, MODE, HIGH)`, each also with
    /// `min=LOW` or `max=HIGH` behind its parameters; the error is what is allowed. `None` for a
    /// text that is no call.
    pub fn parse(text: &str) -> Option<Result<Self, &'static str>> {
        let (name, rest) = text.split_once('(')?;
        let (name, parameters) = (name.trim(), rest.strip_suffix(')')?);
        let is_name = name.chars().all(|c| c.is_ascii_alphabetic());
        is_name.then(|| Self::of(name, parameters))
    }

    fn of(name: &str, parameters: &str) -> Result<Self, &'static str> {
        let parts: Vec<&str> = parameters.split(',').collect();
        let bounded = parts.iter().position(|part| part.contains('='));
        let (parts, limits) = parts.split_at(bounded.unwrap_or(parts.len()));
        let (law, unit) = law(name, parts).ok_or(LAWS)?;
        let mut bounds = [f64::NEG_INFINITY, f64::INFINITY];
        for limit in limits {
            let (name, value) = limit.split_once('=').ok_or(BOUNDS)?;
            let (value, own) = number(value).ok_or(BOUNDS)?;
            let bound = match name.trim() {
                "min" => &mut bounds[0],
                "max" => &mut bounds[1],
                _ => return Err(BOUNDS),
            };
            if own != unit || bound.is_finite() {
                return Err(BOUNDS);
            }
            *bound = value;
        }
        let [below, upto] = bounds.map(|bound| law.cdf(bound));
        if !(MIN_SHARE..=1.0).contains(&(upto - below)) {
            return Err(BOUNDS);
        }
        Ok(Self { law, bounds, unit })
    }

    /// The value below which the share `probability` of all draws lies, and its text with the unit;
    /// NaN unless it is from 0 to 1.
    pub fn quantile(&self, probability: f64) -> (f64, String) {
        let [below, upto] = self.bounds.map(|bound| self.law.cdf(bound));
        let [least, most] = self.bounds;
        let value = if (0.0..=1.0).contains(&probability) {
            let within = below + probability * (upto - below);
            self.law.inverse_cdf(within).clamp(least, most)
        } else {
            f64::NAN
        };
        (value, format!("{value:?} {}", self.unit).trim_end().to_owned())
    }
}

/// A law of this name and its unit.
fn law(name: &str, parts: &[&str]) -> Option<(Box<dyn ContinuousCDF<f64, f64>>, String)> {
    Some(match name {
        "normal" => {
            let ([mean, deviation], unit) = numbers(parts)?;
            (Box::new(Normal::new(mean, deviation).ok()?), unit)
        }
        "lognormal" => {
            let &[median, sigma] = parts else { return None };
            let ((median, unit), (sigma, none)) = (number(median)?, number(sigma)?);
            let logarithm = (median > 0.0 && none.is_empty()).then(|| median.ln())?;
            (Box::new(LogNormal::new(logarithm, sigma).ok()?), unit.to_owned())
        }
        "uniform" => {
            let ([low, high], unit) = numbers(parts)?;
            (Box::new(Uniform::new(low, high).ok()?), unit)
        }
        "triangular" => {
            let ([low, mode, high], unit) = numbers(parts)?;
            (Box::new(Triangular::new(low, high, mode).ok()?), unit)
        }
        _ => return None,
    })
}

/// The distribution that stands at `key`, if one does: names are texts.
pub fn drawn(key: &str, text: &str) -> Option<Result<Distribution, &'static str>> {
    let is_name = TEXTS.contains(&key.rsplit('.').next().unwrap_or(key));
    Distribution::parse(text).filter(|_| !is_name)
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
        // A quarter of the triangle lies below its mode, and half of that area below 1/√2 of the
        // way there.
        close(quantile("triangular(0, 1, 4)", 0.25).0, 1.0);
        close(quantile("triangular(0, 1, 4)", 0.125).0, 0.5_f64.sqrt());
        // Of the upper half of a normal distribution, half lies below the upper quartile of the
        // whole.
        close(quantile("normal(0, 1, min=0)", 0.5).0, 0.6744897501960817);
        close(quantile("normal(0.25, 0.03, min=0.2, max=0.3)", 0.5).0, 0.25);
        let (least, text) = quantile("normal(1 kN, 5 kN, min=0 kN)", 0.0);
        assert!((0.0..1e-12).contains(&least) && text.ends_with(" kN"), "{text}");
        close(quantile("lognormal(2 m, 0.5, max=2 m)", 1.0).0, 2.0);
    }

    #[test]
    fn bounds_leave_something_to_draw() {
        for text in [
            "normal(0, 1, min=4)",
            "normal(0, 1, min=1, max=0)",
            "normal(0 m, 1 m, min=0)",
            "normal(0, 1, min=0, min=1)",
            "normal(0, 1, least=0)",
            "normal(0, min=0, 1)",
            "uniform(0, 1, max=nan)",
            "triangular(1, 5, 4)",
            "triangular(0, 1e200, 2e200, min=1e200)",
            "uniform(-1.5e308, 1.5e308, max=1e308)",
            "triangular(1, 1, 1)",
        ] {
            assert!(Distribution::parse(text).expect("a call").is_err(), "{text}");
        }
    }
}
