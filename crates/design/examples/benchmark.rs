//! Our side of `scripts/benchmark.sh`: starts of a search for poses, the search, and simulated campaigns.
//!
//! ```text
//! benchmark starts HEXAPOD SPACE COUNT                   coordinates of three poses per line, m and rad
//! benchmark search HEXAPOD SPACE STARTS                  value of O1 at the end of each start
//! benchmark campaigns HEXAPOD PLAN COUNT TOLERANCE_UM    mean and standard deviation of each stiffness, N/um
//! ```
#![allow(clippy::print_stdout, reason = "the output is the purpose")]

use std::error::Error;
use std::path::Path;

use hexbench_core::files::{read_conditions, read_hexapod};
use hexbench_core::{Hexapod, Pose, Vector6};
use hexbench_design::regressor::{SpringRegressor, Weights};
use hexbench_design::space_file::read_space;
use hexbench_design::{Criterion, Objective, PoseProblem, Space};
use hexbench_model::estimation::spring_trials::SpringTrials;

const POSES: usize = 3;
const SEED: u32 = 1;
/// Stiffnesses of Table 2 and noise as docs/results/paper.md has it: three balls on a circle of 120 mm, 1 um.
const STIFFNESS_N_PER_M: [f64; 6] = [4.1981e6, 3.7898e6, 2.7503e6, 4.32e6, 3.6716e6, 3.7288e6];
const SIGMA: [f64; 6] = [0.8165e-6, 0.8165e-6, 0.8165e-6, 9.6225e-6, 9.6225e-6, 6.8041e-6];

type Done = Result<(), Box<dyn Error>>;

fn main() -> Done {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        ["starts", machine, space, count] => starts(machine, space, count.parse()?),
        ["search", machine, space, starts] => search(machine, space, starts),
        ["campaigns", machine, plan, count, tolerance] => {
            campaigns(machine, plan, count.parse()?, tolerance.parse()?)
        }
        _ => Err("say starts, search or campaigns, as the head of this file tells".into()),
    }
}

fn problem(machine: &str, space: &str) -> Result<(Hexapod, Space), Box<dyn Error>> {
    let hexapod = read_hexapod(Path::new(machine))?;
    let space = read_space(Path::new(space), &hexapod)?;
    Ok((hexapod, space))
}

fn starts(machine: &str, space: &str, count: usize) -> Done {
    let (hexapod, space) = problem(machine, space)?;
    for set in space.poses(&hexapod, POSES * count, SEED)?.chunks(POSES) {
        let numbers: Vec<String> = set.iter().flat_map(|p| p.to_array()).map(|x| format!("{x:?}")).collect();
        println!("{}", numbers.join(","));
    }
    Ok(())
}

fn search(machine: &str, space: &str, starts: &str) -> Done {
    let (hexapod, space) = problem(machine, space)?;
    let regressor = SpringRegressor::new(&hexapod, &space.settings(), 1, Weights::UNWEIGHTED);
    let (criterion, known) = (&Objective::from(Criterion::O1), None);
    let problem = PoseProblem {
        hexapod: &hexapod,
        space: &space,
        regressor: &regressor,
        criterion,
        poses: POSES,
        known,
    };
    for line in std::fs::read_to_string(starts)?.lines() {
        let numbers: Vec<f64> = line.split(',').map(str::parse).collect::<Result<_, _>>()?;
        let pose = |x: &[f64]| Pose::from_array(std::array::from_fn(|k| x[k]));
        let start: Vec<Pose> = numbers.chunks(6).map(pose).collect();
        println!("{:?}", problem.climb(&start).map_or(0.0, |end| end.value));
    }
    Ok(())
}

fn campaigns(machine: &str, plan: &str, count: usize, tolerance_um: f64) -> Done {
    let hexapod = read_hexapod(Path::new(machine))?;
    let readings = read_conditions(Path::new(plan))?.dataset.observations;
    let trials = SpringTrials::new(&hexapod, &readings, &SIGMA, &STIFFNESS_N_PER_M)?
        .with_joint_tolerance(&hexapod, tolerance_um * 1e-6);
    let fitted = trials.run(count, SEED.into());
    let mean = fitted.iter().sum::<Vector6>() / count as f64;
    let squares = fitted.iter().map(|k| (k - mean).component_mul(&(k - mean))).sum::<Vector6>();
    let deviation = (squares / (count as f64 - 1.0)).map(f64::sqrt);
    for (mean, deviation) in mean.iter().zip(&deviation) {
        println!("{:?},{:?}", mean * 1e-6, deviation * 1e-6);
    }
    Ok(())
}
