//! The experiments as a whole: small versions of each, judged by what must hold of them.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on must fail")]

mod bodies;
mod calibration;
mod challenge;
mod covariates;
mod discovery;
mod discriminate;
mod formulas;
mod histories;
mod interactions;
mod interrupted;
mod machine_laws;
mod misread;
mod paper;
mod patterns;
mod platform_stiffness;
mod power;
mod recovery;
mod reference_records;
mod regress;
mod robustness;
mod rubin;
mod sensors;
mod sweep;
