//! Ends and clamps while the vehicle passes: their loads, and where they stand, in the adherent frame.
//!
//! The cable around each of them is solved at every step.

use super::passage::Snapshot;
use super::window::WindowBounds;
use crate::step::{Chain, FixedEndFriction, Stretch, Support, Trial};
use crate::{DuctedCable, Mesh};

/// All supports of a cable.
#[derive(Debug, Clone)]
pub(super) struct Supports {
    /// Those that are springs, with their stiffness \[N/m\].
    springs: Vec<(usize, f64)>,
    fixed: Vec<FixedEnd>,
    /// Friction law of fixed nodes.
    law: FixedEndFriction,
    /// Least windows around all of them.
    pub windows: Vec<Stretch>,
    /// Loads in the adherent frame \[N\] by node: those of the supports, and the cable's own along the duct.
    pub load: Vec<f64>,
    /// The latter alone.
    body: Vec<f64>,
}

/// A fixed end, and how far its friction has followed the duct.
#[derive(Debug, Clone)]
struct FixedEnd {
    node: usize,
    /// Where it stands \[m\].
    position: f64,
    /// Displacement \[m\] and adhesion \[N/m\] of the duct.
    followed: [f64; 2],
}

impl Supports {
    /// Those of `cable` on `mesh`.
    pub fn new(cable: &DuctedCable, mesh: &Mesh, bounds: WindowBounds) -> Self {
        let body = cable.loads(mesh, 0.0);
        let [upstream, downstream] = cable.end_positions();
        let (mut springs, mut fixed, mut windows) = (Vec::new(), Vec::new(), Vec::new());
        for Support { node, stiffness, .. } in Support::of(cable, mesh) {
            windows.push(bounds.widened(Stretch { lo: node, hi: node }, bounds.margin));
            match stiffness {
                Some(spring) => springs.push((node, spring)),
                None => fixed.push(FixedEnd {
                    node,
                    position: if node == 0 { upstream } else { downstream },
                    followed: [0.0; 2],
                }),
            }
        }
        Self {
            springs,
            fixed,
            law: FixedEndFriction::new(cable, mesh),
            windows,
            load: body.clone(),
            body,
        }
    }

    /// The ground at rest, where the adherent frame is that of the ground, and the cable's own
    /// loads `body` \[N\].
    pub fn rest(&mut self, body: Vec<f64>) {
        self.load.copy_from_slice(&body);
        self.body = body;
        for end in &mut self.fixed {
            end.followed = [0.0; 2];
        }
    }

    /// Loads the nodes on springs as the vehicle and the clamps that slip demand.
    pub fn load(&mut self, snapshot: &Snapshot<'_>, chain: &Chain) {
        for &(node, spring) in &self.springs {
            let frame = snapshot.adherent_at(node);
            let spring = cut(snapshot, node, chain) - spring * frame;
            self.load[node] = spring + self.body[node] + chain.grip_load(node, frame);
        }
    }

    /// Moves fixed nodes, whose friction is `g`, in both the state `r` and the `trial`. Returns the heat of the slip there \[J\].
    pub fn hold(
        &mut self,
        snapshot: &Snapshot<'_>,
        chain: &Chain,
        (r, g): (&mut [f64], &mut [f64]),
        trial: &mut Trial,
    ) -> f64 {
        let mut heat = 0.0;
        for end in &mut self.fixed {
            let node = end.node;
            r[node] = end.position - snapshot.adherent_at(node);
            trial.r[node] = r[node];
            // The duct stands at D = a + γ A.
            let (gamma, adhesion) = (chain.compliance, snapshot.adhesion[node]);
            let duct = snapshot.adherent_at(node) + gamma * adhesion;
            let [duct_before, adhesion_before] = std::mem::replace(&mut end.followed, [duct, adhesion]);
            let (slip, before) = (duct - duct_before, g[node] + adhesion_before);
            let after = self.law.after_slip(before, slip, chain.nodes[node].limit);
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
