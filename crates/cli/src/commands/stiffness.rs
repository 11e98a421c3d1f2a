//! `hexbench stiffness model.toml [--pose P [--map MM] | --poses POSES.csv]`.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use hexbench_core::files::CsvText;
use hexbench_core::{Dataset, Observation, Pose, Vector3, Wrench};
use hexbench_model::application::stiffness::{
    CartesianStiffness, StiffnessAxes, StiffnessPoint, cartesian_stiffness,
};
use hexbench_model::results::stiffness::StiffnessList;
use hexbench_report::table::{DataColumn, Frame, TableValues};
use hexbench_report::words::cartesian;

use crate::coverage::Coverage;
use crate::csv;
use crate::failure::Failure;
use crate::input::{self, TableNames, Trust};
use crate::numbers::{point, pose, within, wrench};
use crate::output::{OutFile, PageFiles, Screen, TableFile, write_json};
use crate::page::stiffness_map::{Mapped, square};

/// Show the stiffness of the platform at a pose: matrices, principal directions, uncertainty
///
/// The Cartesian stiffness matrix K maps small motions of a point of the platform to forces and moments at that point; the compliance
/// matrix C is its inverse. Both include the whole model: springs, effects, and their dependence on the load.
///
/// With `--poses`, the output is a table: a row for every pose and load of the file, with the principal stiffnesses and both matrices.
/// With `--map`, it is the same table for 81 poses around one, and a page of maps: stiffness, its uncertainty, deflection under load.
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  hexbench stiffness model.toml\n  \
    hexbench stiffness model.toml --pose 10,0,-5,0,0,15 --load 0,0,-200,0,0,0 --point 0,0,80\n  \
    hexbench stiffness model.toml --poses poses.csv --coverage 95 -o stiffness.csv\n  \
    hexbench stiffness model.toml --map 20 --load 0,0,-200,0,0,0 --html map.html -o map.csv")]
pub(crate) struct Arguments {
    /// The model that `fit` saved: model.toml
    model: PathBuf,
    #[command(flatten)]
    trust: Trust,
    /// Pose (mm, deg): a,b,c,alpha,beta,gamma
    #[arg(long, value_name = "POSE", value_parser = pose, allow_hyphen_values = true, default_value = "0,0,0,0,0,0")]
    pose: Pose,
    /// Load at which the stiffness is computed, force (N) and moment (N m) at the mobile origin: fx,fy,fz,mx,my,mz
    #[arg(long, value_name = "WRENCH", value_parser = wrench, allow_hyphen_values = true, default_value = "0,0,0,0,0,0")]
    load: Wrench,
    /// Poses and loads instead of a single one: measurements.csv without the measured columns
    #[arg(long, value_name = "FILE", group = "many", conflicts_with_all = ["pose", "load"])]
    poses: Option<PathBuf>,
    /// Map the square in x and y that extends this far from the pose, mm
    #[arg(long, value_name = "MM", group = "many", value_parser = reach)]
    map: Option<f64>,
    #[command(flatten)]
    names: TableNames,
    /// Point of the platform where forces act and motions are stated, mobile frame, mm: x,y,z
    #[arg(long, value_name = "POINT", value_parser = point, allow_hyphen_values = true, default_value = "0,0,0")]
    point: Vector3,
    /// Axes of forces and motions
    #[arg(long, value_enum, default_value = "fixed")]
    axes: Axes,
    /// Size of the small forces, N; choose it larger than any play or friction that you want to ignore
    #[arg(long, value_name = "N", value_parser = size, default_value = "1")]
    amplitude: f64,
    #[command(flatten)]
    coverage: Coverage,
    /// Write the table of `--poses` or `--map` to FILE instead of standard output: CSV, or Parquet where its name ends in .parquet
    #[arg(short, long, value_name = "FILE", requires = "many")]
    output: Option<OutFile>,
    /// Write stiffness.json to FILE, or to standard output (-) instead of page or table
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    #[command(flatten)]
    page: PageFiles,
}

fn reach(text: &str) -> Result<f64, String> {
    within(text, 1e-3..=1e4, "0.001 to 10000 mm")
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Axes {
    /// Of the fixed frame
    Fixed,
    /// Of the mobile frame at the pose
    Mobile,
}

fn size(text: &str) -> Result<f64, String> {
    within(text, 1e-3..=1e6, "0.001 to 1000000 N")
}

/// Ask the model, tell.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let model = arguments.trust.model(&arguments.model)?;
    let axes = match arguments.axes {
        Axes::Fixed => StiffnessAxes::Fixed,
        Axes::Mobile => StiffnessAxes::Mobile,
    };
    let at = StiffnessPoint { point: arguments.point, axes, amplitude: arguments.amplitude };
    let wide = arguments.coverage.of(model.noise.dof_beside(model.dof));
    let at_pose = |pose: Pose| Observation::unread(pose, arguments.load, Wrench::default());
    // Poses that no file states: the error names what was asked for instead of a line.
    let asked = |rows: &[Observation]| {
        cartesian_stiffness(&model, rows, &at).map_err(|error| {
            Failure::usage(
                format!("the model has no stiffness at this pose, point and load: {}", error.cause),
                "Choose poses that the legs can reach, a point near the platform, and a load that the legs can carry; where friction or play holds \
                 the platform, small forces larger than it: --amplitude 20.",
            )
        })
    };
    let shown = |rows: &Dataset, found: &[CartesianStiffness]| {
        let stated = model.hexapod.angles.as_stated(rows);
        if let Some(json) = &arguments.json {
            write_json(screen, Some(json), &StiffnessList::of(&rows.observations, found, &at))?;
        }
        let (factor, beginning) = (wide.factor, arguments.coverage.beginning());
        match (&arguments.output, &arguments.json) {
            (Some(output), _) => {
                let text = table(&stated, found, factor, &beginning);
                match TableFile::parquet(output) {
                    Some(file) => {
                        file.write(frame(&text), [&arguments.model].into_iter().chain(&arguments.poses))
                    }
                    None => screen.write_to(output, &text),
                }
            }
            (None, Some(_)) => Ok(()),
            (None, None) if arguments.page.to_stdout() => Ok(()),
            (None, None) => screen.write(&table(&stated, found, factor, &beginning)),
        }
    };
    if let Some(path) = &arguments.poses {
        let rows = input::conditions(path, &arguments.names, &model.hexapod)?;
        let found = cartesian_stiffness(&model, &rows.observations, &at).map_err(Failure::in_file(path))?;
        return shown(&rows, &found);
    }
    if let Some(mm) = arguments.map {
        let rows: Vec<Observation> = square(&arguments.pose, mm * 1e-3).into_iter().map(at_pose).collect();
        let found = asked(&rows)?;
        let map = Mapped { model: &model, rows: &rows, found: &found, at: &at, wide: &wide };
        arguments.page.write(screen, || map.page())?;
        return shown(&Dataset::of_deflections("map", rows), &found);
    }
    let rows = [at_pose(arguments.pose)];
    let found = asked(&rows)?;
    let page = || cartesian(&found[0], &arguments.pose, &arguments.load, &at, &wide);
    arguments.page.write(screen, || Ok(page()))?;
    match &arguments.json {
        Some(json) => write_json(screen, Some(json), &StiffnessList::of(&rows, &found, &at)),
        None => screen.show(&page()),
    }
}

/// The table for programs that read Parquet: a column of numbers for each name, which ends in its unit.
fn frame(text: &str) -> Frame {
    let mut lines = text.lines();
    let names = lines.next().unwrap_or_default().split(',');
    let mut columns: Vec<(&str, Vec<f64>)> = names.map(|name| (name, Vec::new())).collect();
    for line in lines {
        for ((_, values), cell) in columns.iter_mut().zip(line.split(',')) {
            values.push(cell.parse().unwrap_or(f64::NAN));
        }
    }
    let column = |(name, values): (&str, Vec<f64>)| {
        let [unit, meaning] = meaning(name);
        DataColumn::new(name, unit, meaning, TableValues::Numbers(values))
    };
    let columns = columns.into_iter().map(column).collect();
    Frame { format: "stiffness-table/1", origin: Vec::new(), columns }
}

/// Unit and meaning of a column by its name.
fn meaning(name: &str) -> [&'static str; 2] {
    const UNITS: [(&str, &str); 9] = [
        ("_N_per_m", "N/m"),
        ("_Nm_per_rad", "N m/rad"),
        ("_mm", "mm"),
        ("_deg", "deg"),
        ("_Nm", "N m"),
        ("_N", "N"),
        ("_K", "K"),
        ("_s", "s"),
        ("_SI", "SI: m, rad, N, N m"),
    ];
    let unit = UNITS.iter().find(|(end, _)| name.ends_with(end)).map_or("1", |(_, unit)| unit);
    let named = |beginning: &str| name.contains(beginning);
    // Uncertainties begin with their coverage.
    let meaning = if !name.starts_with(['K', 'C', 'k']) && (named("k_") || named("K_") || named("C_")) {
        "uncertainty of the column without this beginning"
    } else if named("_along_") {
        "component of the unit vector of this principal direction"
    } else if named("k_force_") {
        "stiffness against a force along this principal direction, the platform free to turn"
    } else if named("k_moment_") {
        "stiffness against a moment about this principal direction, the platform free to move"
    } else if named("K_") {
        "entry of the Cartesian stiffness matrix"
    } else if named("C_") {
        "entry of the Cartesian compliance matrix"
    } else {
        "of the condition"
    };
    [unit, meaning]
}

const MOTIONS: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// A row for every pose: principal stiffnesses with uncertainty, then both matrices, SI. Uncertainties are so many standard ones, and the
/// names of their columns begin so.
fn table(rows: &Dataset, found: &[CartesianStiffness], factor: f64, beginning: &str) -> String {
    let conditions = csv::condition_columns(rows);
    let principal = [("force", "N_per_m"), ("moment", "Nm_per_rad")].into_iter().flat_map(|(load, unit)| {
        (1..4).flat_map(move |k| {
            let direction = ["x", "y", "z"].map(|axis| format!("k_{load}_{k}_along_{axis}"));
            [format!("k_{load}_{k}_{unit}"), format!("{beginning}k_{load}_{k}_{unit}")]
                .into_iter()
                .chain(direction)
        })
    });
    let of = |name: String, rows: [&'static str; 6], columns: [&'static str; 6]| {
        rows.into_iter()
            .flat_map(move |row| columns.map(|column| format!("{name}_{row}_{column}_SI")))
            .collect::<Vec<_>>()
    };
    let matrices = [
        of("K".to_owned(), Wrench::NAMES, MOTIONS),
        of(format!("{beginning}K"), Wrench::NAMES, MOTIONS),
        of("C".to_owned(), MOTIONS, Wrench::NAMES),
        of(format!("{beginning}C"), MOTIONS, Wrench::NAMES),
    ];
    let mut text = CsvText::new(conditions.names().chain(principal).chain(matrices.into_iter().flatten()));
    for (row, k) in rows.observations.iter().zip(found) {
        let principal = k
            .of_forces
            .iter()
            .chain(&k.of_moments)
            .flat_map(|p| [p.stiffness, factor * p.std].into_iter().chain(p.direction.iter().copied()));
        let [stiffness_wide, compliance_wide] = [k.stiffness_std, k.compliance_std].map(|std| std * factor);
        let matrices = [&k.stiffness, &stiffness_wide, &k.compliance, &compliance_wide];
        let entries = matrices.into_iter().flat_map(|m| (0..36).map(|n| m[(n / 6, n % 6)]));
        let numbers = principal.chain(entries).map(|x| format!("{x:e}"));
        text.row(csv::condition(&conditions, row).into_iter().chain(numbers));
    }
    text.into_text()
}
