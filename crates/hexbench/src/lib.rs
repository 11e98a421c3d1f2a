//! Elastostatics of hexapods (Gough-Stewart platforms) from measurements: which physical effect does a stiffness model lack?
//!
//! A hexapod yields under load. The usual model has one spring per leg: measured deflections determine its stiffness, and the
//! residuals show what else yields. This crate reads a machine and its measurements, identifies the missing effect with a probability
//! (or reports that no known effect explains the data), fits it in its own units, and computes the error on held-out poses.
//!
//! ```
//! use hexbench::prelude::*;
//!
//! # let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/cases/mujoco-foundation");
//! let hexapod = read_hexapod(&folder.join("hexapod.toml"))?;
//! let measurements = read_measurements(&folder.join("measurements.csv"))?.dataset;
//! let holdout = read_measurements(&folder.join("holdout.csv"))?.dataset;
//!
//! let study = diagnose(&hexapod, &measurements, Some(&holdout), &catalogue())?;
//! assert_eq!(study.diagnosis.verdict, Verdict::Named);
//! assert_eq!(study.diagnosis.added, ["base-compliance"]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Chapters
//!
//! | you want | it is in |
//! |---|---|
//! | machines, poses, wrenches, readings; their files | [`core`] |
//! | the loop from measurements to a verdict | [`model::results::diagnose`] |
//! | terms chosen by hand, fitted and judged | [`model::inference::selection`], [`model::estimation::fit_named`] |
//! | the catalogue of effects; a term of your own | [`model::terms`]; [`model::effects::term`], [`model::effects::chain`] |
//! | where the error occurs and what it correlates with | [`model::results::compare`] |
//! | a model saved in a file; its predictions; corrected commands; stiffness of the platform | [`model::application::model_file`];
//!   [`model::application::predict`]; [`model::application::compensate`]; [`model::application::stiffness`] |
//! | what to measure: poses, loads, readings within a budget | [`design`] |
//! | which effects a plan would show | [`design::power`] |
//!
//! The simulated machine with hidden effects, `hexbench-truth`, is no part of this crate: what explains measurements must not see what
//! made them. Only a test or a comparison depends on both, as the example `simulate_and_recover` does.
//!
//! # Examples
//!
//! - `diagnose`: from files to a named effect, its size, a prediction;
//! - `own_term`: an effect that no catalogue has, as twenty lines of Rust;
//! - `simulate_and_recover`: hide an effect in a simulated machine, find it, compare with the truth.
//!
//! `cargo run --release -p hexbench --example diagnose` runs the first.
//!
//! # Conventions
//!
//! SI inside (m, rad, N, N m, K, s); a name says its unit wherever another one is meant (`_um`, `_urad`). Fixed and mobile frame
//! coincide at the zero pose; wrenches act on the platform, at the mobile origin, in fixed axes. [`core`] has the rest.

pub use hexbench_core as core;
pub use hexbench_design as design;
pub use hexbench_model as model;

pub mod prelude;
