//! Challenges: cases with a sealed truth for algorithms in any language.
//!
//! ```text
//! suite.toml --make--> DIR/cases (public)   --run-->  ANSWERS  --score-->  figures side by side
//!                      DIR/sealed (truth)   ------------------------^
//! ```
//!
//! An algorithm is a program called with a case folder and a folder for its answer. It sees only a copy of the public
//! files; its answer is compared with the truth, and a diagnosis is judged as in the other experiments.
//!
//! - [`ChallengeSuite`]: which cases, a frozen protocol; [`make()`] writes the challenge, [`Challenge`] opens and checks it.
//! - [`run`]: a program under limits of time, memory and output, case by case, resumable.
//! - [`answer`]: what a program wrote, read strictly.
//! - [`score`]: errors, coverage, proper scores, several programs beside each other.

pub mod answer;
mod error;
mod folder;
mod in_scene;
mod made;
mod make;
mod manifest;
pub mod run;
mod sampled;
pub mod score;
mod stored;
mod suite;
mod truth;

pub use error::ChallengeError;
pub use made::Challenge;
pub use make::make;
pub use manifest::{MANIFEST, Manifest};
pub use sampled::{SampledCase, draw};
pub use suite::{BUNDLED, Bundled, CasePortion, ChallengeSuite};
pub use truth::{SealedNoise, Truth};
