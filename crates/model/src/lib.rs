//! The identification model.
//!
//! One spring per leg, identified from loaded poses, plus named terms for the effects that springs do not explain. Chapters,
//! each built on those above it: [`machine`], [`effects`] with the catalogue [`terms`], [`estimation`], [`inference`],
//! [`results`], [`application`].

pub mod application;
pub mod effects;
pub mod error;
pub mod estimation;
pub mod inference;
pub mod machine;
pub mod results;
pub mod terms;

#[cfg(test)]
mod test_machine;
