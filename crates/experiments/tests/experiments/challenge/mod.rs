//! Challenges from suite to scores, with programs that behave and programs that do not.

mod hidden;
mod made;
mod runs;
mod scores;
mod support;
