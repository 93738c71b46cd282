//! The state that a run leaves behind, with which another run goes on: other traffic, more clamps,
//! other ends.

use cable_dem::{CableError, CableState, DuctedCable, End, Mesh, RestingCable, Restraint, carried};
use serde::{Deserialize, Serialize};

use crate::Error;
use crate::cable::cable;
use crate::hash::fnv1a;
use crate::scene::Scene;

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

/// What must agree.
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

/// What `passes` of one run have left, behind those of the runs `before` it.
fn history(before: Option<&SavedState>, passes: Vec<PastPass>) -> Vec<PastPass> {
    let mut history = before.map_or(Vec::new(), |before| before.history.clone());
    let first = before.map_or(0, SavedState::passes);
    let begin = match before {
        None => Some(0.0),
        Some(_) => history.last().and_then(|last| last.days),
    };
    history.extend(passes.into_iter().map(|past| PastPass {
        pass: first + past.pass,
        days: begin.zip(past.days).map(|(begin, days)| begin + days),
        ..past
    }));
    history
}

impl SavedClamp {
    fn is(&self, clamp: &Restraint) -> bool {
        let is_there = (self.position_m - clamp.position).abs() < SAME * (1.0 + clamp.position);
        is_there && same(self.stiffness_n_per_m, clamp.stiffness)
    }
}

/// What of a scene must agree.
fn duct(scene: &Scene) -> Vec<Value> {
    let value = |key: &str, value: f64| Value {
        key: key.to_owned(),
        value,
    };
    let mut duct = vec![
        value("duct.length", scene.duct.length),
        value("cable.axial_stiffness", scene.cable.axial_stiffness),
        value("cable.weight", scene.cable.weight),
    ];
    for (index, section) in scene.sections().into_iter().enumerate() {
        let of = [
            ("length", section.length),
            ("friction", section.limit),
            ("weight along it", section.body_force),
            ("bend", section.bend),
        ];
        duct.extend(of.map(|(key, of)| value(&format!("{key} of section {}", index + 1), of)));
    }
    duct
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
    /// The cable of `scene` as `state`, with what its passes have left, after the runs `before` it.
    pub(crate) fn new(
        scene: &Scene,
        cable: &DuctedCable,
        state: &CableState,
        before: Option<&Self>,
        past: Vec<PastPass>,
    ) -> Self {
        let duct = duct(scene);
        let ends = [cable.upstream(), cable.downstream()]
            .into_iter()
            .zip(cable.end_positions());
        let ends: Vec<SavedEnd> = ends
            .map(|(end, position_m)| SavedEnd {
                stiffness_n_per_m: end.stiffness(),
                position_m,
            })
            .collect();
        let clamps = cable.restraints().iter().zip(state.clamp_slips(cable));
        Self {
            version: VERSION,
            passes: before.map_or(0, Self::passes) + scene.traffic.passes,
            history: history(before, past),
            hash: hash(&duct),
            duct,
            ends: [ends[0], ends[1]],
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
    pub(crate) fn check(&self, scene: &Scene) -> Result<(), Error> {
        let refused = |reason: String| Error::State { reason };
        if self.version != VERSION {
            return Err(refused(format!(
                "its version is {}, and this program knows {VERSION}",
                self.version
            )));
        }
        if self.hash != hash(&self.duct) {
            return Err(refused("it was changed after it was written".to_owned()));
        }
        if scene.friction_limit() == 0.0 {
            return Err(refused(
                "without friction a cable goes back to where it was laid".to_owned(),
            ));
        }
        let here = duct(scene);
        if here.len() != self.duct.len() {
            return Err(refused("its duct has another number of sections".to_owned()));
        }
        let differs = self
            .duct
            .iter()
            .zip(&here)
            .find(|(one, other)| !same(one.value, other.value));
        if let Some((one, other)) = differs {
            let Value { key, value } = one;
            return Err(refused(format!(
                "its {key} is {value}, and that of the scene {}",
                other.value
            )));
        }
        let _ = self.cable.element_forces(&cable(scene)?)?;
        Ok(())
    }

    /// Displacement of the cable at `position` \[m\].
    fn displacement(&self, position: f64) -> f64 {
        let u = self.cable.displacement();
        let place = (position / self.cable.node_spacing()).clamp(0.0, (u.len() - 1) as f64);
        let left = (place.floor() as usize).min(u.len() - 2);
        u[left] + (place - left as f64) * (u[left + 1] - u[left])
    }

    /// Whether the scene has this state's clamps and no others, in their order.
    fn has_clamps_of(&self, scene: &Scene) -> bool {
        let pairs = || self.clamps.iter().zip(&scene.restraints);
        self.clamps.len() == scene.restraints.len() && pairs().all(|(saved, clamp)| saved.is(clamp))
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
    pub(crate) fn put_on(&self, clamp: &Restraint) -> f64 {
        self.clamp(clamp).put_on_m
    }

    /// The cable of `scene`, held where this state has it.
    pub(crate) fn cable(&self, scene: &Scene) -> Result<DuctedCable, CableError> {
        let ends: [(End, f64); 2] = [
            (scene.ends.upstream, 0.0),
            (scene.ends.downstream, scene.duct.length),
        ];
        let positions = [0, 1].map(|k| {
            let (end, place) = ends[k];
            let saved = self.ends[k];
            let is_it = match (end.stiffness(), saved.stiffness_n_per_m) {
                (Some(spring), Some(saved)) => same(spring, saved),
                (None, None) => true,
                _ => false,
            };
            if is_it {
                saved.position_m
            } else {
                self.displacement(place)
            }
        });
        cable(scene)?.with_end_positions(positions)
    }

    /// The cable of `scene` on `mesh` at rest in this state, with what it finds there.
    pub(crate) fn on(&self, scene: &Scene, mesh: &Mesh) -> Result<CableState, CableError> {
        let cable = self.cable(scene)?;
        let mut state = carried(&self.cable, mesh)?;
        let is_same_mesh = *state.displacement() == *self.cable.displacement();
        if !(is_same_mesh && self.has_clamps_of(scene)) {
            let slips = scene
                .restraints
                .iter()
                .map(|clamp| [self.clamp(clamp).slipped_m; 2]);
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
