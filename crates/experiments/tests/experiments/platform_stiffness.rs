//! The stiffness of the platform with its uncertainty, against finite differences of the world that was measured.

use hexbench_core::{Matrix6, Observation, Pose, Vector6, Wrench};
use hexbench_experiments::recovery::pulls::right_fit;
use hexbench_experiments::recovery::scene::{RecoveryCampaign, subjects};
use hexbench_model::application::model_file::{DataOrigin, Estimator, Model};
use hexbench_model::application::stiffness::{StiffnessPoint, cartesian_stiffness};
use hexbench_truth::{Situation, World};
use rayon::prelude::*;

/// What is hidden.
const SUBJECTS: [&str; 4] = ["springs", "springs (absolute)", "base-compliance", "platform-compliance"];
/// Campaigns of each.
const CAMPAIGNS: usize = 60;
/// Step of the difference, N; moments a tenth of it in N m.
const STEP_N: f64 = 1.0;

/// Motion of the mobile origin per unit of load, fixed axes.
fn true_compliance(world: &World, pose: Pose, load: Wrench) -> Matrix6 {
    let stands = |w: Vector6| world.pose(&Situation::new(pose, Wrench::from_array(w.into()))).unwrap();
    let column = |axis: usize| {
        let step = if axis < 3 { STEP_N } else { 0.1 * STEP_N };
        let w = load.to_vector();
        let [plus, minus] = [1.0, -1.0].map(|sign| stands(w + Vector6::ith(axis, sign * step)));
        let shift = plus.translation - minus.translation;
        let turn = plus.rotation() * minus.rotation().transpose();
        let skew = (turn - turn.transpose()) * 0.5;
        Vector6::new(shift.x, shift.y, shift.z, skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]) / (2.0 * step)
    };
    Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(column))
}

/// Entries of K and C: how many, and how many 95 % intervals hold the truth.
fn covered(subject: &str, index: usize) -> [usize; 2] {
    let subject = subjects().into_iter().find(|s| s.name == subject).unwrap();
    let scene = RecoveryCampaign::draw(&subject, index, 41, None).unwrap();
    let data = &scene.case.measurements;
    let (campaign, fit) = right_fit(&subject, scene.hexapod(), data).unwrap();
    let model = Model::new(&campaign, &fit, Estimator::Gls, DataOrigin::default());
    let asked = &data.observations[index % data.observations.len()];
    let row = Observation::unread(asked.pose, asked.wrench, Wrench::default());
    let found = &cartesian_stiffness(&model, &[row], &StiffnessPoint::default()).unwrap()[0];
    let compliance = true_compliance(&scene.case.campaign.world, asked.pose, asked.wrench);
    let stiffness = compliance.try_inverse().unwrap();
    let pairs = [
        (compliance, found.compliance, found.compliance_std),
        (stiffness, found.stiffness, found.stiffness_std),
    ];
    let held = pairs
        .iter()
        .flat_map(|(truth, value, std)| (0..36).map(|k| (truth[k] - value[k]).abs() <= 1.96 * std[k]));
    [72, held.filter(|held| *held).count()]
}

#[test]
fn intervals_of_the_stiffness_matrix_hold_the_true_world() {
    let mut all = [0, 0];
    for subject in SUBJECTS {
        let counts: Vec<[usize; 2]> = (0..CAMPAIGNS).into_par_iter().map(|i| covered(subject, i)).collect();
        let [of, held] = counts.iter().fold([0, 0], |a, b| [a[0] + b[0], a[1] + b[1]]);
        let share = held as f64 / of as f64;
        println!("{subject}: {:.1} %", 100.0 * share);
        // Some six independent numbers of a campaign: three standard errors of 95 % of 360.
        assert!((0.91..0.99).contains(&share), "{subject}: {share}");
        all = [all[0] + of, all[1] + held];
    }
    let share = all[1] as f64 / all[0] as f64;
    assert!((0.93..0.97).contains(&share), "all: {share}");
}
