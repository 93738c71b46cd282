//! A run in words.

use super::number::{count, passes, significant};
use super::reader::Reader;
use crate::answer::{HeatRecord, after};
use crate::scene::{CableEnd, DAYS_PER_YEAR, End, Scene};
use crate::shown::{percent, words_if};
use crate::{Limited, Limits, PassRecord, Place, Run, Verdict};

/// What one run of a scene says to one reader.
#[derive(Clone, Copy)]
pub struct Answer<'a> {
    pub scene: &'a Scene,
    pub run: &'a Run,
    pub reader: Reader,
}

/// One number that matters: what it is, itself with its unit, and a remark.
pub struct Fact {
    pub name: &'static str,
    pub value: String,
    pub note: String,
}

fn fact(name: &'static str, value: String, note: String) -> Fact {
    Fact { name, value, note }
}

/// Where a force acts: on an end, or within the cable.
type At = Option<CableEnd>;

fn on(place: At) -> String {
    place.map_or("in the cable".into(), |end| format!("on the {} end", end.name()))
}

fn force_of(place: At) -> String {
    place.map_or("largest compression in the cable".into(), |_| {
        format!("force {}", on(place))
    })
}

/// What a force does, where that is not what one expects.
fn tension(force: f64) -> &'static str {
    words_if(force < 0.0, ", tension")
}

/// The held end that is pressed harder after the `last` pass; `None` where both are free.
pub fn pressed_end(scene: &Scene, last: &PassRecord) -> At {
    let force = |end: &CableEnd| last.force_after(*end).abs();
    let held = CableEnd::ALL
        .into_iter()
        .filter(|end| end.held_in(scene) != End::Free);
    held.max_by(|a, b| force(a).total_cmp(&force(b)))
}

impl Answer<'_> {
    /// The most important numbers: six, and one of clamps where there are any.
    pub fn facts(&self) -> Vec<Fact> {
        let Some(last) = self.run.passes.last() else {
            return Vec::new();
        };
        let reader = &self.reader;
        let mut facts = Vec::from(self.forces(last));
        let farther = |end: &CableEnd| self.movement(last, *end).abs();
        let farthest = CableEnd::ALL
            .into_iter()
            .max_by(|a, b| farther(a).total_cmp(&farther(b)));
        if let Some(end) = farthest {
            let when = if self.run.heat.is_some() { "in" } else { "after" };
            let note = format!("{} end, {when} {}", end.name(), passes(last.pass));
            facts.push(fact(
                "Movement of an end",
                reader.movement(self.movement(last, end)),
                note,
            ));
        }
        let motion = &self.run.duct_motion;
        let [along, down] =
            [motion.peak_longitudinal_m, motion.peak_vertical_m].map(|peak| significant(1e6 * peak) + " µm");
        let down = format!("along its axis; {down} down");
        facts.push(fact("Peak motion of the duct", along, down));
        let error = percent(self.run.error_estimate.relative);
        let note = "of the forces, from the computation alone".to_owned();
        facts.push(fact("Estimated error", error, note));
        facts.extend(self.hardest_clamp());
        facts
    }

    /// The three facts about forces.
    fn forces(&self, last: &PassRecord) -> [Fact; 3] {
        let (run, reader) = (self.run, &self.reader);
        let (largest, place, when) = self.hardest();
        let time = |pass| self.scene.traffic.years_after(pass).map(after);
        let traffic = || {
            let note = time(last.pass).map_or("their rate is not known".into(), |time| format!("in {time}"));
            fact("Passes computed", count(last.pass), note)
        };
        let note = format!("{}, {when}{}", on(place), tension(largest));
        if let Some(heat) = &run.heat {
            let day = heat.last_whole(&run.days, last.pass);
            let swing = day.map_or(0.0, |day| day.largest_range().0);
            let within = "on an end within the last whole day".to_owned();
            return [
                fact("Largest force with heat", reader.force(largest), note),
                fact("Swing of the force", reader.force(swing), within),
                traffic(),
            ];
        }
        let largest = fact("Largest force of all passes", reader.force(largest), note);
        let Some(saturation) = &run.saturation else {
            let (force, place) = self.pressed(last);
            let note = format!("{}{}; it {}", on(place), tension(force), self.not_level());
            return [
                fact("Force after the last pass", reader.force(force), note),
                traffic(),
                largest,
            ];
        };
        let later = words_if(saturation.is_beyond(&run.passes), " beyond those computed");
        let sign = tension(saturation.force_n);
        let note = format!("{}, after a pass{later}{sign}", on(self.level_at()));
        let reached = saturation.passes_to_95_percent;
        let time = time(reached).map_or_else(String::new, |time| format!("{time}; "));
        let time = format!("{time}{} computed", count(last.pass));
        [
            fact("Saturated force", reader.force(saturation.force_n), note),
            fact("Passes to 95 % of it", count(reached), time),
            largest,
        ]
    }

    /// The clamp that is pressed hardest.
    fn hardest_clamp(&self) -> Option<Fact> {
        let force = |position: f64| self.run.largest(Place::Clamp(position), Limited::Force);
        let clamps = self.run.restraints.iter().map(|clamp| clamp.position_m);
        let hardest = clamps.max_by(|a, b| force(*a).total_cmp(&force(*b)))?;
        let note = format!("at {}, {}", self.reader.length(hardest), self.when_on_clamps());
        Some(fact(
            "Largest force on a clamp",
            self.reader.force(force(hardest)),
            note,
        ))
    }

    /// When clamps bear their largest forces.
    pub fn when_on_clamps(&self) -> &'static str {
        let heat = self.run.heat.is_some();
        if heat {
            "during a pass or in heat"
        } else {
            "during a pass"
        }
    }

    /// The answer in sentences.
    pub fn sentences(&self) -> String {
        let Some(last) = self.run.passes.last() else {
            return String::new();
        };
        let reader = &self.reader;
        let counted = |pass: u64| {
            let time = self.scene.traffic.years_after(pass).map(after);
            passes(pass) + &time.map_or_else(String::new, |time| format!(" ({time})"))
        };
        let moved = format!("{} {}", self.by_turns(), self.moved(last));
        if self.run.heat.is_some() {
            let (force, place, _) = self.hardest();
            let (force, sign) = (reader.force(force), tension(force));
            let lasting = counted(last.pass);
            return format!(
                "In {lasting} heat and traffic bring up to {force} {}{sign}.{moved}",
                on(place)
            );
        }
        let (force, place) = self.pressed(last);
        let (place, amount) = (force_of(place), reader.force(force));
        let now = format!(
            "After {} the {place} is {amount}{}",
            counted(last.pass),
            tension(force)
        );
        let Some(saturation) = &self.run.saturation else {
            return format!("{now}; it {}.{moved}", self.not_level());
        };
        let level = reader.force(saturation.force_n);
        let reached = counted(saturation.passes_to_95_percent);
        let random = self.run.random.is_some();
        let that = if random { "the mean" } else { "that" };
        if saturation.passes_to_95_percent > last.pass {
            return format!(
                "{now}. It levels off at {level}; 95 % of {that} takes {reached}, more than were computed.{moved}"
            );
        }
        let place = force_of(self.level_at());
        format!("The {place} levels off at {level}. 95 % of {that} is reached after {reached}.{moved}")
    }

    /// Why there is no force that levels off.
    fn not_level(&self) -> &'static str {
        self.run
            .range
            .map_or("has not levelled off", |_| "was larger before")
    }

    /// What vehicles that differ leave by turns, once nothing changes any more.
    pub fn by_turns(&self) -> String {
        let each = self.run.by_turns().into_iter().map(|(end, least, most)| {
            let (least, most) = (self.reader.number(Limited::Force, least), self.reader.force(most));
            format!("the {} end shows {least} to {most}", end.name())
        });
        let each: Vec<String> = each.collect();
        if each.is_empty() {
            return String::new();
        }
        let how = match self.run.random {
            Some(_) => "in nine passes of ten",
            None => "after passes by turns",
        };
        format!(" In the end {} {how}, as vehicles differ.", each.join(" and "))
    }

    /// How far both ends have moved.
    fn moved(&self, last: &PassRecord) -> String {
        let (moves, when) = match self.run.heat {
            Some(_) => ("moves by up to", "Over all days"),
            None => ("has moved", "After the last pass computed"),
        };
        let of = |end: CableEnd| {
            let held = end.held_in(self.scene);
            let free = words_if(held == End::Free, "free ");
            let moved = self.reader.movement(self.movement(last, end).abs());
            let moved = moved.replace("> ", "more than ");
            (held != End::Fixed).then(|| format!("the {free}{} end {moves} {moved}", end.name()))
        };
        let moved: Vec<String> = CableEnd::ALL.into_iter().filter_map(of).collect();
        if moved.is_empty() {
            return "Both ends are fixed.".to_owned();
        }
        let is_out = |end| self.movement(last, end).abs() > self.reader.most;
        let is_out = CableEnd::ALL.into_iter().any(is_out);
        let leaves = words_if(is_out, "; the cable leaves the duct");
        format!("{when} {}{leaves}.", moved.join(" and "))
    }

    /// Displacement after the last pass; of a heated cable the farthest of all days \[m\].
    fn movement(&self, last: &PassRecord, end: CableEnd) -> f64 {
        let heat = self.run.heat.as_ref();
        heat.map_or(last.displacement(end), |heat| heat.all_days.movement(end))
    }

    /// The force that is largest in size on an end, after passes, during them and in all heat, or in the cable where none bears any; and when.
    fn hardest(&self) -> (f64, At, &'static str) {
        let at_rest = if self.run.heat.is_some() {
            "in the heat of a day"
        } else {
            "after a pass"
        };
        let on_ends = Limits::both(Some(f64::INFINITY), None).verdicts(self.run);
        let hardest = on_ends.into_iter().max_by(|a, b| a.largest.total_cmp(&b.largest));
        if let Some(end) = hardest.filter(|hardest| hardest.largest > 0.0) {
            let force = if end.pulled { -end.largest } else { end.largest };
            let when = if end.during_a_pass {
                "during a pass"
            } else {
                at_rest
            };
            return (force, end.end.end(), when);
        }
        let days = self.run.heat.iter().map(|heat| heat.all_days.max_compression_n);
        let inside = self.run.passes.iter().map(|record| record.max_compression_n);
        (inside.chain(days).fold(0.0, f64::max), None, at_rest)
    }

    /// The force that matters most after a pass.
    fn pressed(&self, last: &PassRecord) -> (f64, At) {
        let end = pressed_end(self.scene, last);
        (
            end.map_or(last.max_compression_n, |end| last.force_after(end)),
            end,
        )
    }

    /// Where the force acts that levels off.
    fn level_at(&self) -> At {
        let level = self.run.saturation?;
        let ends = [level.upstream_force_n, level.downstream_force_n];
        let held = CableEnd::ALL
            .into_iter()
            .filter(|end| end.held_in(self.scene) != End::Free);
        held.max_by(|a, b| a.of(ends).abs().total_cmp(&b.of(ends).abs()))
    }

    /// What heat does in the end; nothing of a cable that is not heated.
    pub fn heat(&self) -> Option<String> {
        let record: &HeatRecord = self.run.heat.as_ref()?;
        let whole = record.last_whole(&self.run.days, self.scene.traffic.passes)?;
        let (force, movement) = whole.largest_range();
        let lasting = match (record.periodic_from_day, record.drift_per_day_m) {
            (Some(day), Some(drift)) if drift != 0.0 => format!(
                "From day {} on every day is like the one before, but the cable moves on by {} a day, {} a year.",
                count(day),
                self.reader.movement(drift),
                self.reader.length(DAYS_PER_YEAR * drift)
            ),
            (Some(day), _) => format!("From day {} on every day is like the one before.", count(day)),
            _ => "At the end days still differ from the ones before.".to_owned(),
        };
        Some(format!(
            "{lasting} On the last whole day the force on an end changes by up to {} and an end moves by up to {}, to and fro: the load of \
             joints that counts for fatigue.",
            self.reader.force(force),
            self.reader.movement(movement)
        ))
    }

    /// Whether a limit is kept, and in what words.
    pub fn verdict(&self, verdict: &Verdict) -> String {
        let shown = |value| self.reader.amount(verdict.quantity, value);
        verdict.shown_with(&self.reader.units, shown)
    }
}
