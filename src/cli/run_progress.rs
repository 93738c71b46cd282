//! How far a run is: passes on the present mesh, and the share of all work that a forecast foretells.

use std::cell::OnceCell;
use std::sync::mpsc::{Receiver, channel};
use std::time::Duration;

use super::progress::{HowFar, Now};
use crate::{Scene, Underway};

/// Runs that are shorter are not foretold: a forecast takes up to a second.
const LONG: Duration = Duration::from_secs(5);
/// More than this share of the work is never said to be done before it is: a forecast may be too low.
const MOST: f64 = 0.99;

pub struct RunProgress<'a> {
    scene: &'a Scene,
    underway: &'a Underway,
    forecast: OnceCell<Receiver<f64>>,
    /// Nodes eliminated in all, once that is foretold.
    total: OnceCell<f64>,
}

impl<'a> RunProgress<'a> {
    pub fn new(scene: &'a Scene, underway: &'a Underway) -> Self {
        Self {
            scene,
            underway,
            forecast: OnceCell::new(),
            total: OnceCell::new(),
        }
    }

    /// How far it is.
    pub fn how_far(&self, now: Now) -> HowFar {
        let elapsed = now.elapsed;
        let Some(reached) = self.underway.reached() else {
            return HowFar::unknown("choosing ground, method and mesh", elapsed);
        };
        let words = format!(
            "pass {} of {} on nodes {:.3} m apart",
            reached.pass, reached.passes, reached.node_spacing_m
        );
        if elapsed < LONG {
            return HowFar::new(now, &words);
        }
        let forecast = self.forecast.get_or_init(|| forecast(self.scene.clone()));
        if let Ok(total) = forecast.try_recv() {
            let _ = self.total.set(total);
        }
        match self.total.get().map(|total| reached.node_updates / total) {
            // Till then every mesh to come counts as much as this one.
            None => HowFar {
                share: None,
                ..HowFar::new(now, &words)
            },
            Some(share) if share < MOST => HowFar::new(
                Now {
                    share,
                    first: 0.0,
                    elapsed,
                },
                &words,
            ),
            Some(_) => HowFar {
                share: Some(MOST),
                words: format!("{words}, longer than expected"),
            },
        }
    }
}

/// Foretells the nodes that a run eliminates, beside it and in a fraction of its time, on a thread that is free: on one thread alone never.
fn forecast(scene: Scene) -> Receiver<f64> {
    let (send, receive) = channel();
    rayon::spawn(move || {
        let forecast = crate::plan(&scene).and_then(|plan| crate::forecast(&plan));
        if let Ok(forecast) = forecast {
            let _ = send.send(forecast.node_updates);
        }
    });
    receive
}
