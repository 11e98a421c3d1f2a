//! `init --robot` on the numbers of models that others have made: joints and axes as their files have them, in files written here.

use std::fmt::Write as _;
use std::path::Path;
use std::{fs, process};

use hexbench_core::files::read_hexapod;
use hexbench_core::{Hexapod, Vector3};

use crate::support::{complaint, hexbench, text};

fn run(folder: &Path) -> process::Output {
    hexbench().current_dir(folder).args(["init", "--robot", "model", "-o", "hexapod.toml"]).output().unwrap()
}

fn made(model: &str) -> (Hexapod, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("model"), model).unwrap();
    let output = run(folder.path());
    let said = complaint(&output);
    text(output);
    (read_hexapod(&folder.path().join("hexapod.toml")).unwrap(), said)
}

fn lengths(machine: &Hexapod) -> [f64; 6] {
    std::array::from_fn(|leg| (machine.platform_joints[leg] - machine.base_joints[leg]).norm())
}

/// Distances of neighbors on one side.
fn sides(joints: &[Vector3; 6]) -> [f64; 6] {
    std::array::from_fn(|k| (joints[k] - joints[(k + 1) % 6]).norm())
}

/// Position in the body before and axis of each joint of each leg, m: two hinges, the slide, the hinge about it, two hinges.
///
/// Source: `stewart.xml` of <https://github.com/raincut/stewart_mujoco> at 3691c3b.
const STEWART_MUJOCO: [[[f64; 6]; 6]; 6] = [
    [
        [-0.160_375, -0.15639, 0.064_756, -0.5, -0.866_025, -0.0],
        [0.032_934, 0.010_431, -0.010_949, 0.783_838, -0.452_549, -0.425_202],
        [0.067_736, -0.040_165, 0.228_176, 0.366_326, -0.215_903, 0.905_092],
        [0.000_321, -0.000_189, 0.000_791, 0.366_326, -0.215_903, 0.905_092],
        [0.036_216, 0.003_685, 0.030_422, -0.845_561, -0.483_234, 0.226_959],
        [-0.008_779, -0.034_675, 0.005_815, 0.496_404, -0.868_091, 0.001_097],
    ],
    [
        [-0.202_875, -0.082_778, 0.064_756, -0.5, -0.866_025, 0.0],
        [0.034_413, 0.009_577, 0.006_111, 0.841_279, -0.485_713, 0.237_344],
        [-0.022_658, 0.116_484, 0.210_199, -0.004_145, 0.433_229, 0.901_274],
        [-7e-06, 0.000_739, 0.001_537, -0.004_145, 0.433_229, 0.901_274],
        [-5.1e-05, 0.040_314, 0.025_009, -0.004_501, -0.901_281, 0.433_212],
        [-0.025_864, -0.022_876, 0.011_002, -0.99999, 0.004_146, -0.001_764],
    ],
    [
        [-0.02975, 0.172_916, 0.064_756, 0.5, -0.866_025, 0.0],
        [0.007_354, 0.033_691, 0.011_142, 0.78075, 0.450_766, 0.43271],
        [-0.110_405, -0.062_906, 0.20523, -0.376_245, -0.213_742, 0.901_529],
        [-0.000_635, -0.000_361, 0.001_522, -0.376_245, -0.213_742, 0.901_529],
        [-0.014_959, 0.016_252, 0.041_985, -0.003_623, -0.97268, -0.232_123],
        [0.025_657, -0.02491, -0.005_874, 0.99999, -0.004_146, 0.001_764],
    ],
    [
        [0.05525, 0.172_916, 0.064_756, 0.5, -0.866_025, -0.0],
        [0.008_963, 0.03462, -0.00587, 0.843_228, 0.486_838, -0.227_936],
        [0.067_087, -0.064_862, 0.222_617, 0.36999, -0.218_018, 0.903_092],
        [0.000_657, -0.000_387, 0.001_605, 0.36999, -0.218_018, 0.903_092],
        [0.034_701, -0.020_313, 0.025_178, -0.780_368, 0.454_538, 0.429_443],
        [-0.006_932, 0.033_838, 0.010_968, 0.503_586, 0.863_945, 0.000_667],
    ],
    [
        [0.215_625, -0.060_694, 0.064_756, 1.0, -0.0, -0.0],
        [-0.0255, -0.023_275, 0.011_014, -0.0, -0.903_898, 0.427_748],
        [-0.000_998, 0.125_936, 0.205_924, -0.00416, 0.427_745, 0.90389],
        [-7e-06, 0.000_698, 0.001_475, -0.00416, 0.427_745, 0.90389],
        [0.021_242, 0.004_629, 0.042_167, -0.83956, 0.489_554, -0.235_533],
        [-0.008_441, 0.03473, -0.005_989, 0.503_586, 0.863_945, 0.000_667],
    ],
    [
        [0.173_125, -0.134_306, 0.064_756, 1.0, -0.0, 0.0],
        [-0.0255, 0.025_035, 0.006_026, 0.0, 0.972_225, 0.234_048],
        [-0.091_412, -0.076_974, 0.209_726, -0.380_874, -0.216_407, 0.898_945],
        [-0.000_704, -0.0004, 0.001_662, -0.380_874, -0.216_407, 0.898_945],
        [0.004_656, 0.002_732, 0.047_133, -0.780_129, -0.446_658, -0.438_059],
        [-0.007_111, -0.033_743, -0.011_142, 0.496_404, -0.868_091, 0.001_097],
    ],
];

/// The model of [`STEWART_MUJOCO`] as MJCF: the platform hangs on the first leg, welds close the others.
fn mjcf() -> String {
    let mut text = String::from("<mujoco><worldbody><body name=\"base\">\n");
    for (n, leg) in (1..).zip(STEWART_MUJOCO) {
        for (k, [x, y, z, u, v, w]) in leg.into_iter().enumerate() {
            let kind = if k == 2 { "slide" } else { "hinge" };
            let _ = writeln!(
                text,
                "<body name=\"l{n}_{k}\" pos=\"{x} {y} {z}\"><joint name=\"j{n}_{k}\" type=\"{kind}\" axis=\"{u} {v} {w}\"/>"
            );
        }
        if n == 1 {
            text.push_str("<body name=\"top\" pos=\"-0.012852 0.022363 0.039728\"/>");
        }
        text.push_str(&"</body>".repeat(leg.len()));
    }
    text.push_str("</body></worldbody><equality>\n");
    (2..=6).for_each(|n| {
        let _ = writeln!(text, "<weld body1=\"l{n}_5\" body2=\"top\"/>");
    });
    text + "</equality></mujoco>\n"
}

/// The drawing behind the file: on each side pairs of joints 85 mm apart, 295.25 mm from pair to pair, in one plane.
#[test]
fn the_machine_of_stewart_mujoco_has_the_pairs_of_its_drawing() {
    let (machine, _) = made(&mjcf());
    for joints in [&machine.base_joints, &machine.platform_joints] {
        let mut apart = sides(joints).map(|metres| metres * 1e3);
        apart.sort_by(f64::total_cmp);
        for (k, mm) in apart.into_iter().enumerate() {
            let drawn = if k < 3 { 85.0 } else { 295.25 };
            assert!((mm - drawn).abs() < 0.02, "{mm} for {drawn} mm");
        }
    }
    assert!(machine.base_joints.iter().all(|a| (a.z - machine.base_joints[0].z).abs() < 1e-6));
    // The legs of the file differ by 1 mm among themselves.
    assert!(lengths(&machine).iter().all(|l| (l - 0.2814).abs() < 6e-4), "{:?}", lengths(&machine));
}

/// The machine of the SDF template: six pistons between two plates.
///
/// Source: parameters and poses of `sdf/stewart/model.sdf.erb` of <https://github.com/daniel-s-ingram/stewart> at f276d04.
struct Pistons {
    /// Distance of a ball from the axis of its plate.
    ball: f64,
    /// Half the angle between two balls of a pair.
    half: f64,
    /// Distance of the middle of a piston from the axis.
    middle: f64,
    pitch: f64,
    yaw: f64,
    length: f64,
}

const BASE_HEIGHT: f64 = 0.25;
const PLATFORM_HEIGHT: f64 = 0.1;
const APART: f64 = 2.0;
/// Half a turn, with the digits of the template.
const HALF_TURN: f64 = 3142e-3;

impl Pistons {
    fn of_the_template() -> Self {
        let (base_radius, ball_radius): (f64, f64) = (1.0, 0.1);
        let ball = (base_radius.powi(2) - 4.0 * base_radius * ball_radius + 5.0 * ball_radius.powi(2)).sqrt();
        let half = (ball_radius / (base_radius - 2.0 * ball_radius)).asin();
        let between = 1.047 - 2.0 * half;
        let separation = ball * (2.0 - 2.0 * between.cos()).sqrt();
        let height = APART - 0.5 * BASE_HEIGHT - 0.5 * PLATFORM_HEIGHT;
        Self {
            ball,
            half,
            middle: (ball.powi(2) - (0.5 * separation).powi(2)).sqrt(),
            pitch: 1.571 - (height / separation).atan(),
            yaw: 1.571 - (0.5 * (HALF_TURN - between) - half),
            length: height.hypot(separation),
        }
    }

    /// Of each leg: directions of its balls below and above and of its middle, and its yaw.
    fn legs(&self) -> [[f64; 4]; 6] {
        let (half, turned) = (self.half, 1.571 + self.yaw);
        [
            [1.571 + half, 2.618 - half, 1.571 + 0.526, turned],
            [1.571 - half, 0.524 + half, 1.571 - 0.526, -turned],
            [-0.524 + half, 0.524 - half, 0.0, 0.0],
            [-0.524 - half, 4.712 + half, -1.047, turned],
            [-2.62 + half, 4.712 - half, -2.094, -turned],
            [-2.62 - half, 2.618 + half, HALF_TURN, 0.0],
        ]
    }

    fn sdf(&self) -> String {
        let mut text = String::from("<sdf version=\"1.5\"><model name=\"stewart\">\n");
        let mut link = |name: &str, pose: [f64; 6]| {
            let [x, y, z, r, p, w] = pose;
            let _ = writeln!(text, "<link name=\"{name}\"><pose>{x} {y} {z} {r} {p} {w}</pose></link>");
        };
        let on = |radius: f64, turn: f64| [radius * turn.cos(), radius * turn.sin()];
        link("base_link", [0.0, 0.0, 0.5 * BASE_HEIGHT, 0.0, 0.0, 0.0]);
        link("platform_link", [0.0, 0.0, 0.5 * BASE_HEIGHT + APART, 0.0, 0.0, 0.0]);
        for (n, [below, above, middle, yaw]) in (1..).zip(self.legs()) {
            let top = 0.5 * BASE_HEIGHT + APART - 0.5 * PLATFORM_HEIGHT;
            let [[ax, ay], [bx, by], [x, y]] =
                [on(self.ball, below), on(self.ball, above), on(self.middle, middle)];
            link(&format!("low{n}"), [ax, ay, BASE_HEIGHT, 0.0, 0.0, yaw]);
            link(&format!("high{n}"), [bx, by, top, 0.0, 0.0, yaw]);
            for part in ["cylinder", "shaft"] {
                link(&format!("{part}{n}"), [x, y, 0.5 * (BASE_HEIGHT + APART), -self.pitch, 0.0, yaw]);
            }
        }
        for n in 1..=6 {
            let half = 0.5 * self.length;
            for (kind, parent, child, z, axis) in [
                ("revolute", "base_link", format!("low{n}"), 0.0, "0 1 0"),
                ("revolute", &*format!("low{n}"), format!("cylinder{n}"), -half, "1 0 0"),
                ("prismatic", &*format!("cylinder{n}"), format!("shaft{n}"), 0.0, "0 0 1"),
                ("revolute", &*format!("high{n}"), format!("shaft{n}"), half, "1 0 0"),
                ("revolute", "platform_link", format!("high{n}"), 0.0, "0 1 0"),
            ] {
                let _ = writeln!(
                    text,
                    "<joint name=\"{kind}_{parent}_{n}\" type=\"{kind}\"><parent>{parent}</parent><child>{child}</child>\
                     <pose>0 0 {z} 0 0 0</pose><axis><xyz>{axis}</xyz></axis></joint>"
                );
            }
        }
        text + "</model></sdf>\n"
    }
}

#[test]
fn the_pistons_of_an_sdf_template_are_as_long_as_it_says_and_its_gaps_are_told() {
    let pistons = Pistons::of_the_template();
    let (machine, said) = made(&pistons.sdf());
    for length in lengths(&machine) {
        assert!((length - pistons.length).abs() < 1e-3, "{length} for {}", pistons.length);
    }
    // Angles such as 1.571 and a pitch about the wrong point: the axes miss each other.
    assert!(said.contains("miss"), "{said}");
}
