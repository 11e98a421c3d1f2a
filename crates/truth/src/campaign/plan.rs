//! Plans: which poses, under which loads, how often.

use hexbench_core::{Approach, Hexapod, Measurand, Observation, Pose, Wrench};
use rand::RngExt;
use rand_pcg::Pcg64;

use super::{Poses, Scheme, Spread, rounded, scheme};
use crate::Situation;

/// The paper's preload and full load, N along z.
const PRELOAD_N: f64 = -119.682;
const FULL_LOAD_N: f64 = -338.445;
const HALF_LOAD_N: f64 = -225.63;

/// One line of a plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlanRow {
    /// Number of the pose, from 1.
    pub pose_id: i64,
    /// Number of the repeat, from 1.
    pub repeat: i64,
    /// What is done.
    pub situation: Situation,
    /// Number of the reference reading that it shares; none: one of its own.
    pub reference_record: Option<i64>,
    /// Place in the sequence in which loads are put on; none: each row begins at the unloaded machine.
    pub order: Option<i64>,
}

impl PlanRow {
    /// A row of no sequence, read against a reference of its own.
    pub fn alone(pose_id: i64, repeat: i64, situation: Situation) -> Self {
        Self { pose_id, repeat, situation, reference_record: None, order: None }
    }

    /// True when the load is exceeded by another factor than usual first.
    pub fn states_overload(&self) -> bool {
        self.situation.overload.total_cmp(&Approach::OVERLOAD).is_ne()
    }

    /// The row before anything is read.
    pub fn unread(&self) -> Observation {
        self.read(0, [0.0; 6], None)
    }

    /// What was read in this row; `line` of its file, `measured` in m and rad.
    pub fn read(&self, line: u64, measured: [f64; 6], sigma: Option<[f64; 6]>) -> Observation {
        let Situation { pose, wrench, reference, approach, overload, delta_t, elapsed, reference_age } =
            self.situation;
        Observation {
            block: 0,
            pose_id: self.pose_id,
            repeat: self.repeat,
            line,
            pose,
            wrench,
            reference,
            approach,
            overload,
            delta_t,
            elapsed,
            reference_age,
            reference_record: self.reference_record,
            order: self.order,
            measured,
            sigma,
        }
    }
}

impl From<&Observation> for PlanRow {
    /// The row behind a reading.
    fn from(o: &Observation) -> Self {
        let Observation { pose, wrench, reference, approach, overload, .. } = *o;
        let Observation { delta_t, elapsed, reference_age, reference_record, order, .. } = *o;
        let situation =
            Situation { pose, wrench, reference, approach, overload, delta_t, elapsed, reference_age };
        Self { pose_id: o.pose_id, repeat: o.repeat, situation, reference_record, order }
    }
}

/// Makes of plans.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
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
pub struct MeasurementPlan {
    /// What is read.
    pub measurand: Measurand,
    /// Rows to learn from.
    pub training: Vec<PlanRow>,
    /// Rows to judge by.
    pub holdout: Vec<PlanRow>,
}

/// A scheme for the training part and one for the held-out part.
#[derive(Debug, Clone, PartialEq)]
pub struct Schemes {
    /// Rows to learn from.
    pub training: Scheme,
    /// Rows to judge by.
    pub holdout: Scheme,
}

hexbench_core::worded! {
    /// Name in the truth file.
    PlanKind::name {
        Rich => "rich",
        OtherLoads => "other-loads",
        FewPoses => "few-poses",
        VerticalOnly => "vertical-only",
        NoReference => "no-reference",
        Paper => "paper",
        Absolute => "absolute",
    }
}

impl PlanKind {
    /// What a plan of this make reads.
    pub fn measurand(self) -> Measurand {
        if self == Self::Absolute { Measurand::AbsolutePose } else { Measurand::DeflectionEuler }
    }

    /// A plan of this make for a machine.
    pub fn draw(self, hexapod: &Hexapod, rng: &mut Pcg64) -> MeasurementPlan {
        let Schemes { training, holdout } = self.schemes(hexapod, rng);
        MeasurementPlan {
            measurand: self.measurand(),
            training: training.draw(rng),
            holdout: holdout.draw(rng),
        }
    }

    /// What a plan of this make is drawn by; the generator decides the loads of [`PlanKind::OtherLoads`] only.
    pub fn schemes(self, hexapod: &Hexapod, rng: &mut Pcg64) -> Schemes {
        match self {
            Self::Paper => paper(),
            Self::Absolute => absolute(hexapod),
            _ => self.rich(hexapod, rng),
        }
    }

    fn rich(self, hexapod: &Hexapod, rng: &mut Pcg64) -> Schemes {
        let poses = if self == Self::FewPoses { 10 } else { 18 };
        let training = Scheme {
            poses: usual_poses(hexapod, poses),
            loads: self.loads(rng),
            reference: along_z(if self == Self::NoReference { 0.0 } else { PRELOAD_N }),
            repeats: 2,
            ..Scheme::varied()
        };
        let holdout = Scheme { poses: usual_poses(hexapod, poses / 3), repeats: 1, ..training.clone() };
        Schemes { training, holdout }
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

fn usual_poses(hexapod: &Hexapod, count: u64) -> Poses {
    Poses::Drawn { count, half_mm_deg: scheme::usual_half_range_mm_deg(hexapod) }
}

fn absolute(hexapod: &Hexapod) -> Schemes {
    const LIGHT_LOAD_N: f64 = -49.05;
    let training = Scheme {
        measurand: Measurand::AbsolutePose,
        poses: usual_poses(hexapod, 40),
        loads: [LIGHT_LOAD_N, FULL_LOAD_N].map(along_z).to_vec(),
        repeats: 2,
        ..Scheme::plain()
    };
    let holdout = Scheme { poses: usual_poses(hexapod, 15), repeats: 1, ..training.clone() };
    Schemes { training, holdout }
}

/// Tables 1 and 3 of the paper.
fn paper() -> Schemes {
    let best = [
        [2.616, 0.832, -0.666, 0.0, 0.0, 15.756],
        [10.017, -3.434, -0.764, 0.0, 0.0, -11.007],
        [-7.784, -3.21, 1.76, 0.0, 0.0, -11.266],
    ];
    let training = Scheme {
        poses: Poses::Listed(best.map(scheme::pose_of).to_vec()),
        loads: vec![along_z(FULL_LOAD_N)],
        reference: along_z(PRELOAD_N),
        repeats: 3,
        delta_t: Spread::Normal(0.1),
        elapsed: Spread::Even([20.0, 60.0]),
        anew: true,
        ..Scheme::plain()
    };
    let holdout = Scheme { poses: Poses::Listed(paper_validation()), repeats: 1, ..training.clone() };
    Schemes { training, holdout }
}

/// Poses of Table 3: along a, then along b.
fn paper_validation() -> Vec<Pose> {
    let steps = [-30.0, -15.0, 0.0, 15.0, 30.0];
    let along = |axis: usize| {
        steps.map(|step| scheme::pose_of(std::array::from_fn(|k| if k == axis { step } else { 0.0 })))
    };
    [along(0), along(1)].concat()
}
