//! Numbers to places along an axis, and the ticks that stand there.

use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

/// How ticks are labelled.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum TickLabels {
    /// As numbers: 0.001, or 10⁻⁶ where that would be long.
    Number,
    /// With SI prefixes of a unit: 1 µm.
    Prefixed(String),
}

/// A labelled or a bare tick.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    pub value: f64,
    pub label: String,
}

/// A range of numbers, or of cells of a map, laid along an axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Scale {
    range: (f64, f64),
    logarithmic: bool,
    ticks: Vec<Tick>,
    minor: Vec<f64>,
}

/// Tolerance for ticks on the ends of a range, as a share of the step between ticks.
const END: f64 = 1e-6;

impl Scale {
    /// Exactly `range`, with about `count` ticks inside. The range is finite, ascending, and positive if logarithmic.
    pub fn new(range: (f64, f64), logarithmic: bool, count: usize, labels: &TickLabels) -> Self {
        let (values, minor) = if logarithmic {
            logarithmic_ticks(range, count)
        } else {
            (linear_ticks(range, count), Vec::new())
        };
        let labels = label(&values, logarithmic, labels);
        let ticks = values
            .into_iter()
            .zip(labels)
            .map(|(value, label)| Tick { value, label })
            .collect();
        Self {
            range,
            logarithmic,
            ticks,
            minor,
        }
    }

    /// Cells named `names`, centred at 0, 1, 2, ...
    pub fn names(names: &[String]) -> Self {
        let ticks = names.iter().enumerate().map(|(k, name)| Tick {
            value: k as f64,
            label: name.clone(),
        });
        Self {
            range: (-0.5, names.len() as f64 - 0.5),
            logarithmic: false,
            ticks: ticks.collect(),
            minor: Vec::new(),
        }
    }

    pub fn is_logarithmic(&self) -> bool {
        self.logarithmic
    }

    pub fn ticks(&self) -> &[Tick] {
        &self.ticks
    }

    /// 0 at the beginning of the axis, 1 at its end; below and above beyond them.
    pub fn share(&self, value: f64) -> f64 {
        let (from, to) = self.range;
        if self.logarithmic {
            (value / from).ln() / (to / from).ln()
        } else {
            (value - from) / (to - from)
        }
    }
}

/// Whether both ends of a range and what lies between them are numbers that an axis can hold.
pub(super) fn is_sound((from, to): (f64, f64), logarithmic: bool) -> bool {
    let span = if logarithmic { to / from } else { to - from };
    from < to && span.is_finite() && (!logarithmic || from > 0.0)
}

/// `data`, its least and its largest number, with round numbers at both ends.
pub(super) fn round_range((low, high): (f64, f64), logarithmic: bool, count: usize) -> (f64, f64) {
    if logarithmic {
        let wider = if low == high { 3.0 } else { 1.0 };
        return (round_down(low / wider), round_up(high * wider));
    }
    let (low, high) = match (low == high, low) {
        (true, 0.0) => (-1.0, 1.0),
        (true, value) => (value - 0.5 * value.abs(), value + 0.5 * value.abs()),
        _ => (low, high),
    };
    let step = linear_step((low, high), count);
    (
        (low / step + END).floor() * step,
        (high / step - END).ceil() * step,
    )
}

/// What plotters asks of a coordinate.
impl Ranged for Scale {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        from + (self.share(*value) * f64::from(to - from)).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, hint: Hint) -> Vec<f64> {
        if hint.weight().allow_light_points() {
            self.minor.clone()
        } else {
            self.ticks.iter().map(|tick| tick.value).collect()
        }
    }

    fn range(&self) -> Range<f64> {
        self.range.0..self.range.1
    }
}

impl ValueFormatter<f64> for Scale {
    fn format_ext(&self, value: &f64) -> String {
        let tick = self.ticks.iter().find(|tick| tick.value == *value);
        tick.map_or_else(String::new, |tick| tick.label.clone())
    }
}

/// 1, 2 or 5 times a power of ten, for about `count` steps over the range.
fn linear_step((from, to): (f64, f64), count: usize) -> f64 {
    let rough = (to - from) / count.max(1) as f64;
    let power = 10f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|factor| factor * power >= rough * (1.0 - END));
    factor.unwrap_or(10.0) * power
}

fn linear_ticks(range: (f64, f64), count: usize) -> Vec<f64> {
    let step = linear_step(range, count);
    let (first, last) = ((range.0 / step - END).ceil(), (range.1 / step + END).floor());
    if !(step > 0.0 && last - first < 1000.0) {
        return Vec::new();
    }
    // Counted, not added up, so that no rounding piles up and zero is zero.
    (0..=(last - first) as usize)
        .map(|k| rounded((first + k as f64) * step, step))
        .collect()
}

/// `value` without the last digits' noise: 0.30000000000000004 is 0.3.
fn rounded(value: f64, step: f64) -> f64 {
    let digits = (2.0 - step.log10().floor()).clamp(0.0, 300.0) as usize;
    format!("{value:.digits$}").parse().unwrap_or(value)
}

/// Largest 1, 2 or 5 times a power of ten that is not above `value`.
fn round_down(value: f64) -> f64 {
    let power = value.log10().floor();
    [5.0, 2.0, 1.0]
        .into_iter()
        .map(|factor| factor * ten_to(power))
        .find(|round| *round <= value * (1.0 + END))
        .unwrap_or(ten_to(power))
}

/// Smallest 1, 2 or 5 times a power of ten that is not below `value`.
fn round_up(value: f64) -> f64 {
    let power = value.log10().floor();
    [1.0, 2.0, 5.0]
        .into_iter()
        .map(|factor| factor * ten_to(power))
        .find(|round| *round >= value * (1.0 - END))
        .unwrap_or(ten_to(power + 1.0))
}

/// A power of ten to the last digit.
fn ten_to(power: f64) -> f64 {
    format!("1e{power}").parse().unwrap_or(f64::NAN)
}

/// Labelled and bare ticks of a logarithmic axis: 1, 2 and 5 times powers of ten where that makes few, or decades.
fn logarithmic_ticks(range: (f64, f64), count: usize) -> (Vec<f64>, Vec<f64>) {
    let (from, to) = range;
    let decades = (to / from).log10();
    let first = from.log10().floor() as i32;
    let last = to.log10().ceil() as i32;
    let inside = |value: &f64| *value >= from * (1.0 - END) && *value <= to * (1.0 + END);
    let at = |factors: &[f64], every: i32| -> Vec<f64> {
        (first..=last)
            .filter(|power| power.rem_euclid(every) == 0)
            .flat_map(|power| {
                factors
                    .iter()
                    .map(move |factor| factor * ten_to(f64::from(power)))
            })
            .filter(inside)
            .collect()
    };
    let few = at(&[1.0, 2.0, 5.0], 1);
    if (2..=count + 1).contains(&few.len()) {
        return (few, at(&[3.0, 4.0, 6.0, 7.0, 8.0, 9.0], 1));
    }
    if few.len() < 2 {
        return (linear_ticks(range, count), Vec::new());
    }
    let every = (decades / count.max(1) as f64).ceil().max(1.0) as i32;
    let minor = if every == 1 {
        at(&[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0], 1)
    } else {
        at(&[1.0], 1)
    };
    (at(&[1.0], every), minor)
}

fn label(values: &[f64], logarithmic: bool, labels: &TickLabels) -> Vec<String> {
    if let TickLabels::Prefixed(unit) = labels {
        return values.iter().map(|value| prefixed(*value, unit)).collect();
    }
    let size = |value: &f64| value.abs();
    let most = values.iter().map(size).fold(0.0, f64::max);
    let least = values
        .iter()
        .map(size)
        .filter(|size| *size > 0.0)
        .fold(f64::INFINITY, f64::min);
    // All labels of an axis in one form.
    let short = most < 1e6 && least >= if logarithmic { 1e-3 } else { 1e-4 };
    values
        .iter()
        .map(|value| {
            if short || *value == 0.0 {
                minus(&value.to_string())
            } else {
                power_of_ten(*value)
            }
        })
        .collect()
}

/// With a minus sign instead of a hyphen.
fn minus(number: &str) -> String {
    number.replace('-', "−")
}

/// 10⁻⁶, 2·10⁻⁶.
fn power_of_ten(value: f64) -> String {
    let text = format!("{value:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text.as_str(), "0"));
    let exponent: String = exponent
        .chars()
        .map(|digit| match digit {
            '-' => '⁻',
            '1' => '¹',
            '2' => '²',
            '3' => '³',
            '0' => '⁰',
            digit => digit
                .to_digit(10)
                .and_then(|d| char::from_u32(0x2070 + d))
                .unwrap_or(digit),
        })
        .collect();
    match mantissa {
        "1" => format!("10{exponent}"),
        "-1" => format!("−10{exponent}"),
        mantissa => format!("{}·10{exponent}", minus(mantissa)),
    }
}

/// 1 µm, 20 ms.
fn prefixed(value: f64, unit: &str) -> String {
    const PREFIXES: [&str; 9] = ["p", "n", "µ", "m", "", "k", "M", "G", "T"];
    if value == 0.0 {
        return format!("0 {unit}");
    }
    let thousands = (value.abs().log10() / 3.0 + END).floor().clamp(-4.0, 4.0) as i32;
    let number = value / 10f64.powi(3 * thousands);
    let number: f64 = format!("{number:.6}").parse().unwrap_or(number);
    let prefix = PREFIXES[(thousands + 4) as usize];
    minus(&format!("{number} {prefix}{unit}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(range: (f64, f64), logarithmic: bool) -> Vec<String> {
        let scale = Scale::new(range, logarithmic, 8, &TickLabels::Number);
        scale.ticks().iter().map(|tick| tick.label.clone()).collect()
    }

    #[test]
    fn ticks_are_round_numbers() {
        assert_eq!(labels((0.0, 200.0), false), ["0", "50", "100", "150", "200"]);
        assert_eq!(labels((-0.3, 0.3), false)[..3], ["−0.3", "−0.2", "−0.1"]);
        assert_eq!(
            labels((1e-3, 1e3), true),
            ["0.001", "0.01", "0.1", "1", "10", "100", "1000"]
        );
        assert_eq!(labels((1e-6, 1e-3), true), ["10⁻⁶", "10⁻⁵", "10⁻⁴", "10⁻³"]);
        assert_eq!(labels((0.5, 6.0), true), ["0.5", "1", "2", "5"]);
        assert_eq!(
            labels((2e-10, 3e-9), true),
            ["2·10⁻¹⁰", "5·10⁻¹⁰", "10⁻⁹", "2·10⁻⁹"]
        );
        // Sixteen decades do not get seventeen labels.
        assert_eq!(
            labels((1e-8, 1e8), true),
            ["10⁻⁸", "10⁻⁶", "10⁻⁴", "10⁻²", "10⁰", "10²", "10⁴", "10⁶", "10⁸"]
        );
    }

    #[test]
    fn prefixes_of_units() {
        assert_eq!(prefixed(1e-6, "m"), "1 µm");
        assert_eq!(prefixed(2e-2, "s"), "20 ms");
        assert_eq!(prefixed(1000.0, "N"), "1 kN");
        assert_eq!(prefixed(0.0, "N"), "0 N");
    }

    #[test]
    fn the_range_holds_the_data_between_round_numbers() {
        let scale = |data, logarithmic| round_range(data, logarithmic, 8);
        assert_eq!(scale((3.0, 187.0), false), (0.0, 200.0));
        assert_eq!(scale((0.003, 7000.0), true), (0.002, 10_000.0));
        assert_eq!(scale((4.0, 4.0), false), (2.0, 6.0));
        assert_eq!(scale((0.0, 0.0), false), (-1.0, 1.0));
        assert_eq!(scale((1e-3, 10.0), true), (1e-3, 10.0));
    }

    #[test]
    fn shares_of_the_axis() {
        let linear = Scale::new((10.0, 30.0), false, 5, &TickLabels::Number);
        assert_eq!(linear.share(15.0), 0.25);
        let logarithmic = Scale::new((1e-2, 1e2), true, 5, &TickLabels::Number);
        assert!((logarithmic.share(1e-1) - 0.25).abs() < 1e-15);
    }
}
