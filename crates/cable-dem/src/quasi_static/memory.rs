//! What the last pass of the same vehicle was like: the best guess for the next one.
//!
//! From pass to pass the cable's state changes little, and with it the windows and the contact states at every vehicle
//! position. Starting from those, most steps need a single linear solve: 60 passes over 30 m take two thirds of the time.

use crate::step::{Contact, Stretch};

/// What moved and its contact states, one entry per vehicle position.
#[derive(Debug, Clone, Default)]
pub(super) struct PassMemory {
    /// How many parts there are, and how many contact states, up to and with each position.
    ends: Vec<(usize, usize)>,
    parts: Vec<Stretch>,
    contacts: Vec<Contact>,
}

/// What moved at one vehicle position.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Recalled<'a> {
    pub parts: &'a [Stretch],
    /// Of all parts, one after another.
    contacts: &'a [Contact],
}

impl PassMemory {
    /// Forgets everything but keeps the room for it.
    pub fn clear(&mut self) {
        self.ends.clear();
        self.parts.clear();
        self.contacts.clear();
    }

    /// Remembers the next vehicle position; `contacts` covers all nodes.
    pub fn push(&mut self, parts: &[Stretch], contacts: &[Contact]) {
        self.parts.extend_from_slice(parts);
        for part in parts {
            self.contacts.extend_from_slice(&contacts[part.nodes()]);
        }
        self.ends.push((self.parts.len(), self.contacts.len()));
    }

    /// What moved at vehicle position number `step`; nothing if the last pass had none.
    pub fn recall(&self, step: usize) -> Recalled<'_> {
        let Some(&(parts, contacts)) = self.ends.get(step) else {
            return Recalled::default();
        };
        let before = step.checked_sub(1).map_or((0, 0), |before| self.ends[before]);
        Recalled {
            parts: &self.parts[before.0..parts],
            contacts: &self.contacts[before.1..contacts],
        }
    }
}

impl<'a> Recalled<'a> {
    /// Every part with its contact states.
    pub fn states(self) -> impl Iterator<Item = (Stretch, &'a [Contact])> {
        let mut rest = self.contacts;
        self.parts.iter().map(move |part| {
            let (states, others) = rest.split_at(part.len());
            rest = others;
            (*part, states)
        })
    }
}
