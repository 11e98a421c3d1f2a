//! Cartesian stiffness of the platform at one pose.

use hexbench_core::{Matrix6, Pose, Wrench};
use hexbench_model::application::stiffness::{CartesianStiffness, PrincipalStiffness, StiffnessPoint};

use super::plus_minus::Wide;
use crate::number::{rounded, significant, stated, with_uncertainty};
use crate::page::{Block, Mood, Page, Section, Table};

/// Difference of what opposite small loads move, relative to the larger, above which it is told.
const LOPSIDED: f64 = 0.05;

/// Factor of each entry of a matrix from SI to what is shown.
type Entries<'a> = &'a dyn Fn(usize, usize) -> f64;

/// The platform at a pose under a load: principal stiffnesses first, then both matrices with their uncertainties.
pub fn cartesian(
    k: &CartesianStiffness,
    pose: &Pose,
    load: &Wrench,
    at: &StiffnessPoint,
    wide: &Wide,
) -> Page {
    about(Page::new("Stiffness of the platform"), pose, load, at)
        .with(lopsided(std::slice::from_ref(k), at))
        .with(principal(k, wide))
        .with(matrix(
            "Stiffness matrix K",
            "force (N) and moment (N m) per um or mrad of one motion, with the others held at zero",
            &FORCES,
            &MOTIONS,
            [&k.stiffness, &(k.stiffness_std * wide.factor)],
            &stiffness_unit,
            wide,
        ))
        .with(matrix(
            "Compliance matrix C",
            "motion (um, mrad) for 1 N or 1 N m along one axis",
            &MOTIONS,
            &FORCES,
            [&k.compliance, &(k.compliance_std * wide.factor)],
            &compliance_unit,
            wide,
        ))
}

/// A warning where small loads of both signs move the platform differently: no single matrix tells what it does.
pub fn lopsided(found: &[CartesianStiffness], at: &StiffnessPoint) -> Option<Section> {
    let most = found.iter().map(|k| k.lopsided).fold(0.0, f64::max);
    (most > LOPSIDED).then(|| {
        let text = format!(
            "A small load and its opposite move the platform differently, by up to {} %: friction, play or a contact. The numbers are means \
             of both and depend on the size of the small forces, {} N now (`--amplitude`).",
            significant(100.0 * most, 2),
            significant(at.amplitude, 3)
        );
        Section::lead().with(Block::colored(Mood::Doubt, text))
    })
}

/// Where the platform is, what acts on it and at which point it is asked about.
pub fn about(page: Page, pose: &Pose, load: &Wrench, at: &StiffnessPoint) -> Page {
    let pose = pose.to_array();
    let shift = listed(pose[..3].iter().map(|m| m * 1e3));
    let turn = listed(pose[3..].iter().map(|rad| rad.to_degrees()));
    let load = load.to_array();
    let (force, moment) = (listed(load[..3].iter().copied()), listed(load[3..].iter().copied()));
    let point = listed(at.point.iter().map(|m| m * 1e3));
    page.about("pose", format!("a, b, c: {shift} mm; alpha, beta, gamma: {turn} deg"))
        .about("load", format!("force {force} N, moment {moment} N m at the mobile origin"))
        .about("point", format!("{point} mm in the mobile frame; axes of the {} frame", at.axes.word()))
}

const FORCES: [&str; 6] = ["fx, N", "fy, N", "fz, N", "mx, N m", "my, N m", "mz, N m"];
const MOTIONS: [&str; 6] = ["x, um", "y, um", "z, um", "rx, mrad", "ry, mrad", "rz, mrad"];

fn listed(numbers: impl Iterator<Item = f64>) -> String {
    const DECIMALS: i32 = 9;
    numbers.map(|x| stated(x, DECIMALS)).collect::<Vec<_>>().join(", ")
}

/// From SI: a column is for a um or a mrad.
fn stiffness_unit(_: usize, column: usize) -> f64 {
    if column < 3 { 1e-6 } else { 1e-3 }
}

/// From SI: a row is in um or mrad.
fn compliance_unit(row: usize, _: usize) -> f64 {
    if row < 3 { 1e6 } else { 1e3 }
}

fn principal(k: &CartesianStiffness, wide: &Wide) -> Section {
    let row = |name: &str, unit: &str, scale: f64, p: &PrincipalStiffness| {
        let [value, std] = with_uncertainty(p.stiffness * scale, wide.factor * p.std * scale);
        let direction = p.direction.iter().map(|x| format!("{:.3}", x + 0.0)).collect::<Vec<_>>().join(", ");
        [name.to_owned(), format!("{value} +- {std} {unit}"), direction]
    };
    let forces = k.of_forces.iter().map(|p| row("force", "N/um", 1e-6, p));
    let moments = k.of_moments.iter().map(|p| row("moment", "N m/mrad", 1e-3, p));
    let table =
        Table::named(["", "stiffness", "along, about"]).words_in(1).words_in(2).rows(forces.chain(moments));
    Section::new("Principal stiffnesses")
        .id("principal")
        .remark(format!("softest first; {}", wide.remark()))
        .paragraph("For a force through the point while the platform is free to rotate, and for a moment while it is free to translate.")
        .table(table)
}

fn matrix(
    title: &str,
    remark: &str,
    rows: &[&str; 6],
    columns: &[&str; 6],
    [value, std]: [&Matrix6; 2],
    unit: Entries<'_>,
    wide: &Wide,
) -> Section {
    let shown = |of: &dyn Fn(usize, usize) -> String| {
        let header = std::iter::once("").chain(columns.iter().copied());
        let row = |i: usize| {
            std::iter::once(rows[i].to_owned()).chain((0..6).map(move |j| (i, j)).map(|(i, j)| of(i, j)))
        };
        let rows: Vec<Vec<String>> = (0..6).map(|i| row(i).collect()).collect();
        Table::named(header).rows(rows)
    };
    let values = shown(&|i, j| rounded(value[(i, j)] * unit(i, j), std[(i, j)] * unit(i, j)));
    let uncertain = shown(&|i, j| significant(std[(i, j)] * unit(i, j), 2));
    Section::new(title).remark(remark).table(values).table(uncertain.titled(wide.words.as_str()))
}
