//! A pass of a day from the events around it.

use super::day::{Act, Event};

/// One summand of the outcome of a pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// Place of an event of the day.
    pub place: usize,
    pub weight: f64,
    /// Whether only the cable at rest after it counts, without peaks and heat during it.
    pub at_rest: bool,
}

/// How the outcome of `pass`, from 1, of a day follows from those of its `events`, where so many
/// passes are a `period`; nothing of a pass that does not come. Within a step the cable goes
/// straight from one end to the other, and a pass does relative to that what the same one of the
/// nearest simulated period did.
pub fn parts(events: &[Event], pass: u64, period: u64) -> Vec<Part> {
    let part = |place: usize, weight: f64, at_rest: bool| Part {
        place,
        weight,
        at_rest,
    };
    let passed = |passes: u64| {
        let is_it = |event: &Event| matches!(event.act, Act::Pass(_)) && event.passes == passes;
        events.iter().position(is_it)
    };
    if let Some(simulated) = passed(pass) {
        return vec![part(simulated, 1.0, false)];
    }
    let is_step = |event: &Event| matches!(event.act, Act::Step(..));
    let step = events
        .iter()
        .position(|event| is_step(event) && event.passes >= pass);
    let Some(to) = step.filter(|to| *to > 0) else {
        return Vec::new();
    };
    let from = to - 1;
    let share = (pass - events[from].passes) as f64 / (events[to].passes - events[from].passes) as f64;
    // The period after the step where that is nearer and whole, or the one before it.
    let done = (pass - 1) % period + 1;
    let after = events[to..].iter().position(|event| event.begins);
    let after = after.filter(|_| is_step(&events[from])).map(|place| to + place);
    let before = events[..to].iter().rposition(|event| event.begins);
    let shown = |begin: usize| {
        let passes = events[begin].passes;
        Some((
            begin.saturating_sub(1),
            passed(passes + done)?,
            passed(passes + period)?,
        ))
    };
    let Some((begin, like, end)) = after.and_then(shown).or_else(|| before.and_then(shown)) else {
        return Vec::new();
    };
    let done = done as f64 / period as f64;
    vec![
        part(from, 1.0 - share, true),
        part(to, share, true),
        part(begin, done - 1.0, true),
        part(end, -done, true),
        part(like, 1.0, false),
    ]
}
