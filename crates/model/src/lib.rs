//! The identification model.
