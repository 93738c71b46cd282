//! What the last pass of the same vehicle was like: the best guess for the next one.
//!
//! From pass to pass the cable's state changes little, and with it the window and the contact states at every vehicle
//! position. Starting from those, most steps need a single linear solve: 60 passes over 30 m take two thirds of the time.

use crate::step::{Contact, Stretch};

/// Travelling windows and their contact states, one entry per vehicle position.
#[derive(Debug, Clone, Default)]
pub(super) struct PassMemory {
    /// The window, and where its contact states begin.
    entries: Vec<(Option<Stretch>, usize)>,
    contacts: Vec<Contact>,
}

impl PassMemory {
    /// Remembers the next vehicle position; `contacts` covers all nodes.
    pub fn push(&mut self, window: Option<Stretch>, contacts: &[Contact]) {
        self.entries.push((window, self.contacts.len()));
        if let Some(window) = window {
            self.contacts.extend_from_slice(&contacts[window.nodes()]);
        }
    }

    /// The window and its contact states at vehicle position number `step`, if the last pass had one.
    pub fn recall(&self, step: usize) -> Option<(Stretch, &[Contact])> {
        let &(window, start) = self.entries.get(step)?;
        let window = window?;
        Some((window, &self.contacts[start..start + window.len()]))
    }
}
