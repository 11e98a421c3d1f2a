//! The periodic error of the leads: amplitude, phase and pitch do not fight each other.

use hexbench_core::{Measurand, Vector6};
use hexbench_model::estimation::campaign::Campaign;
use hexbench_model::estimation::fit::columns;
use hexbench_model::estimation::linearization::{Active, Linearization, ModelPoint};

use crate::common::terms::{by_id, rows};
use crate::common::world::World;
use crate::common::{PAPER_STIFFNESS, measured_machine, paper_machine};

#[test]
fn a_small_change_of_pitch_turns_the_phases_little() {
    // Columns of the amplitudes against that of the logarithm of the pitch, all legs. Legs of 190 mm with phases
    // counted from zero length have 0.99; with phases from the home length only the travel counts.
    const LIMIT: f64 = 0.7;
    let world = World::on_springs(&paper_machine(), PAPER_STIFFNESS);
    let data = world.measure(Measurand::AbsolutePose, &rows(20, 21));
    let campaign = Campaign::new(&measured_machine(0.5e-6, 3e-6), &data).unwrap();
    let active = Active { values: vec![5e-6; 12], ..Active::new(by_id("actuator-pitch"), false, 3e-3) };
    let springs = Vector6::from(PAPER_STIFFNESS).map(f64::recip);
    let here = ModelPoint { compliances: springs, active: vec![active], ..ModelPoint::start(&campaign) };
    let all = columns(&Linearization::at(&campaign, &here).unwrap(), &here);
    let (waves, pitch) = (all.columns(18, 12).into_owned(), all.column(30).into_owned());
    let svd = waves.svd(true, false);
    let explained = (svd.u.unwrap().tr_mul(&pitch)).norm() / pitch.norm();
    assert!(explained < LIMIT, "the amplitudes explain {explained:.3} of a change of pitch");
}
