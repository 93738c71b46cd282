//! What the last pass of the same vehicle was like: the best guess for the next one.
//!
//! From pass to pass the cable's state changes little, and with it the window and the contact states at every vehicle
//! position. Starting from those, most steps need a single linear solve.

use super::chain::{Contact, Stretch};

/// Travelling windows and their contact states, one entry a vehicle position.
#[derive(Debug, Clone, Default)]
pub(super) struct PassMemory {
    entries: Vec<Entry>,
    contacts: Vec<Contact>,
}

/// One vehicle position: its window, and where its contact states begin.
#[derive(Debug, Clone, Copy)]
struct Entry {
    window: Option<Stretch>,
    start: usize,
}

impl PassMemory {
    pub fn clear(&mut self) {
        self.entries.clear();
        self.contacts.clear();
    }

    /// Remembers the next vehicle position; `contact` covers all nodes.
    pub fn push(&mut self, window: Option<Stretch>, contact: &[Contact]) {
        self.entries.push(Entry {
            window,
            start: self.contacts.len(),
        });
        if let Some(Stretch { lo, hi }) = window {
            self.contacts.extend_from_slice(&contact[lo..=hi]);
        }
    }

    /// The window and its contact states at vehicle position number `step`, if the last pass had one.
    pub fn recall(&self, step: usize) -> Option<(Stretch, &[Contact])> {
        let Entry { window, start } = *self.entries.get(step)?;
        let window = window?;
        Some((window, &self.contacts[start..=start + window.hi - window.lo]))
    }
}
