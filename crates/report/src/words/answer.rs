//! A run in words.

use super::number::{count, passes, significant};
use super::reader::Reader;
use creepage_plan::shown::{percent, words_if};
use creepage_run::{
    Limited, Limits, PassRecord, Place, Run, Verdict,
    answer::{HeatRecord, after},
};
use creepage_scene::{CableEnd, DAYS_PER_YEAR, End, Scene};

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

fn fact(name: &'static str, value: String, note: impl Into<String>) -> Fact {
    let note = note.into();
    Fact { name, value, note }
}

/// A force on an end, or within the cable if there is none, and when it acts.
struct Load {
    newtons: f64,
    end: Option<CableEnd>,
    when: &'static str,
}

impl Load {
    fn new(newtons: f64, end: Option<CableEnd>, when: &'static str) -> Self {
        Self { newtons, end, when }
    }

    fn place(&self) -> String {
        self.end
            .map_or("in the cable".into(), |end| format!("on the {} end", end.name()))
    }

    fn named(&self) -> String {
        let what = self.end.map_or("largest compression", |_| "force");
        format!("{what} {}", self.place())
    }

    /// What it does, where that is not what one expects.
    fn tension(&self) -> &'static str {
        words_if(self.newtons < 0.0, ", tension")
    }

    fn fact(&self, name: &'static str, reader: &Reader) -> Fact {
        let note = format!("{}, {}{}", self.place(), self.when, self.tension());
        fact(name, reader.force(self.newtons), note)
    }
}

/// The held end on which such a force is larger in size; `None` if both are free.
fn pressed_end(scene: &Scene, force: impl Fn(CableEnd) -> f64) -> Option<CableEnd> {
    let all = CableEnd::ALL.into_iter();
    let held = all.filter(|end| end.held_in(scene) != End::Free);
    held.max_by(|a, b| force(*a).abs().total_cmp(&force(*b).abs()))
}

impl Answer<'_> {
    /// The most important numbers: six, one of the cable where it bears more than its ends, and one of clamps if there are any.
    pub fn facts(&self) -> Vec<Fact> {
        let Some(last) = self.run.passes.last() else {
            return Vec::new();
        };
        let reader = &self.reader;
        let mut facts = Vec::from(self.forces(last));
        let moved = CableEnd::ALL.map(|end| self.movement(last, end));
        let end = CableEnd::ALL[usize::from(moved[1].abs() >= moved[0].abs())];
        let when = if self.run.heat.is_some() { "in" } else { "after" };
        let note = format!("{} end, {when} {}", end.name(), passes(last.pass));
        facts.push(fact("Movement of an end", reader.movement(end.of(moved)), note));
        let motion = &self.run.duct_motion;
        let [along, down] =
            [motion.peak_longitudinal_m, motion.peak_vertical_m].map(|peak| significant(1e6 * peak) + " µm");
        let down = format!("along its axis; {down} down");
        facts.push(fact("Peak motion of the duct", along, down));
        let error = percent(self.run.error_estimate.relative);
        let note = "of the forces, from the computation alone";
        facts.push(fact("Estimated error", error, note));
        facts.extend(self.inside());
        facts.extend(self.hardest_clamp());
        facts
    }

    /// The three facts about forces.
    fn forces(&self, last: &PassRecord) -> [Fact; 3] {
        let (run, reader) = (self.run, &self.reader);
        let largest = self.hardest();
        let time = |pass| self.scene.traffic.years_after(pass).map(after);
        let traffic = || {
            let note = time(last.pass).map_or("their rate is not known".into(), |time| format!("in {time}"));
            fact("Passes computed", count(last.pass), note)
        };
        if let Some(heat) = &run.heat {
            let day = heat.last_whole(&run.days, last.pass);
            let swing = reader.force(day.map_or(0.0, |day| day.largest_range().0));
            let swing = fact("Swing of the force", swing, "on an end within the last whole day");
            return [largest.fact("Largest force with heat", reader), swing, traffic()];
        }
        let largest = largest.fact("Largest force of all passes", reader);
        let (Some(saturation), Some(level)) = (&run.saturation, self.level()) else {
            let now = self.now(last).fact("Force after the last pass", reader);
            return [now, traffic(), largest];
        };
        let reached = saturation.passes_to_95_percent;
        let time = time(reached).map_or_else(String::new, |time| format!("{time}; "));
        let time = format!("{time}{} computed", count(last.pass));
        let reached = fact("Passes to 95 % of it", count(reached), time);
        [level.fact("Saturation", reader), reached, largest]
    }

    /// The largest force along the cable after the last pass, where it is a twentieth larger than any on an end.
    fn inside(&self) -> Option<Fact> {
        let profile = &self.run.force_profile;
        let along = profile.positions_m.iter().zip(&profile.force_n);
        let (place, force) = along.max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()))?;
        let is_more = self.run.heat.is_none() && force.abs() > 1.05 * self.hardest().newtons.abs();
        let tension = words_if(*force < 0.0, ", tension");
        let place = self.reader.length(*place);
        let note = format!("at {place}, after the last pass{tension}");
        is_more.then(|| fact("Largest force in the cable", self.reader.force(*force), note))
    }

    /// The clamp that is pressed hardest.
    fn hardest_clamp(&self) -> Option<Fact> {
        let force = |position: f64| self.run.largest(Place::Clamp(position), Limited::Force);
        let clamps = self.run.restraints.iter().map(|clamp| clamp.position_m);
        let hardest = clamps.max_by(|a, b| force(*a).total_cmp(&force(*b)))?;
        let note = format!("at {}, {}", self.reader.length(hardest), self.when_on_clamps());
        let force = self.reader.force(force(hardest));
        Some(fact("Largest force on a clamp", force, note))
    }

    /// When clamps bear their largest forces.
    pub fn when_on_clamps(&self) -> &'static str {
        let heat = self.run.heat.as_ref();
        heat.map_or("during a pass", |_| "during a pass or in heat")
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
            let load = self.hardest();
            let (lasting, force) = (counted(last.pass), reader.force(load.newtons));
            let (place, sign) = (load.place(), load.tension());
            return format!("In {lasting} heat and traffic bring up to {force} {place}{sign}.{moved}");
        }
        let load = self.now(last);
        let (passes, force, sign) = (counted(last.pass), reader.force(load.newtons), load.tension());
        let now = format!("After {passes} the {} is {force}{sign}", load.named());
        let (Some(saturation), Some(load)) = (&self.run.saturation, self.level()) else {
            return format!("{now}; {}.{moved}", load.when.replace("where ", ""));
        };
        let (level, place) = (reader.force(load.newtons), load.named());
        let reached = counted(saturation.passes_to_95_percent);
        let that = self.run.random.map_or("that", |_| "the mean");
        if saturation.passes_to_95_percent > last.pass {
            return format!(
                "{now}. It levels off at {level}; 95 % of {that} takes {reached}, more than were computed.{moved}"
            );
        }
        format!("The {place} levels off at {level}. 95 % of {that} is reached after {reached}.{moved}")
    }

    /// Between what forces vehicles that differ let the ends vary, once nothing changes any more.
    pub fn by_turns(&self) -> String {
        let each = self.run.by_turns().into_iter().map(|(end, least, most)| {
            let (least, most) = (self.reader.number(Limited::Force, least), self.reader.force(most));
            format!("that on the {} end between {least} and {most}", end.name())
        });
        let how = words_if(self.run.random.is_some(), ", in nine passes of ten");
        let each = each.reduce(|one, other| format!("{one} and {other}"));
        each.map_or_else(String::new, |each| {
            format!(" In the end the force varies from vehicle to vehicle, {each}{how}.")
        })
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
        let moved = CableEnd::ALL.into_iter().filter_map(of);
        let Some(moved) = moved.reduce(|one, other| format!("{one} and {other}")) else {
            return "Both ends are fixed.".to_owned();
        };
        let is_out = |end| self.movement(last, end).abs() > self.reader.most;
        let is_out = CableEnd::ALL.into_iter().any(is_out);
        let leaves = words_if(is_out, "; the cable leaves the duct");
        format!("{when} {moved}{leaves}.")
    }

    /// Displacement after the last pass; of a heated cable the farthest of all days \[m\].
    fn movement(&self, last: &PassRecord, end: CableEnd) -> f64 {
        let heat = self.run.heat.as_ref();
        heat.map_or(last.displacement(end), |heat| heat.all_days.movement(end))
    }

    /// The force that is largest in size on an end, after passes, during them and in all heat, or in the cable where none bears any.
    fn hardest(&self) -> Load {
        let at_rest = self.run.heat.as_ref();
        let at_rest = at_rest.map_or("after a pass", |_| "in the heat of a day");
        let on_ends = Limits::both(Some(f64::INFINITY), None).verdicts(self.run);
        let hardest = on_ends.into_iter().max_by(|a, b| a.largest.total_cmp(&b.largest));
        if let Some(hardest) = hardest.filter(|hardest| hardest.largest > 0.0) {
            let sign = if hardest.pulled { -1.0 } else { 1.0 };
            let moving = hardest.during_a_pass.then_some("during a pass");
            let (end, when) = (hardest.end.end(), moving.unwrap_or(at_rest));
            return Load::new(sign * hardest.largest, end, when);
        }
        let days = self.run.heat.iter().map(|heat| heat.all_days.max_compression_n);
        let inside = self.run.passes.iter().map(|record| record.max_compression_n);
        Load::new(inside.chain(days).fold(0.0, f64::max), None, at_rest)
    }

    /// The force that matters most after the `last` pass, and why it does not level off.
    fn now(&self, last: &PassRecord) -> Load {
        let end = pressed_end(self.scene, |end| last.force_after(end));
        let newtons = end.map_or(last.max_compression_n, |end| last.force_after(end));
        let when = match self.run.range {
            None => "where it has not levelled off",
            Some(_) if end.is_none() && self.scene.restraints.is_empty() => "where nothing holds it",
            Some(_) => "after a larger one before",
        };
        Load::new(newtons, end, when)
    }

    /// The force that levels off, if one does.
    fn level(&self) -> Option<Load> {
        let level = self.run.saturation?;
        let force = |end: CableEnd| end.of([level.upstream_force_n, level.downstream_force_n]);
        let when = if level.is_beyond(&self.run.passes) {
            "after a pass beyond those computed"
        } else {
            "after a pass"
        };
        Some(Load::new(level.force_n, pressed_end(self.scene, force), when))
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
        let (quantity, units) = (verdict.quantity, &self.reader.units);
        let shown = |value: f64| {
            // Next to its limit a value of four digits may seem to lie on the other side.
            if (value / verdict.limit - 1.0).abs() < 1e-3 {
                quantity.shown_in(units, value)
            } else {
                self.reader.amount(quantity, value)
            }
        };
        verdict.shown_with(units, shown)
    }
}
