//! `actuator-pitch`: periodic error of the leads.
//!
//! Phases are counted from the home length, in the middle of the travel: counted from zero length they would turn by radians when
//! the pitch changes by a thousandth, and no linear uncertainty would hold.

use hexbench_core::Vector6;

use crate::effects::chain::Action;
use crate::effects::period::{period_grid, waves};
use crate::effects::term::{Chapter, Need, Rich, Scale, Shape, Term, TermInfo, each};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

const WAVES: [&str; 12] = [
    "leg-1-sine",
    "leg-1-cosine",
    "leg-2-sine",
    "leg-2-cosine",
    "leg-3-sine",
    "leg-3-cosine",
    "leg-4-sine",
    "leg-4-cosine",
    "leg-5-sine",
    "leg-5-cosine",
    "leg-6-sine",
    "leg-6-cosine",
];

pub(super) struct ActuatorPitch;

static INFO: TermInfo = TermInfo {
    id: "actuator-pitch",
    title: "Periodic error of the leads",
    chapter: Chapter::AbsolutePoses,
    physics: "Each screw has an error that repeats with its pitch; amplitude and phase belong to the leg, the pitch is common.",
    equation: "e_i = a_i sin(2 pi (q_i - q_home,i) / pitch) + b_i cos(2 pi (q_i - q_home,i) / pitch)",
    source: "ISO 230-2:2014; ISO 3408-3:2006 (ball screws, periodic lead deviation)",
    shows: "poses are measured absolutely at many leg lengths",
    how_to_isolate: "measure absolute poses in small steps of leg length, finer than half a pitch",
    parameters: &each(&WAVES, "um", 1e6, Scale::Fixed(20e-6), false),
    shape: Some(Shape { name: "pitch", unit: "mm", per_si: 1e3, bounds: [1e-4, 1.0] }),
    needs: &[Need::Absolute],
    rich: Rich::None,
};

impl Term for ActuatorPitch {
    fn info(&self) -> &TermInfo {
        &INFO
    }

    fn actions(&self, _: &Machine, at: &Condition, shape: f64, out: &mut Vec<Action>) {
        let waves = waves(&at.extension, shape);
        let of_leg = |leg| waves.map(|wave| Action::Elongation(Vector6::ith(leg, wave[leg])));
        out.extend((0..6).flat_map(of_leg));
    }

    fn waves(&self, at: &Condition, shape: f64) -> Option<[Vector6; 2]> {
        Some(waves(&at.extension, shape))
    }

    fn shape_grid(&self, conditions: &[Condition]) -> Vec<f64> {
        period_grid(conditions)
    }
}
