//! Creepage of power cables in underground ducts under traffic.

pub mod scene;
