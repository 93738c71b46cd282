//! Numbers to places along an axis, and the ticks that stand there.

/// A value and its label.
pub(crate) type Tick = (f64, String);

/// A range of numbers, or of cells, laid along an axis.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    range: (f64, f64),
    logarithmic: bool,
    pub ticks: Vec<Tick>,
}

/// Tolerance for ticks on the ends of a range, as a share of the step between ticks.
const END: f64 = 1e-6;

impl Scale {
    /// Exactly `range`, with about `count` ticks inside. The range is finite, ascending, and positive if logarithmic.
    pub fn new(range: (f64, f64), logarithmic: bool, count: usize) -> Self {
        let values = if logarithmic {
            logarithmic_ticks(range, count)
        } else {
            linear_ticks(range, count)
        };
        Self {
            range,
            logarithmic,
            ticks: labelled(&values, logarithmic),
        }
    }

    /// These ticks in place of its own, as far as they lie inside.
    pub fn with_ticks(mut self, ticks: &[Tick]) -> Self {
        let is_inside = |tick: &&Tick| (0.0..=1.0).contains(&self.share(tick.0));
        self.ticks = ticks.iter().filter(is_inside).cloned().collect();
        self
    }

    /// 0 at the start of the axis, 1 at its end; below and above beyond them.
    pub fn share(&self, value: f64) -> f64 {
        let (from, to) = self.range;
        if self.logarithmic {
            (value / from).ln() / (to / from).ln()
        } else {
            (value - from) / (to - from)
        }
    }
}

/// Share of numbers below which they differ by rounding alone.
const SAME: f64 = 1e-9;

/// `data`, its least and its largest number, with round numbers at both ends.
pub(crate) fn round_range((low, high): (f64, f64), logarithmic: bool, count: usize) -> (f64, f64) {
    // Numbers that differ by their rounding are one number: no label has room for what tells them apart.
    let same = low == high || (low < high && high - low < SAME * low.abs().max(high.abs()));
    if logarithmic {
        let wider = if same { 3.0 } else { 1.0 };
        // The reciprocals of round numbers are round.
        return (1.0 / round_up(wider / low), round_up(high * wider));
    }
    let (low, high) = match (same, low) {
        (true, 0.0) => (-1.0, 1.0),
        (true, value) => (value - 0.5 * value.abs(), value + 0.5 * value.abs()),
        _ => (low, high),
    };
    let step = linear_step((low, high), count);
    let (first, last) = ((low / step + END).floor(), (high / step - END).ceil());
    (first * step, last * step)
}

/// 1, 2 or 5 times a power of ten, for about `count` steps over the range.
fn linear_step((from, to): (f64, f64), count: usize) -> f64 {
    round_up((to - from) / count.max(1) as f64)
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

/// Smallest 1, 2 or 5 times a power of ten that is not below `value`.
fn round_up(value: f64) -> f64 {
    let power = value.log10().floor();
    let mut numbers = [1.0, 2.0, 5.0].map(|factor| factor * ten_to(power)).into_iter();
    let found = numbers.find(|round| *round >= value * (1.0 - END));
    found.unwrap_or(ten_to(power + 1.0))
}

/// A power of ten to the last digit.
fn ten_to(power: f64) -> f64 {
    format!("1e{power}").parse().unwrap_or(f64::NAN)
}

/// Ticks of a logarithmic axis: at 1, 2 and 5 times powers of ten where that makes few, or every so many decades.
fn logarithmic_ticks(range: (f64, f64), count: usize) -> Vec<f64> {
    let (from, to) = range;
    let (first, last) = (from.log10().floor() as i32, to.log10().ceil() as i32);
    let inside = |value: &f64| *value >= from * (1.0 - END) && *value <= to * (1.0 + END);
    let at = |factors: &[f64], every: i32| -> Vec<f64> {
        let powers = (first..=last).filter(|power| power.rem_euclid(every) == 0);
        let powers = powers.map(|power| ten_to(f64::from(power)));
        let numbers = powers.flat_map(|power| factors.iter().map(move |factor| factor * power));
        numbers.filter(inside).collect()
    };
    let few = at(&[1.0, 2.0, 5.0], 1);
    match few.len() {
        0..2 => linear_ticks(range, count),
        found if found <= count + 1 => few,
        _ => {
            let decades = (to / from).log10() / count.max(1) as f64;
            at(&[1.0], decades.ceil().max(1.0) as i32)
        }
    }
}

/// Ticks with labels, all in one form.
fn labelled(values: &[f64], logarithmic: bool) -> Vec<Tick> {
    let least = if logarithmic { 1e-3 } else { 1e-4 };
    let is_short = |value: &f64| *value == 0.0 || (least..1e6).contains(&value.abs());
    let short = values.iter().all(is_short);
    let label = |value: f64| match value {
        _ if short || value == 0.0 => value.to_string(),
        _ => power_of_ten(value),
    };
    // With a minus sign instead of a hyphen.
    let tick = |value: &f64| (*value, label(*value).replace('-', "−"));
    values.iter().map(tick).collect()
}

/// 10⁻⁶, 2·10⁻⁶.
fn power_of_ten(value: f64) -> String {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let text = format!("{value:e}");
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text.as_str(), "0"));
    let raised = |digit: char| digit.to_digit(10).map_or('⁻', |digit| RAISED[digit as usize]);
    let exponent: String = exponent.chars().map(raised).collect();
    match mantissa {
        "1" => format!("10{exponent}"),
        "-1" => format!("-10{exponent}"),
        mantissa => format!("{mantissa}·10{exponent}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(range: (f64, f64), logarithmic: bool) -> Vec<String> {
        let scale = Scale::new(range, logarithmic, 8);
        scale.ticks.into_iter().map(|(_, label)| label).collect()
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
    fn the_range_holds_the_data_between_round_numbers() {
        let scale = |data, logarithmic| round_range(data, logarithmic, 8);
        assert_eq!(scale((3.0, 187.0), false), (0.0, 200.0));
        assert_eq!(scale((0.003, 7000.0), true), (0.002, 10_000.0));
        assert_eq!(scale((4.0, 4.0), false), (2.0, 6.0));
        assert_eq!(scale((4.0, 4.0 + 1e-15), false), (2.0, 6.0));
        assert_eq!(scale((-4.0 - 1e-15, -4.0), false), (-6.0, -2.0));
        assert_eq!(scale((4.0, 4.0 + 1e-15), true), scale((4.0, 4.0), true));
        assert_eq!(scale((0.0, 0.0), false), (-1.0, 1.0));
        assert_eq!(scale((1e-3, 10.0), true), (1e-3, 10.0));
    }

    #[test]
    fn shares_of_the_axis() {
        let linear = Scale::new((10.0, 30.0), false, 5);
        assert_eq!(linear.share(15.0), 0.25);
        let logarithmic = Scale::new((1e-2, 1e2), true, 5);
        assert!((logarithmic.share(1e-1) - 0.25).abs() < 1e-15);
    }
}
