//! The chapters of the model, its catalogue, and what is done with a fitted model.
#![allow(clippy::unwrap_used, clippy::expect_used, reason = "a test that cannot go on must fail")]

mod actuator_pitch;
mod book;
mod calibration;
mod cases;
mod chain;
mod common;
mod compare;
mod diagnosed_remainder;
mod discover;
mod effort;
mod evidence;
mod examination;
mod frames;
mod function_term;
mod gain;
mod interactions;
mod kinematics;
mod least_squares;
mod misread;
mod misread_poses;
mod model_file;
mod nested;
mod next;
mod nonlinear_least_squares;
mod paper;
mod platform_stiffness;
mod predict_sensors;
mod recovery;
mod registry;
mod sensors;
mod stiffness_matrices;
mod story;
mod turning;
mod use_model;
mod user_term;
