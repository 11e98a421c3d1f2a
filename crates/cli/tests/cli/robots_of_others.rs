//! `init --robot` on the numbers of models that others have made: joints and axes as their files have them, in files written here.

use std::fmt::Write as _;
use std::path::Path;
use std::{fs, process};

use hexbench_core::files::read_hexapod;
use hexbench_core::{Hexapod, Vector3};

use crate::support::{hexbench, text};

fn run(folder: &Path) -> process::Output {
    hexbench().current_dir(folder).args(["init", "--robot", "model", "-o", "hexapod.toml"]).output().unwrap()
}

fn made(model: &str) -> (Hexapod, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("model"), model).unwrap();
    let output = run(folder.path());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    text(output);
    (read_hexapod(&folder.path().join("hexapod.toml")).unwrap(), said)
}

fn lengths(machine: &Hexapod) -> [f64; 6] {
    std::array::from_fn(|leg| (machine.platform_joints[leg] - machine.base_joints[leg]).norm())
}

/// Distances of neighbours on one side.
fn sides(joints: &[Vector3; 6]) -> [f64; 6] {
    std::array::from_fn(|k| (joints[k] - joints[(k + 1) % 6]).norm())
}

/// Position in the body before and axis of each joint of each leg, m: two hinges, the slide, the hinge about it, two hinges.
///
/// Source: `stewart.xml` of <https://github.com/raincut/stewart_mujoco> at 3691c3b.
const STEWART_MUJOCO: [[[f64; 6]; 6]; 6] = [
    [
        [-0.160375, -0.15639, 0.064756, -0.5, -0.866025, -0.0],
        [0.032934, 0.010431, -0.010949, 0.783838, -0.452549, -0.425202],
        [0.067736, -0.040165, 0.228176, 0.366326, -0.215903, 0.905092],
        [0.000321, -0.000189, 0.000791, 0.366326, -0.215903, 0.905092],
        [0.036216, 0.003685, 0.030422, -0.845561, -0.483234, 0.226959],
        [-0.008779, -0.034675, 0.005815, 0.496404, -0.868091, 0.001097],
    ],
    [
        [-0.202875, -0.082778, 0.064756, -0.5, -0.866025, 0.0],
        [0.034413, 0.009577, 0.006111, 0.841279, -0.485713, 0.237344],
        [-0.022658, 0.116484, 0.210199, -0.004145, 0.433229, 0.901274],
        [-7e-06, 0.000739, 0.001537, -0.004145, 0.433229, 0.901274],
        [-5.1e-05, 0.040314, 0.025009, -0.004501, -0.901281, 0.433212],
        [-0.025864, -0.022876, 0.011002, -0.99999, 0.004146, -0.001764],
    ],
    [
        [-0.02975, 0.172916, 0.064756, 0.5, -0.866025, 0.0],
        [0.007354, 0.033691, 0.011142, 0.78075, 0.450766, 0.43271],
        [-0.110405, -0.062906, 0.20523, -0.376245, -0.213742, 0.901529],
        [-0.000635, -0.000361, 0.001522, -0.376245, -0.213742, 0.901529],
        [-0.014959, 0.016252, 0.041985, -0.003623, -0.97268, -0.232123],
        [0.025657, -0.02491, -0.005874, 0.99999, -0.004146, 0.001764],
    ],
    [
        [0.05525, 0.172916, 0.064756, 0.5, -0.866025, -0.0],
        [0.008963, 0.03462, -0.00587, 0.843228, 0.486838, -0.227936],
        [0.067087, -0.064862, 0.222617, 0.36999, -0.218018, 0.903092],
        [0.000657, -0.000387, 0.001605, 0.36999, -0.218018, 0.903092],
        [0.034701, -0.020313, 0.025178, -0.780368, 0.454538, 0.429443],
        [-0.006932, 0.033838, 0.010968, 0.503586, 0.863945, 0.000667],
    ],
    [
        [0.215625, -0.060694, 0.064756, 1.0, -0.0, -0.0],
        [-0.0255, -0.023275, 0.011014, -0.0, -0.903898, 0.427748],
        [-0.000998, 0.125936, 0.205924, -0.00416, 0.427745, 0.90389],
        [-7e-06, 0.000698, 0.001475, -0.00416, 0.427745, 0.90389],
        [0.021242, 0.004629, 0.042167, -0.83956, 0.489554, -0.235533],
        [-0.008441, 0.03473, -0.005989, 0.503586, 0.863945, 0.000667],
    ],
    [
        [0.173125, -0.134306, 0.064756, 1.0, -0.0, 0.0],
        [-0.0255, 0.025035, 0.006026, 0.0, 0.972225, 0.234048],
        [-0.091412, -0.076974, 0.209726, -0.380874, -0.216407, 0.898945],
        [-0.000704, -0.0004, 0.001662, -0.380874, -0.216407, 0.898945],
        [0.004656, 0.002732, 0.047133, -0.780129, -0.446658, -0.438059],
        [-0.007111, -0.033743, -0.011142, 0.496404, -0.868091, 0.001097],
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
            yaw: 1.571 - (0.5 * (3.142 - between) - half),
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
            [-2.62 - half, 2.618 + half, 3.142, 0.0],
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
