//! The numbers behind every table and figure, and the readings themselves.

use std::io;

use hexbench_core::Dataset;
use hexbench_core::files::{CsvText, hexapod_to_toml, measurements_to_csv};

use super::super::curves::{Linearity, ValidationPose};
use super::super::missing::DiagnosisSummary;
use super::super::published::{PREDICTION_ERROR, STIFFNESS_N_PER_UM};
use super::super::search::IndexedPoses;
use super::super::study::Reproduction;
use super::COORDINATES;

/// File names and contents.
///
/// # Errors
/// What writing to memory reports.
pub(super) fn all(study: &Reproduction) -> io::Result<Vec<(&'static str, String)>> {
    let [x, y] = &study.compared;
    let [hidden_x, hidden_y] = &study.hidden_compared;
    Ok(vec![
        ("hexapod.toml", hexapod_to_toml(&study.bench.hexapod)),
        ("identification.csv", readings(&study.springs.identification)?),
        ("validation.csv", readings(&study.springs.validation)?),
        ("identification-hidden.csv", readings(&study.hidden.identification)?),
        ("validation-hidden.csv", readings(&study.hidden.validation)?),
        ("table-1.csv", table_1(study)),
        ("table-2.csv", table_2(study)),
        ("table-4.csv", table_4(study)),
        ("suspects.csv", suspects(study)),
        ("held-out.csv", held_out(study)),
        ("figure-7.csv", figure_7(study)),
        ("figure-8.csv", figure_8(&study.linearity)),
        ("figure-9.csv", compared(x)),
        ("figure-10.csv", compared(y)),
        ("figure-9-hidden.csv", compared(hidden_x)),
        ("figure-10-hidden.csv", compared(hidden_y)),
    ])
}

fn readings(dataset: &Dataset) -> io::Result<String> {
    let mut out = Vec::new();
    measurements_to_csv(&mut out, dataset)?;
    String::from_utf8(out).map_err(io::Error::other)
}

/// Lines of a file under its header.
fn csv(header: &str, rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let mut text = CsvText::new(header.split(','));
    rows.into_iter().for_each(|row| text.row(row));
    text.into_text()
}

fn exact(values: &[f64]) -> impl Iterator<Item = String> {
    values.iter().map(|x| super::number(*x, 6))
}

/// The six coordinates with their units, each after a prefix.
fn header(prefix: &str) -> String {
    COORDINATES.map(|(name, unit)| format!("{prefix}{name}_{unit}")).join(",")
}

fn table_1(study: &Reproduction) -> String {
    let mut rows = Vec::new();
    let mut add = |name: &str, set: &IndexedPoses| {
        let o = &set.observability;
        for (i, pose) in set.poses.iter().enumerate() {
            let indices = [o.o1, o.o2, o.o3, o.o4, o.o5];
            let head = [name.to_owned(), (i + 1).to_string()];
            rows.push(head.into_iter().chain(exact(pose)).chain(exact(&indices)).collect());
        }
    };
    add("published", &study.published_set);
    add("best within the stroke of all poses", &study.best_sets[0].1);
    add("best within the stroke of the validation poses", &study.best_sets[1].1);
    csv("set,pose,a_mm,b_mm,c_mm,gamma_deg,o1_si,o2,o3_si,o4_si,o5_si", rows)
}

fn table_2(study: &Reproduction) -> String {
    let (paper, weighted) =
        (study.springs.paper.identified.stiffness(), study.springs.weighted.identified.stiffness());
    let row = |leg: usize| {
        let values =
            [STIFFNESS_N_PER_UM[leg], paper[leg][0], paper[leg][1], weighted[leg][0], weighted[leg][1]];
        std::iter::once((leg + 1).to_string()).chain(exact(&values)).collect()
    };
    let header = "leg,true_N_per_um,paper_estimator_N_per_um,paper_estimator_std_N_per_um,weighted_N_per_um,\
                  weighted_std_N_per_um";
    csv(header, (0..6).map(row))
}

fn table_4(study: &Reproduction) -> String {
    let rows = [
        ("paper", &PREDICTION_ERROR),
        ("springs alone; expected", &study.springs.paper.expected),
        ("springs alone; this run", &study.springs.paper.error),
        ("springs alone; median of repetitions", &study.repetitions.median),
        ("springs alone; exceeded by one repetition in twenty", &study.repetitions.upper),
        ("springs alone; weighted fit; expected", &study.springs.weighted.expected),
        ("springs alone; weighted fit; this run", &study.springs.weighted.error),
        ("with the support; expected", &study.hidden_expected),
        ("with the support; this run", &study.hidden.paper.error),
        ("with the support; weighted fit; this run", &study.hidden.weighted.error),
        ("measured deflection; springs alone", &study.springs.before),
        ("measured deflection; with the support", &study.hidden.before),
    ];
    let row = |(name, rms): (&str, &[f64; 6])| std::iter::once(name.to_owned()).chain(exact(rms)).collect();
    csv(&format!("what,{}", header("rms_")), rows.into_iter().map(row))
}

fn suspects(study: &Reproduction) -> String {
    let row = |s: &super::super::suspects::SuspectedEffect| {
        [s.id.replace(',', ";"), s.size.replace(',', ";")].into_iter().chain(exact(&s.error)).collect()
    };
    csv(&format!("effect,size,{}", header("rms_")), study.suspects.iter().map(row))
}

fn held_out(study: &Reproduction) -> String {
    let rows = |plan: &'static str, finding: &DiagnosisSummary| -> Vec<Vec<String>> {
        let row = |step: &super::super::missing::HeldOutError| {
            let terms = ["springs".to_owned()].into_iter().chain(step.terms.clone()).collect::<Vec<_>>();
            let head = [plan.to_owned(), terms.join(" + ")];
            let tail = exact(&[step.chi2_reduced, step.chance]).collect::<Vec<_>>();
            head.into_iter().chain(exact(&step.error)).chain(tail).collect()
        };
        finding.steps.iter().map(row).collect()
    };
    let all = [rows("paper", &study.poor), rows("richer", &study.rich)].concat();
    csv(&format!("plan,model,{},chi2_reduced,chance", header("rms_")), all)
}

fn figure_7(study: &Reproduction) -> String {
    let rows = study.index_over_load.iter().flat_map(|set| {
        set.points.iter().map(|p| std::iter::once(set.name.to_owned()).chain(exact(p)).collect())
    });
    csv("set,load_N,o1_si", rows)
}

fn figure_8(line: &Linearity) -> String {
    let rows = line.ideal.iter().enumerate().map(|(i, point)| {
        let trials: Vec<f64> = line.trials.iter().filter_map(|t| t.get(i)).map(|p| p[1]).collect();
        exact(point).chain(exact(&trials)).collect()
    });
    csv("load_N,deflection_um,trial_1_um,trial_2_um,trial_3_um", rows)
}

fn compared(rows: &[ValidationPose]) -> String {
    let row = |c: &ValidationPose| {
        let values = [c.predicted, c.predicted_std, c.measured].concat();
        exact(&[c.position_mm]).chain(exact(&values)).collect()
    };
    let header =
        format!("position_mm,{},{},{}", header("predicted_"), header("predicted_std_"), header("measured_"));
    csv(&header, rows.iter().map(row))
}
