//! Plans: which poses, under which loads, how often.

use hexbench_core::{Hexapod, Pose, Wrench};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;

use super::rounded;
use crate::Situation;

/// The paper's preload and full load, N along z.
const PRELOAD_N: f64 = -119.682;
const FULL_LOAD_N: f64 = -338.445;
const HALF_LOAD_N: f64 = -225.63;

/// One line of a plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Number of the pose, from 1.
    pub pose_id: i64,
    /// Number of the repeat, from 1.
    pub repeat: i64,
    /// What is done.
    pub situation: Situation,
}

/// Makes of plans.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanKind {
    /// 18 poses with tilts, six loads along and about all axes, two readings each.
    Rich,
    /// As rich, with drawn loads.
    OtherLoads,
    /// As rich, ten poses.
    FewPoses,
    /// As rich, four loads along z only.
    VerticalOnly,
    /// As rich, the reference state without load.
    NoReference,
    /// The paper's three poses under its vertical load, three readings each; its ten validation poses held out.
    Paper,
    /// 40 poses under two loads, two readings each; absolute poses.
    Absolute,
}

/// A plan with its held-out part.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// Its make.
    pub kind: PlanKind,
    /// Rows to learn from.
    pub training: Vec<Row>,
    /// Rows to judge by.
    pub holdout: Vec<Row>,
}

impl PlanKind {
    /// Name in the truth file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rich => "rich",
            Self::OtherLoads => "other-loads",
            Self::FewPoses => "few-poses",
            Self::VerticalOnly => "vertical-only",
            Self::NoReference => "no-reference",
            Self::Paper => "paper",
            Self::Absolute => "absolute",
        }
    }

    /// A plan of this make for a machine.
    pub fn draw(self, hexapod: &Hexapod, rng: &mut Pcg64) -> Plan {
        let (training, holdout) = match self {
            Self::Paper => (paper_training(rng), paper_holdout(rng)),
            Self::Absolute => (absolute(hexapod, rng, 40, 2), absolute(hexapod, rng, 15, 1)),
            _ => {
                let loads = self.loads(rng);
                let poses = if self == Self::FewPoses { 10 } else { 18 };
                let reference = if self == Self::NoReference { 0.0 } else { PRELOAD_N };
                let mut part = |poses, repeats| rich(hexapod, rng, poses, repeats, &loads, reference);
                (part(poses, 2), part(poses / 3, 1))
            }
        };
        Plan { kind: self, training, holdout }
    }

    fn loads(self, rng: &mut Pcg64) -> Vec<Wrench> {
        match self {
            Self::VerticalOnly => [FULL_LOAD_N, HALF_LOAD_N, 50.0, 150.0].map(along_z).to_vec(),
            Self::OtherLoads => (0..6).map(|_| any_load(rng)).collect(),
            _ => usual_loads(),
        }
    }
}

fn along_z(newtons: f64) -> Wrench {
    Wrench::from_array([0.0, 0.0, newtons, 0.0, 0.0, 0.0])
}

/// Loads of the reference cases: two along z, two sideways, one about x, one lifting.
fn usual_loads() -> Vec<Wrench> {
    vec![
        along_z(FULL_LOAD_N),
        along_z(HALF_LOAD_N),
        Wrench::from_array([100.0, 0.0, PRELOAD_N, 0.0, 0.0, 0.0]),
        Wrench::from_array([0.0, 100.0, PRELOAD_N, 0.0, 0.0, 0.0]),
        Wrench::from_array([0.0, 0.0, PRELOAD_N, 10.0, 0.0, 0.0]),
        along_z(150.0),
    ]
}

fn any_load(rng: &mut Pcg64) -> Wrench {
    let mut spread = |half: f64| rounded(rng.random_range(-half..half));
    Wrench::from_array([spread(100.0), spread(100.0), spread(300.0), spread(10.0), spread(10.0), spread(5.0)])
}

/// A pose within +-30 mm, +-15 mm along z and +-8 deg, for a machine of the paper's size.
fn any_pose(hexapod: &Hexapod, rng: &mut Pcg64) -> Pose {
    const PAPER_SIZE_M: f64 = 0.1;
    let height = -hexapod.base_centre().z;
    let size = (hexapod.platform_radius().min(0.8 * height) / PAPER_SIZE_M).clamp(0.4, 3.0);
    let travel = 30.0 * if (0.7..1.3).contains(&size) { 1.0 } else { size };
    let mut spread = |half: f64| rounded(rng.random_range(-half..half));
    let mm = [spread(travel), spread(travel), spread(0.5 * travel)];
    pose(mm, [spread(8.0), spread(8.0), spread(8.0)])
}

fn pose(mm: [f64; 3], deg: [f64; 3]) -> Pose {
    let [a, b, c] = mm.map(|x| x * 1e-3);
    let [x, y, z] = deg.map(f64::to_radians);
    Pose::from_array([a, b, c, x, y, z])
}

fn normal(rng: &mut Pcg64) -> f64 {
    StandardNormal.sample(rng)
}

fn rich(
    hexapod: &Hexapod,
    rng: &mut Pcg64,
    poses: i64,
    repeats: i64,
    loads: &[Wrench],
    reference: f64,
) -> Vec<Row> {
    let mut rows = Vec::new();
    for pose_id in 1..=poses {
        let pose = any_pose(hexapod, rng);
        for &wrench in loads {
            let situation = Situation {
                reference: along_z(reference),
                approach: if rng.random_bool(0.5) { 1.0 } else { -1.0 },
                delta_t: rounded(0.3 * normal(rng)),
                elapsed: rounded(rng.random_range(5.0..300.0)),
                ..Situation::new(pose, wrench)
            };
            rows.extend((1..=repeats).map(|repeat| Row { pose_id, repeat, situation }));
        }
    }
    rows
}

fn absolute(hexapod: &Hexapod, rng: &mut Pcg64, poses: i64, repeats: i64) -> Vec<Row> {
    const LIGHT_LOAD_N: f64 = -49.05;
    let mut rows = Vec::new();
    for pose_id in 1..=poses {
        let pose = any_pose(hexapod, rng);
        for load in [LIGHT_LOAD_N, FULL_LOAD_N] {
            let situation = Situation::new(pose, along_z(load));
            rows.extend((1..=repeats).map(|repeat| Row { pose_id, repeat, situation }));
        }
    }
    rows
}

/// Table 1 of the paper.
fn paper_training(rng: &mut Pcg64) -> Vec<Row> {
    let poses = [
        pose([2.616, 0.832, -0.666], [0.0, 0.0, 15.756]),
        pose([10.017, -3.434, -0.764], [0.0, 0.0, -11.007]),
        pose([-7.784, -3.21, 1.76], [0.0, 0.0, -11.266]),
    ];
    let numbered = (1..).zip(poses).flat_map(|(id, p)| [1, 2, 3].map(|repeat| (id, repeat, p)));
    numbered.map(|(id, repeat, p)| paper_row(id, repeat, p, rng)).collect()
}

/// Table 3 of the paper.
fn paper_holdout(rng: &mut Pcg64) -> Vec<Row> {
    let steps = [-30.0, -15.0, 0.0, 15.0, 30.0];
    let along_a = steps.map(|x| pose([x, 0.0, 0.0], [0.0; 3]));
    let along_b = steps.map(|y| pose([0.0, y, 0.0], [0.0; 3]));
    let all = (1..).zip(along_a.into_iter().chain(along_b));
    all.map(|(id, p)| paper_row(id, 1, p, rng)).collect()
}

fn paper_row(pose_id: i64, repeat: i64, pose: Pose, rng: &mut Pcg64) -> Row {
    let situation = Situation {
        reference: along_z(PRELOAD_N),
        delta_t: rounded(0.1 * normal(rng)),
        elapsed: rounded(rng.random_range(20.0..60.0)),
        ..Situation::new(pose, along_z(FULL_LOAD_N))
    };
    Row { pose_id, repeat, situation }
}
