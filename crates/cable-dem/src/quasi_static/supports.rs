//! Ends and clamps while the vehicle passes: their loads, and where they stand, in the adherent frame.
//!
//! The cable around each of them is solved where it is out of balance, which a vehicle far away hardly puts it. Solved at every step,
//! three lanes take 1.2 times the node updates, and three clamps 1.3 times. As long as it sticks its answer has always the same shape,
//! which is known beforehand: without that three lanes take 1.25 times as long.

use friction_chain::{Chain, Contact, ImplicitStep, Stretch, Trial};

use super::passage::Snapshot;
use super::window::WindowBounds;
use crate::fixed_end_friction::FixedEndFriction;
use crate::{DuctedCable, Mesh};

/// All supports of a cable.
#[derive(Debug, Clone)]
pub(super) struct Supports {
    /// Ends that move, with the stiffness of their springs \[N/m\].
    ends: Vec<(usize, f64)>,
    /// Ends that do not, and where they stand \[m\].
    fixed: Vec<(usize, f64)>,
    /// Friction law of fixed nodes.
    law: FixedEndFriction,
    pub each: Vec<Support>,
    /// Loads in the adherent frame \[N\] by node: those of the supports, and the cable's own along the duct.
    pub load: Vec<f64>,
    /// The latter alone.
    body: Vec<f64>,
}

/// One support.
#[derive(Debug, Clone)]
pub(super) struct Support {
    /// Its node, or the free one beside it.
    pub node: usize,
    /// The least window around it.
    pub window: Stretch,
    /// How the window answers a force of 1 N on the node as long as it sticks ([`Chain::stuck_response`]).
    response: [Vec<f64>; 2],
}

impl Supports {
    /// Those of `cable` on `mesh`.
    pub fn new(cable: &DuctedCable, mesh: &Mesh, chain: &Chain, bounds: WindowBounds) -> Self {
        let body = cable.loads(mesh, 0.0);
        let last = mesh.elements();
        let (mut ends, mut fixed) = (Vec::new(), Vec::new());
        let held = [(0, cable.upstream()), (last, cable.downstream())];
        for ((node, end), position) in held.into_iter().zip(cable.end_positions()) {
            match end.stiffness() {
                Some(spring) => ends.push((node, spring)),
                None => fixed.push((node, position)),
            }
        }
        let nodes = [0, last]
            .into_iter()
            .chain(chain.clamps().iter().map(|clamp| clamp.node));
        let around = |node: usize| {
            let node = node.clamp(bounds.free.lo, bounds.free.hi);
            let window = bounds.widened(Stretch { lo: node, hi: node }, bounds.margin);
            Support {
                node,
                window,
                response: chain.stuck_response(window, node),
            }
        };
        Self {
            ends,
            fixed,
            law: FixedEndFriction::new(cable, mesh),
            each: nodes.map(around).collect(),
            load: body.clone(),
            body,
        }
    }

    /// Those that stand in a `window`.
    pub fn within(&self, window: Stretch) -> impl Iterator<Item = &Support> + Clone {
        let stands_within = move |support: &&Support| window.nodes().contains(&support.node);
        self.each.iter().filter(stands_within)
    }

    /// The ground at rest, where the adherent frame is that of the ground, and the cable's own
    /// loads `body` \[N\].
    pub fn rest(&mut self, body: Vec<f64>) {
        self.load.copy_from_slice(&body);
        self.body = body;
    }

    /// Loads ends and clamps as the vehicle and what slips demand.
    pub fn load(&mut self, snapshot: &Snapshot<'_>, chain: &Chain) {
        for clamp in chain.clamps() {
            self.load[clamp.node] = self.body[clamp.node];
        }
        for &(node, spring) in &self.ends {
            let pull = cut(snapshot, node, chain) - spring * snapshot.adherent_at(node);
            self.load[node] = self.body[node] + pull;
        }
        chain.add_clamp_loads(&mut self.load, |node| snapshot.adherent_at(node));
    }

    /// Moves fixed nodes, whose friction is `g`, from one snapshot to the other, in both the state `r` and the `trial`. Returns the heat
    /// of the slip there \[J\].
    pub fn hold(
        &self,
        snapshots: [&Snapshot<'_>; 2],
        chain: &Chain,
        (r, g): (&mut [f64], &mut [f64]),
        trial: &mut Trial,
    ) -> f64 {
        let (mut heat, gamma) = (0.0, self.law.friction.compliance());
        for &(node, position) in &self.fixed {
            let [adhesion_before, adhesion] = snapshots.map(|snapshot| snapshot.adhesion[node]);
            // The duct stands at D = a + γ A.
            let [duct_before, duct] =
                snapshots.map(|snapshot| snapshot.adherent_at(node) + gamma * snapshot.adhesion[node]);
            let (slip, before) = (duct - duct_before, g[node] + adhesion_before);
            let after = self.law.after_slip(before, slip, chain.nodes()[node].limit);
            heat += chain.nodes()[node].tributary * after * (slip - gamma * (after - before));
            r[node] = position - snapshots[1].adherent_at(node);
            trial.r[node] = r[node];
            g[node] = after - adhesion;
        }
        heat
    }
}

impl Support {
    /// Brings the node under the `load` \[N\] into balance, in the trial of the `step`. False where the window does not stick, or would slip:
    /// friction and `adhesion` exceed the `limit` \[N/m\]; then the trial is to be solved.
    pub fn respond(&self, step: &mut ImplicitStep, load: &[f64], adhesion: &[f64], limit: f64) -> bool {
        let (chain, Trial { r, g, contact }) = (&step.chain, &mut step.trial);
        let nodes = self.window.nodes();
        let sticks = contact[nodes.clone()]
            .iter()
            .all(|contact| *contact == Contact::Stuck);
        let missing = g[self.node] - chain.balancing_friction(r, load, self.node);
        let force = missing * chain.nodes()[self.node].tributary;
        let [displacement, friction] = &self.response;
        for (r, answer) in r[nodes.clone()].iter_mut().zip(displacement) {
            *r += force * answer;
        }
        let mut bears = true;
        for ((g, answer), adhesion) in g[nodes.clone()].iter_mut().zip(friction).zip(&adhesion[nodes]) {
            *g += force * answer;
            bears &= (*g + adhesion).abs() <= limit;
        }
        sticks && bears
    }
}

/// Force of the adherent motion on the last node of a cable that is cut at an end \[N\].
///
/// Beyond an end the adherent motion would go on; cutting the chain there leaves ±(k/2)(a_{+1} − a_{−1}), the force of
/// the missing half.
fn cut(snapshot: &Snapshot<'_>, end: usize, chain: &Chain) -> f64 {
    let strain = 0.5 * chain.stiffness() * snapshot.stretch_around(end);
    if end == 0 { strain } else { -strain }
}
