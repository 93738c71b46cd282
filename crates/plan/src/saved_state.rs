//! The state that a run leaves behind, with which another run goes on: other traffic, more clamps,
//! other ends.

use cable_dem::{CableError, CableState, DuctedCable, Mesh, RestingCable, Restraint, carried};
use serde::{Deserialize, Serialize};

use crate::cable::cable;
use crate::error::Error;
use crate::hash::fnv1a;
use creepage_scene::{CableEnd, Scene};

/// Version of what is written.
const VERSION: u32 = 1;
/// Values nearer than this are the same, as a share of them.
const SAME: f64 = 1e-9;

/// The cable as a run has left it, and the duct that it lies in.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedState {
    version: u32,
    /// Passes so far, of all runs.
    passes: u64,
    /// What must agree with the scene of the next run.
    duct: Vec<Value>,
    /// Of [`Self::duct`].
    hash: u64,
    ends: [SavedEnd; 2],
    clamps: Vec<SavedClamp>,
    cable: CableState,
    /// Of all runs.
    history: Vec<PastPass>,
}

/// What a pass of an earlier run has left.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PastPass {
    /// Its number, over all runs.
    pub pass: u64,
    /// Days until then, if the vehicles a day of all runs are known.
    pub days: Option<f64>,
    /// Force on the upstream and on the downstream end \[N\].
    pub force_n: [f64; 2],
    /// Displacement of the upstream and of the downstream end \[m\].
    pub displacement_m: [f64; 2],
}

#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Value {
    key: String,
    value: f64,
}

/// How an end is held: a spring \[N/m\], none if it is fixed; and where it stands, or its spring
/// bears nothing \[m\].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct SavedEnd {
    stiffness_n_per_m: Option<f64>,
    position_m: f64,
}

/// A clamp, and where the cable bears nothing on it: as far from where it was laid as it has
/// slipped, and as the cable had moved there when the clamp was put on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[allow(clippy::struct_field_names, reason = "units stand in the names")]
struct SavedClamp {
    position_m: f64,
    stiffness_n_per_m: f64,
    slipped_m: f64,
    put_on_m: f64,
}

impl SavedClamp {
    fn is(&self, clamp: &Restraint) -> bool {
        let is_there = (self.position_m - clamp.position).abs() < SAME * (1.0 + clamp.position);
        is_there && same(self.stiffness_n_per_m, clamp.stiffness)
    }
}

/// What of a scene must agree.
fn duct(scene: &Scene) -> Vec<Value> {
    let whole = [
        ("duct.length", scene.duct.length),
        ("cable.axial_stiffness", scene.cable.axial_stiffness),
        ("cable.weight", scene.cable.weight),
    ];
    let whole = whole.map(|(key, value)| (key.to_owned(), value)).into_iter();
    let sections = (1..).zip(scene.sections()).flat_map(|(number, section)| {
        let of = [
            ("length", section.length),
            ("friction", section.limit),
            ("weight along it", section.body_force),
            ("bend", section.bend),
        ];
        of.map(|(key, value)| (format!("{key} of section {number}"), value))
    });
    let value = |(key, value)| Value { key, value };
    whole.chain(sections).map(value).collect()
}

/// Of the values and their names.
fn hash(duct: &[Value]) -> u64 {
    let bytes = |value: &Value| [value.key.as_bytes(), &value.value.to_bits().to_le_bytes()].concat();
    fnv1a(duct.iter().flat_map(bytes))
}

fn same(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= SAME * a.abs().max(b.abs())
}

impl SavedState {
    /// The cable of `scene` as `state`, with what its `passes` have left, after the runs `before`
    /// it.
    pub fn new(
        scene: &Scene,
        cable: &DuctedCable,
        state: &CableState,
        before: Option<&Self>,
        passes: Vec<PastPass>,
    ) -> Self {
        let duct = duct(scene);
        let position = cable.end_positions();
        let ends = [(cable.upstream(), position[0]), (cable.downstream(), position[1])];
        let clamps = cable.restraints().iter().zip(state.clamp_slips(cable));
        let first = before.map_or(0, Self::passes);
        let mut history = before.map_or(Vec::new(), |before| before.history.clone());
        let begin = before.map_or(Some(0.0), |_| history.last().and_then(|last| last.days));
        history.extend(passes.into_iter().map(|past| PastPass {
            pass: first + past.pass,
            days: begin.zip(past.days).map(|(begin, days)| begin + days),
            ..past
        }));
        Self {
            version: VERSION,
            passes: first + scene.traffic.passes,
            history,
            hash: hash(&duct),
            duct,
            ends: ends.map(|(end, position_m)| SavedEnd {
                stiffness_n_per_m: end.stiffness(),
                position_m,
            }),
            clamps: clamps
                .map(|(clamp, slipped_m)| SavedClamp {
                    position_m: clamp.position,
                    stiffness_n_per_m: clamp.stiffness,
                    slipped_m,
                    put_on_m: before.map_or(0.0, |before| before.put_on(clamp)),
                })
                .collect(),
            cable: state.clone(),
        }
    }

    /// Passes so far, of all runs.
    pub fn passes(&self) -> u64 {
        self.passes
    }

    /// What passes of all runs have left, those that a long run lists.
    pub fn history(&self) -> &[PastPass] {
        &self.history
    }

    /// Refuses a state of another duct, or one that was changed.
    ///
    /// # Errors
    ///
    /// [`Error`] with what does not agree.
    pub fn check(&self, scene: &Scene) -> Result<(), Error> {
        let here = duct(scene);
        let mut values = self.duct.iter().zip(&here);
        let differs = values.find(|(one, other)| !same(one.value, other.value));
        let reason = if self.version != VERSION {
            let version = self.version;
            format!("its version is {version}, and this program knows {VERSION}")
        } else if self.hash != hash(&self.duct) {
            "it was changed after it was written".to_owned()
        } else if scene.friction_limit() == 0.0 {
            "without friction a cable goes back to where it was laid".to_owned()
        } else if here.len() != self.duct.len() {
            "its duct has another number of sections".to_owned()
        } else if let Some((Value { key, value }, other)) = differs {
            let other = other.value;
            format!("its {key} is {value}, and that of the scene {other}")
        } else {
            let _ = self.cable.element_forces(&cable(scene)?)?;
            return Ok(());
        };
        Err(Error::State { reason })
    }

    /// Displacement of the cable at `position` \[m\].
    fn displacement(&self, position: f64) -> f64 {
        let u = self.cable.displacement();
        let place = (position / self.cable.node_spacing()).clamp(0.0, (u.len() - 1) as f64);
        let left = (place.floor() as usize).min(u.len() - 2);
        u[left] + (place - left as f64) * (u[left + 1] - u[left])
    }

    /// The clamp that was there, or a new one, which bears nothing as yet.
    fn clamp(&self, clamp: &Restraint) -> SavedClamp {
        let known = self.clamps.iter().find(|saved| saved.is(clamp));
        known.copied().unwrap_or_else(|| {
            let moved = self.displacement(clamp.position);
            SavedClamp {
                position_m: clamp.position,
                stiffness_n_per_m: clamp.stiffness,
                slipped_m: moved,
                put_on_m: moved,
            }
        })
    }

    /// How far the cable had moved there when this clamp was put on, now or before \[m\].
    pub fn put_on(&self, clamp: &Restraint) -> f64 {
        self.clamp(clamp).put_on_m
    }

    /// The cable of `scene`, held where this state has it.
    ///
    /// # Errors
    ///
    /// [`CableError`] if the scene is not valid.
    pub fn cable(&self, scene: &Scene) -> Result<DuctedCable, CableError> {
        let positions = CableEnd::ALL.map(|end| {
            let saved = end.of(self.ends);
            let springs = [end.held_in(scene).stiffness(), saved.stiffness_n_per_m];
            let is_it = match springs {
                [Some(spring), Some(saved)] => same(spring, saved),
                springs => springs == [None, None],
            };
            let moved = self.displacement(end.of([0.0, scene.duct.length]));
            if is_it { saved.position_m } else { moved }
        });
        cable(scene)?.with_end_positions(positions)
    }

    /// The cable of `scene` on `mesh` at rest in this state, with what it finds there.
    ///
    /// # Errors
    ///
    /// [`CableError`] if the state is not one of this cable.
    pub fn on(&self, scene: &Scene, mesh: &Mesh) -> Result<CableState, CableError> {
        let cable = self.cable(scene)?;
        let mut state = carried(&self.cable, mesh)?;
        let mut clamps = self.clamps.iter().zip(&scene.restraints);
        let is_the_same = *state.displacement() == *self.cable.displacement()
            && self.clamps.len() == scene.restraints.len()
            && clamps.all(|(saved, clamp)| saved.is(clamp));
        if !is_the_same {
            let slips = scene.restraints.iter();
            let slips = slips.map(|clamp| [self.clamp(clamp).slipped_m; 2]);
            state = state.with_clamp_slips(slips.collect())?;
        }
        if !cable.friction().law().has_memory() {
            return Ok(state);
        }
        let mut resting = RestingCable::new(&cable, mesh)?;
        if scene.warming().is_none() && state.thermal_force() != 0.0 {
            resting.warm(&mut state, 0.0)?;
        }
        resting.settle(&mut state)?;
        Ok(state)
    }
}
