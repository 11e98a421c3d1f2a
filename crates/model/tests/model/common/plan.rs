//! Plans: which poses and loads are measured.

use hexbench_core::{Columns, Dataset, Measurand, Observation, Pose, Wrench};

use super::random::Random;

/// A reading of a pose under a load, nothing measured yet.
pub(crate) fn reading(pose: Pose, wrench: Wrench, reference: Wrench) -> Observation {
    Observation { pose_id: 0, line: 2, ..Observation::unread(pose, wrench, reference) }
}

/// A file of readings.
pub(crate) fn dataset(measurand: Measurand, mut observations: Vec<Observation>) -> Dataset {
    for (i, o) in observations.iter_mut().enumerate() {
        o.line = i as u64 + 2;
    }
    let columns = Columns { reference: true, ..Columns::default() };
    Dataset::of_poses("test", measurand, columns, observations)
}

/// A pose within +-`millimetres` and +-`degrees` of zero.
pub(crate) fn random_pose(random: &mut Random, millimetres: f64, degrees: f64) -> Pose {
    let (t, r) = (millimetres * 1e-3, degrees.to_radians());
    Pose::from_array(std::array::from_fn(|k| random.within(if k < 3 { t } else { r })))
}

/// A wrench within +-`newtons` and +-`newton_metres`.
pub(crate) fn random_wrench(random: &mut Random, newtons: f64, newton_metres: f64) -> Wrench {
    Wrench::from_array(std::array::from_fn(|k| random.within(if k < 3 { newtons } else { newton_metres })))
}

/// `count` poses with tilts, a lateral load and a moment each, on top of a vertical preload. Loads scale with `load`.
pub(crate) fn rich_plan(count: usize, load: f64, seed: u64) -> Vec<Observation> {
    let mut random = Random::new(seed);
    let preload = Wrench::from_array([0.0, 0.0, -120.0 * load, 0.0, 0.0, 0.0]);
    let row = |id: i64| {
        let pose = random_pose(&mut random, 15.0, 6.0);
        let extra = random_wrench(&mut random, 250.0 * load, 12.0 * load);
        let sum = preload.to_vector() + extra.to_vector();
        let wrench = Wrench::from_array(std::array::from_fn(|k| sum[k]));
        Observation { pose_id: id, ..reading(pose, wrench, preload) }
    };
    (0..).take(count).map(row).collect()
}

/// The three poses of Kalas et al. 2018, table 1, with their vertical loads (12.2 kg and 34.5 kg), repeated.
pub(crate) fn paper_plan(repeats: i64) -> Vec<Observation> {
    const GRAVITY: f64 = 9.806_65;
    let poses: [[f64; 6]; 3] = [
        [2.616, 0.832, -0.666, 0.0, 0.0, 15.756],
        [10.017, -3.434, -0.764, 0.0, 0.0, -11.007],
        [-7.784, -3.210, 1.760, 0.0, 0.0, -11.266],
    ];
    let weight = |kg: f64| Wrench::from_array([0.0, 0.0, -kg * GRAVITY, 0.0, 0.0, 0.0]);
    let mut rows = Vec::new();
    for (id, x) in (1..).zip(poses) {
        let pose =
            Pose::from_array(std::array::from_fn(|k| if k < 3 { x[k] * 1e-3 } else { x[k].to_radians() }));
        for repeat in 1..=repeats {
            rows.push(Observation { pose_id: id, repeat, ..reading(pose, weight(34.5), weight(12.2)) });
        }
    }
    rows
}

/// The same readings with normal noise added, m and rad.
pub(crate) fn noisy(data: &Dataset, sigma_translation: f64, sigma_rotation: f64, seed: u64) -> Dataset {
    let mut random = Random::new(seed);
    let mut noisy = data.clone();
    for o in &mut noisy.observations {
        for k in 0..6 {
            o.measured[k] += random.normal() * if k < 3 { sigma_translation } else { sigma_rotation };
        }
    }
    noisy
}
