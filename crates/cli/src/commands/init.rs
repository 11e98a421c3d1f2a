//! `hexbench init`: a hexapod.toml from the numbers of a drawing.

use std::io::{IsTerminal, Write, stderr, stdin};
use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_core::files::{MobileFrame, RobotJoints, hexapod_to_commented_toml, read_joints, read_robot};
use hexbench_core::{Hexapod, JointCircle, Metrology, Vector3};
use hexbench_model::results::check::check;
use hexbench_report::charts::{drawing, view_from_above};
use hexbench_report::number::significant;
use hexbench_report::{Block, Section, words};

use crate::failure::Failure;
use crate::first_plan::FirstPlan;
use crate::output::{OutPlace, Screen, report};

/// Joints nearer in height than this lie in one plane, m.
const ONE_PLANE: f64 = 1e-6;
/// Axes of a joint that miss each other by more are told, m: twice what joints are usually known to.
const MISS: f64 = 1e-4;

/// Write a hexapod.toml from the dimensions of a drawing, and show the machine for comparison
///
/// The dimensions are two rings with the joints in pairs or at given angles, a table of joints, or the model of a robot simulator. On a terminal, the command
/// asks for what is missing.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench init --base-radius 160 --base-gap 20 --platform-radius 120 --platform-gap 20 --height 165\n  \
    hexbench init --joints joints.csv -o machine/hexapod.toml --picture machine/machine.svg\n  \
    hexbench init --robot platform.urdf --plan --load 150")]
pub(crate) struct Arguments {
    /// Table of joints instead of rings: side (base or platform), leg (1 to 6), `x_mm`, `y_mm`, `z_mm`
    #[arg(long, value_name = "FILE", conflicts_with_all = ["base_radius", "platform_radius"])]
    joints: Option<PathBuf>,
    /// Model of a robot simulator instead (MJCF, URDF or SDF): its pose becomes the zero pose
    #[arg(long, value_name = "FILE", conflicts_with_all = ["joints", "base_radius", "platform_radius", "height"])]
    robot: Option<PathBuf>,
    #[command(flatten)]
    rings: Rings,
    /// Height of the platform joints above the base joints at the zero pose, mm
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    height: Option<f64>,
    /// Height of the mobile origin, at which poses and loads are stated, above the platform joints, mm; for rings, and for tables
    /// with --height
    #[arg(long, value_name = "MM", default_value_t = 0.0, allow_negative_numbers = true)]
    origin: f64,
    /// Standard deviation of one reading of a translation and of a rotation, um and urad
    #[arg(long, value_name = "UM,URAD", value_delimiter = ',', num_args = 1, allow_negative_numbers = true)]
    noise: Option<Vec<f64>>,
    /// Name of the machine [default: that of the model, otherwise "hexapod"]
    #[arg(long)]
    name: Option<String>,
    /// File to write; an existing file is never replaced
    #[arg(short, long, value_name = "FILE", default_value = "hexapod.toml")]
    output: OutPlace,
    #[command(flatten)]
    plan: FirstPlan,
    /// Also write a picture of the machine to FILE (SVG)
    #[arg(long, value_name = "FILE")]
    picture: Option<OutPlace>,
}

/// Two rings of joints, mm and degrees.
#[derive(Debug, Args)]
struct Rings {
    /// Radius of the circle of base joints, mm
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    base_radius: Option<f64>,
    /// Angle between the two base joints of a pair, degrees: legs 1 and 2 about the x axis, then 3 and 4, 5 and 6
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    base_gap: Option<f64>,
    /// Angles of the six base joints from the x axis instead, degrees
    #[arg(
        long,
        value_name = "DEG,...",
        value_delimiter = ',',
        allow_negative_numbers = true,
        conflicts_with = "base_gap"
    )]
    base_angles: Option<Vec<f64>>,
    /// Radius of the circle of platform joints, mm
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    platform_radius: Option<f64>,
    /// Angle between the two platform joints of a pair, degrees: legs 2 and 3, 4 and 5, 6 and 1
    #[arg(long, value_name = "DEG", allow_negative_numbers = true)]
    platform_gap: Option<f64>,
    /// Angles of the six platform joints from the x axis instead, degrees
    #[arg(
        long,
        value_name = "DEG,...",
        value_delimiter = ',',
        allow_negative_numbers = true,
        conflicts_with = "platform_gap"
    )]
    platform_angles: Option<Vec<f64>>,
}

/// Write the file and show the machine.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let plan = arguments.plan.files(&arguments.output)?;
    let paths = std::iter::once(&arguments.output).chain(&arguments.picture).map(|path| &***path);
    for path in paths.chain(plan.iter().map(PathBuf::as_path)) {
        Screen::refuse_existing(path, "Name another file with -o or --picture, or remove this one.")?;
    }
    let hexapod = hexapod(arguments)?;
    let source = arguments.output.display().to_string();
    let found = check(&hexapod, None, None, &[], &[]).map_err(Failure::of_model(&source))?;
    screen.write_with_folder(&arguments.output, &hexapod_to_commented_toml(&hexapod))?;
    if let Some(path) = &arguments.picture {
        screen.write_with_folder(path, &drawing(&hexapod)?)?;
    }
    arguments.plan.write(&hexapod, &arguments.output, screen)?;
    if arguments.output.is_stdout() {
        return Ok(());
    }
    let view = Section::new("From above")
        .id("above")
        .remark(
            "zero pose; 1 to 6: base joints, a to f: platform joints of the same legs; x to the right, y up",
        )
        .with(Block::Code { text: view_from_above(&hexapod) });
    let next = Section::new("Next")
        .paragraph(
            "Compare the numbers and the picture with the drawing, and correct the file where they differ.",
        )
        .with(Block::Code { text: arguments.plan.next(&hexapod, &arguments.output) });
    screen.show(&words::check(&hexapod.name, &found).with(view).with(next))
}

fn hexapod(arguments: &Arguments) -> Result<Hexapod, Failure> {
    let mut name = arguments.name.clone();
    let [base, platform] = match (&arguments.joints, &arguments.robot) {
        (Some(path), _) => of_table(path, arguments)?,
        (None, Some(path)) => {
            let found = read_robot(path)?;
            tell(path, &found);
            name = name.or(Some(found.name));
            let up = Vector3::z() * (arguments.origin * 1e-3);
            [found.base_joints, found.platform_joints].map(|joints| joints.map(|joint| joint - up))
        }
        (None, None) => of_rings(arguments)?,
    };
    let mut hexapod = Hexapod::of_joints(name.unwrap_or_else(|| "hexapod".to_owned()), base, platform);
    hexapod.metrology = noise(arguments.noise.as_deref())?;
    Ok(hexapod)
}

/// What was taken for what in the model of a robot.
fn tell(path: &Path, found: &RobotJoints) {
    let mobile = match &found.mobile {
        MobileFrame::Body(name) => format!("the frame of {name}"),
        MobileFrame::Centre => "the center of the platform joints, with the axes of the model".to_owned(),
    };
    let file = path.display();
    report::note(&format!(
        "{file}: legs 1 to 6 are {}; poses and loads refer to {mobile}, and the pose of the model is the zero pose",
        found.legs.join(", ")
    ));
    if found.miss > MISS {
        let miss = significant(found.miss * 1e3, 2);
        report::warn(
            &format!(
                "{file}: the axes of a joint miss each other by {miss} mm; the joint was placed between them"
            ),
            "A universal joint whose axes do not meet is no point: see whether the model or the machine is so.",
        );
    }
}

/// Joints as the table has them; with a height, the planes of both sides are put where it says.
fn of_table(path: &Path, arguments: &Arguments) -> Result<[[Vector3; 6]; 2], Failure> {
    let mut sides = read_joints(path)?;
    let mean = |joints: &[Vector3; 6]| joints.iter().map(|joint| joint.z).sum::<f64>() / 6.0;
    let means = sides.each_ref().map(mean);
    match arguments.height.map(positive_mm("--height")).transpose()? {
        Some(height) => {
            let moves = means.into_iter().zip(planes(height, arguments)).map(|(mean, plane)| plane - mean);
            for (joints, up) in sides.iter_mut().zip(moves) {
                *joints = joints.map(|joint| joint + Vector3::z() * up);
            }
        }
        None if (means[0] - means[1]).abs() < ONE_PLANE => {
            return Err(Failure::usage(
                format!(
                    "{}: base and platform joints lie in one plane: the legs have no height",
                    path.display()
                ),
                "Each side is given in its own frame: add --height, how far the platform joints are over the base joints at the zero pose.",
            ));
        }
        None => {}
    }
    Ok(sides)
}

fn of_rings(arguments: &Arguments) -> Result<[[Vector3; 6]; 2], Failure> {
    let asked = Asked::of(arguments)?;
    let [base, platform] = planes(asked.height, arguments);
    Ok([asked.base.joints(base), asked.platform.joints(platform)].map(|joints| joints.map(rounded)))
}

/// To a tenth of a nanometer: digits behind it are those of sines.
fn rounded(joint: Vector3) -> Vector3 {
    // Adding zero makes a zero of -0.
    joint.map(|x| (x * 1e10).round() / 1e10 + 0.0)
}

/// Heights of base and platform joints over the origin at the zero pose, m.
fn planes(height: f64, arguments: &Arguments) -> [f64; 2] {
    let platform = -arguments.origin * 1e-3;
    [platform - height, platform]
}

/// What rings take, from the command line or from whoever sits at the terminal.
struct Asked {
    base: JointCircle,
    platform: JointCircle,
    height: f64,
}

impl Asked {
    fn of(arguments: &Arguments) -> Result<Self, Failure> {
        let rings = &arguments.rings;
        Ok(Self {
            base: ring(
                "base",
                (rings.base_radius, rings.base_gap, rings.base_angles.as_deref()),
                JointCircle::base_pairs,
            )?,
            platform: ring(
                "platform",
                (rings.platform_radius, rings.platform_gap, rings.platform_angles.as_deref()),
                JointCircle::platform_pairs,
            )?,
            height: positive_mm("--height")(given_or_asked(
                arguments.height,
                "--height",
                "Height of the platform joints above the base joints at the zero pose, mm",
            )?)?,
        })
    }
}

fn ring(
    side: &str,
    (radius, gap, angles): (Option<f64>, Option<f64>, Option<&[f64]>),
    of_pairs: impl Fn(f64, f64) -> JointCircle,
) -> Result<JointCircle, Failure> {
    let name = format!("--{side}-radius");
    let radius = given_or_asked(radius, &name, &format!("Radius of the circle of {side} joints, mm"))?;
    let radius = positive_mm(&name)(radius)?;
    if let Some(angles) = angles {
        let six: [f64; 6] = angles.try_into().map_err(|_| {
            Failure::usage(
                format!("--{side}-angles has {} numbers, it needs six", angles.len()),
                "Enter one angle per leg, in order.",
            )
        })?;
        return Ok(JointCircle { radius, angles: six.map(f64::to_radians) });
    }
    let name = format!("--{side}-gap");
    let question = format!("Angle between the two {side} joints of a pair, degrees");
    let gap = given_or_asked(gap, &name, &question)?;
    if !(gap > 0.0 && gap < 120.0) {
        return Err(Failure::usage(
            format!("{name} {gap}: the angle lies between 0 and 120 degrees"),
            "See the drawing from above.",
        ));
    }
    Ok(of_pairs(radius, gap.to_radians()))
}

fn given_or_asked(given: Option<f64>, name: &str, question: &str) -> Result<f64, Failure> {
    if let Some(value) = given {
        return Ok(value);
    }
    if !stdin().is_terminal() {
        return Err(Failure::usage(
            format!("{name} is missing"),
            "Add it, or --joints with a table of joints; `hexbench init --help` shows examples.",
        ));
    }
    loop {
        let _ = write!(stderr(), "{question}: ").and_then(|()| stderr().flush());
        let mut line = String::new();
        let read = stdin().read_line(&mut line);
        if !matches!(read, Ok(bytes) if bytes > 0) {
            return Err(Failure::usage(
                format!("{name} is missing"),
                "Answer the question, or add the option on the command line.",
            ));
        }
        if let Ok(value) = line.trim().replace(',', ".").parse::<f64>() {
            return Ok(value);
        }
        let _ = writeln!(stderr(), "Write a number such as 160 or 22.5.");
    }
}

fn positive_mm(name: &str) -> impl Fn(f64) -> Result<f64, Failure> + '_ {
    move |mm| {
        if mm.is_finite() && mm > 0.0 {
            Ok(mm * 1e-3)
        } else {
            Err(Failure::usage(
                format!("{name} {mm}: a length is positive"),
                "Enter it in mm, as in the drawing.",
            ))
        }
    }
}

fn noise(given: Option<&[f64]>) -> Result<Option<Metrology>, Failure> {
    match given {
        None => Ok(None),
        Some(&[um, urad]) if um > 0.0 && urad > 0.0 && (um + urad).is_finite() => {
            Ok(Some(Metrology { sigma_translation: um * 1e-6, sigma_rotation: urad * 1e-6 }))
        }
        Some(_) => Err(Failure::usage(
            "--noise needs two positive numbers".to_owned(),
            "Write for example --noise 0.5,3 for 0.5 um and 3 urad.",
        )),
    }
}
