//! The command as a user runs it, and the rules of the workspace around it.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on must fail")]

mod angles;
mod campaign;
mod challenge;
mod challenge_lint;
mod challenge_scenes;
mod choice;
mod command_line;
mod demo;
mod design;
mod discover;
mod discriminate;
mod documents;
mod exits;
mod export;
mod far_frames;
mod faults;
mod gate;
mod gauges;
mod glossary;
mod hand_changed;
mod hostile_text;
mod html;
mod init;
mod json;
mod limits;
mod links;
mod outputs;
mod pages;
#[cfg(unix)]
mod pasted;
mod poses;
mod power;
mod programs;
mod prose;
mod recovery;
mod regress;
mod robots;
mod robots_of_others;
mod runs;
mod scenes;
mod schemas;
mod score;
mod separation;
mod session;
mod shared;
mod streams;
mod study;
mod study_parts;
mod support;
mod tables;
mod use_model;
mod validate;
mod witness;
mod workbench;
