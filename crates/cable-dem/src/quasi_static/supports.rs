//! Ends and clamps while the vehicle passes: their loads, and when the cable around them is to be solved again.

use super::passage::Snapshot;
use super::passage::UNBALANCED_SHARE;
use super::window::Room;
use crate::step::{Chain, FixedEndFriction, Stretch, Support, Trial};
use crate::{DuctedCable, Mesh};

/// What a support feels of the vehicle in the adherent frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Forcing {
    /// Force of the adherent motion on a cable that is cut at an end \[N\]; zero elsewhere.
    cut: f64,
    /// Adherent displacement \[m\], against which the ground holds the node.
    adherent: f64,
    /// Adhesion \[N/m\], which a held node's friction has beside its own.
    adhesion: f64,
}

/// A support, the window around it, and the forcing for which it was last solved.
#[derive(Debug, Clone)]
struct WatchedSupport {
    support: Support,
    /// Its least width, and what moved when it was last solved.
    least: Stretch,
    stretch: Stretch,
    solved: Forcing,
    /// Whether the forcing has changed since.
    due: bool,
    /// Forcing up to which a fixed node's own friction has followed.
    followed: Forcing,
    /// Force on the cable per displacement of the duct \[N/m\].
    grip: f64,
}

/// All supports of a cable.
#[derive(Debug, Clone)]
pub(super) struct Supports {
    all: Vec<WatchedSupport>,
    /// Friction law of fixed nodes.
    law: FixedEndFriction,
    /// Loads in the adherent frame \[N\] by node: those of the supports, and the cable's own along the duct.
    pub load: Vec<f64>,
    /// The latter alone, and that of its heat.
    body: Vec<f64>,
    /// Without heat that of both end nodes.
    weight: [f64; 2],
    /// Change of a support's force \[N\] from which it is solved again: as much as a window's edge may be off.
    threshold: f64,
    last: usize,
}

impl Supports {
    /// Those of `cable` on `mesh`, whose sheath has the `screening` (λ/h)².
    pub fn new(cable: &DuctedCable, mesh: &Mesh, chain: &Chain, room: Room, screening: f64) -> Self {
        // Over one screening length, and at least one element, a held node drags the cable along.
        let held_stiffness = chain.stiffness / screening.sqrt().max(1.0);
        // A stuck chain that goes on to one side resists with k/√s where its sheath is soft, s = (λ/h)², and with half a node's where it is stiff.
        let stuck_stiffness = chain.stiffness / screening.sqrt().min(2.0 * screening);
        let body = cable.body_loads(mesh);
        let around = |node| room.widened(Stretch { lo: node, hi: node }, room.margin);
        let watched = |support: Support| WatchedSupport {
            least: around(support.node),
            stretch: around(support.node),
            solved: Forcing::default(),
            due: false,
            followed: Forcing::default(),
            grip: support.stiffness.map_or(held_stiffness, |stiffness| {
                let sides = if [0, mesh.elements()].contains(&support.node) {
                    1.0
                } else {
                    2.0
                };
                1.0 / (1.0 / stiffness + 1.0 / (sides * stuck_stiffness))
            }),
            support,
        };
        Self {
            all: Support::of(cable, mesh).into_iter().map(watched).collect(),
            law: FixedEndFriction::new(cable, mesh),
            weight: [body[0], body[mesh.elements()]],
            load: body.clone(),
            body,
            threshold: UNBALANCED_SHARE * chain.least_limit * mesh.spacing(),
            last: mesh.elements(),
        }
    }

    /// The ground at rest, where the adherent frame is that of the ground, and a cable whose heat has the force `thermal` \[N\].
    pub fn rest(&mut self, thermal: f64) {
        // Heat pushes the two ends apart and nothing between them.
        self.body[0] = self.weight[0] - thermal;
        self.body[self.last] = self.weight[1] + thermal;
        self.load.copy_from_slice(&self.body);
        for watched in &mut self.all {
            watched.stretch = watched.least;
            watched.solved = Forcing::default();
            watched.followed = Forcing::default();
        }
    }

    /// The windows around supports that are to be solved again.
    pub fn due(&self) -> impl Iterator<Item = Stretch> {
        self.all
            .iter()
            .filter(|watched| watched.due)
            .map(|watched| watched.stretch)
    }

    /// Remembers what `moves` around the supports that a solved window began with: what the window is to begin with next time.
    pub fn remember(&mut self, begun: Stretch, moves: Option<Stretch>) {
        for watched in &mut self.all {
            let least = watched.least;
            if watched.due && begun.lo <= least.lo && least.hi <= begun.hi {
                watched.stretch = moves.map_or(least, |moves| Stretch {
                    lo: moves.lo.min(least.lo),
                    hi: moves.hi.max(least.hi),
                });
            }
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
            let forcing = forcing(snapshot, node, chain.stiffness, self.last);
            let change = (forcing.cut - watched.solved.cut).abs()
                + watched.grip * (forcing.adherent - watched.solved.adherent).abs();
            watched.due = all || change > self.threshold;
            if watched.support.stiffness.is_none() {
                // Its friction turns at slips far smaller than those that matter to its neighbours. D = a + γ A.
                let (followed, gamma) = (watched.followed, chain.compliance);
                let slip =
                    forcing.adherent - followed.adherent + gamma * (forcing.adhesion - followed.adhesion);
                let before = g[node] + followed.adhesion;
                let after = self.law.after_slip(before, slip);
                heat += chain.nodes[node].tributary * after * (slip - gamma * (after - before));
                g[node] = after - forcing.adhesion;
                watched.followed = forcing;
            }
            if watched.due {
                match watched.support.stiffness {
                    None => {
                        r[node] = -forcing.adherent;
                        trial.r[node] = -forcing.adherent;
                    }
                    Some(spring) => {
                        self.load[node] = forcing.cut - spring * forcing.adherent + self.body[node];
                    }
                }
                watched.solved = forcing;
            }
        }
        heat
    }
}

/// Forcing of a support at `node`; `stiffness` is the chain's k = EA/h, `last` the last node.
///
/// Beyond an end the adherent motion would go on; cutting the chain there leaves ±(k/2)(a_{+1} − a_{−1}), the force of
/// the missing half.
fn forcing(snapshot: &Snapshot<'_>, node: usize, stiffness: f64, last: usize) -> Forcing {
    let strain = 0.5 * stiffness * snapshot.stretch_around(node);
    Forcing {
        cut: match node {
            0 => strain,
            node if node == last => -strain,
            _ => 0.0,
        },
        adherent: snapshot.adherent_at(node),
        adhesion: snapshot.adhesion[node],
    }
}
