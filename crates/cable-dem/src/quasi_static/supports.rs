//! Ends and clamps while the vehicle passes: their loads, and when the cable around them is to be solved again.

use super::passage::Snapshot;
use super::window::WindowBounds;
use crate::step::{Chain, FixedEndFriction, Stretch, Support, Trial};
use crate::tuning::{FIXED_END, UNBALANCED_SHARE};
use crate::{DuctedCable, Mesh};

/// A support, and what it feels of the vehicle in the adherent frame.
#[derive(Debug, Clone)]
struct WatchedSupport {
    support: Support,
    /// Its least window, and what moved in it when it was last solved.
    least: Stretch,
    window: Stretch,
    /// For which it was last solved: the load on a spring \[N\], or the adherent displacement
    /// against which the ground holds a fixed end \[m\].
    solved: f64,
    /// Whether that has changed since.
    due: bool,
    /// Displacement \[m\] and adhesion \[N/m\] of the duct up to which a fixed end's own friction
    /// has followed.
    followed: [f64; 2],
}

/// All supports of a cable.
#[derive(Debug, Clone)]
pub(super) struct Supports {
    all: Vec<WatchedSupport>,
    /// Friction law of fixed nodes.
    law: FixedEndFriction,
    /// Loads in the adherent frame \[N\] by node: those of the supports, and the cable's own along the duct.
    pub load: Vec<f64>,
    /// The latter alone.
    body: Vec<f64>,
    /// Change of a support's force \[N\] from which it is solved again: as much as a window's edge may be off.
    threshold: f64,
}

impl Supports {
    /// Those of `cable` on `mesh`.
    pub fn new(cable: &DuctedCable, mesh: &Mesh, chain: &Chain, bounds: WindowBounds) -> Self {
        let body = cable.loads(mesh, 0.0);
        let around = |node| bounds.widened(Stretch { lo: node, hi: node }, bounds.margin);
        let watched = |support: Support| WatchedSupport {
            least: around(support.node),
            window: around(support.node),
            solved: 0.0,
            due: false,
            followed: [0.0; 2],
            support,
        };
        Self {
            all: Support::of(cable, mesh).into_iter().map(watched).collect(),
            law: FixedEndFriction::new(cable, mesh),
            load: body.clone(),
            body,
            threshold: UNBALANCED_SHARE * chain.least_limit * mesh.spacing(),
        }
    }

    /// The ground at rest, where the adherent frame is that of the ground, and the cable's own
    /// loads `body` \[N\].
    pub fn rest(&mut self, body: Vec<f64>) {
        self.load.copy_from_slice(&body);
        self.body = body;
        for watched in &mut self.all {
            (watched.solved, watched.followed) = (0.0, [0.0; 2]);
            watched.window = watched.least;
        }
    }

    /// The windows around supports that are to be solved again.
    pub fn due(&self) -> impl Iterator<Item = Stretch> {
        self.all
            .iter()
            .filter(|watched| watched.due)
            .map(|watched| watched.window)
    }

    /// Remembers what `moved` in a `window` that was solved: the windows of its supports begin with
    /// that next time.
    pub fn remember(&mut self, window: Stretch, moved: &[Stretch]) {
        let in_window = |watched: &&mut WatchedSupport| watched.due && watched.least.overlaps(window);
        for watched in self.all.iter_mut().filter(in_window) {
            watched.window = moved.iter().copied().fold(watched.least, Stretch::hull);
        }
    }

    /// Brings the loads up to date where the vehicle's effect on them has changed, or everywhere if `all`, and moves fixed nodes, whose
    /// friction is `g`, in both the state `r` and the `trial`. Returns the heat of the slip there \[J\].
    pub fn update(
        &mut self,
        snapshot: &Snapshot<'_>,
        all: bool,
        chain: &Chain,
        (r, g): (&mut [f64], &mut [f64]),
        trial: &mut Trial,
    ) -> f64 {
        let mut heat = 0.0;
        for watched in &mut self.all {
            let node = watched.support.node;
            let adherent = snapshot.adherent_at(node);
            // Force on the node for each newton of load, or each metre of displacement.
            let (target, force) = match watched.support.stiffness {
                Some(spring) => (cut(snapshot, node, chain) - spring * adherent, 1.0),
                None => (adherent, FIXED_END * chain.stiffness),
            };
            watched.due = all || force * (target - watched.solved).abs() > self.threshold;
            if watched.due {
                watched.solved = target;
            }
            if watched.support.stiffness.is_some() {
                self.load[node] = watched.solved + self.body[node];
                continue;
            }
            r[node] = -watched.solved;
            trial.r[node] = -watched.solved;
            // Its friction turns at slips far smaller than those that matter to its neighbours.
            // The duct stands at D = a + γ A.
            let (gamma, adhesion) = (chain.compliance, snapshot.adhesion[node]);
            let duct = adherent + gamma * adhesion;
            let [duct_before, adhesion_before] = std::mem::replace(&mut watched.followed, [duct, adhesion]);
            let (slip, before) = (duct - duct_before, g[node] + adhesion_before);
            let after = self.law.after_slip(before, slip);
            heat += chain.nodes[node].tributary * after * (slip - gamma * (after - before));
            g[node] = after - adhesion;
        }
        heat
    }
}

/// Force of the adherent motion on the last node of a cable that is cut at an end \[N\]; zero
/// elsewhere.
///
/// Beyond an end the adherent motion would go on; cutting the chain there leaves ±(k/2)(a_{+1} − a_{−1}), the force of
/// the missing half.
fn cut(snapshot: &Snapshot<'_>, node: usize, chain: &Chain) -> f64 {
    let strain = 0.5 * chain.stiffness * snapshot.stretch_around(node);
    match node {
        0 => strain,
        node if node + 1 == chain.nodes.len() => -strain,
        _ => 0.0,
    }
}
