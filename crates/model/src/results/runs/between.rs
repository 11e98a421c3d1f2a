//! What changed from one result to another.

use std::collections::BTreeSet;

use serde::Serialize;
use statrs::distribution::{ContinuousCDF, FisherSnedecor, Normal};

use super::saved::{Origin, Run};
use crate::estimation::estimate::Estimate;
use crate::estimation::residuals::ErrorSummary;
use crate::inference::explanation::Explanation;

/// Chance that noise marks anything in a list.
const CHANCE: f64 = 0.01;
/// Relative difference from which a noise that is stated is another one.
const OTHER_NOISE: f64 = 0.02;

/// Two results that cannot stand beside each other.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Incompatible {
    /// A diagnosis beside a comparison.
    #[error("{a} is a {a_format}, {b} a {b_format}: only files of the same format can be compared")]
    Format {
        /// First file.
        a: String,
        /// Its format.
        a_format: String,
        /// Second file.
        b: String,
        /// Its format.
        b_format: String,
    },
    /// Other machines, other kinds of readings.
    #[error("{a} and {b} are about different {what}: {a_value} and {b_value}")]
    Subject {
        /// First file.
        a: String,
        /// Second file.
        b: String,
        /// `machines`, `kinds of readings`.
        what: &'static str,
        /// In the first file.
        a_value: String,
        /// In the second file.
        b_value: String,
    },
    /// Too few for charts over time.
    #[error("{campaigns} results were given, but a campaign book needs {fewest}")]
    Few {
        /// Given.
        campaigns: usize,
        /// Needed.
        fewest: usize,
    },
}

/// Whether a difference is beyond chance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Changed {
    /// Chance explains it.
    No,
    /// Chance does not explain it.
    Yes,
    /// Only one of the two has it.
    OnlyInOne,
}

/// A parameter of both results, or of one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ParameterChange {
    /// Its name.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// Value and standard uncertainty in the first.
    pub a: Option<[f64; 2]>,
    /// In the second.
    pub b: Option<[f64; 2]>,
    /// Second minus first, in combined standard uncertainties.
    pub sigmas: Option<f64>,
    /// Beyond chance among all parameters compared.
    pub changed: Changed,
}

/// The error of the final models.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ErrorChange {
    /// Second over first reduced chi-square.
    pub ratio: f64,
    /// Chance of a ratio this far from one to either side.
    pub p: f64,
    /// Beyond chance.
    pub changed: Changed,
}

/// Two results beside each other.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ComparedRuns {
    /// `runs/1`.
    pub format: &'static str,
    /// The first result.
    pub a: Run,
    /// The second result.
    pub b: Run,
    /// Effects, something outside and nothing: probability in the first and in the second, zero where it is not listed.
    pub probabilities: Vec<(Explanation, [f64; 2])>,
    /// Error on held-out readings, else on fitted ones; absent when only one of the two has a holdout file.
    pub error: Option<ErrorChange>,
    /// True when the noise is another one.
    pub noise_changed: bool,
    /// All parameters.
    pub parameters: Vec<ParameterChange>,
    /// Standard uncertainties from which a parameter counts as changed.
    pub sigmas_beyond_chance: f64,
    /// What to know before reading the differences.
    pub warnings: Vec<String>,
}

impl ComparedRuns {
    /// True when the answers differ.
    pub fn has_other_answer(&self) -> bool {
        self.a.verdict != self.b.verdict || self.a.added != self.b.added
    }

    /// True when anything differs beyond chance: the answer, the error, a number.
    pub fn has_changed(&self) -> bool {
        let error = self.error.is_some_and(|e| e.changed == Changed::Yes);
        self.has_other_answer() || error || self.parameters.iter().any(|p| p.changed == Changed::Yes)
    }
}

/// Put two results beside each other.
///
/// # Errors
/// [`Incompatible`].
pub fn between(a: Run, b: Run) -> Result<ComparedRuns, Incompatible> {
    same_subject(&a, &b)?;
    let limit = limit(common(&a, &b));
    Ok(ComparedRuns {
        format: "runs/1",
        probabilities: probabilities(&a, &b),
        error: error(&a, &b),
        noise_changed: has_other_noise(&a, &b),
        parameters: parameters(&a, &b, limit),
        sigmas_beyond_chance: limit,
        warnings: warnings(&a, &b),
        a,
        b,
    })
}

/// True for levels of the noise that differ beyond chance; none: nothing of the kind is read.
///
/// The logarithm of a level that `n` degrees of freedom tell scatters by `1 / sqrt(2 n)`; translations and rotations have half of them each.
fn has_other_noise(a: &Run, b: &Run) -> bool {
    let variance = |run: &Run| run.noise_dof.map_or(0.0, |dof| 1.0 / dof.max(1.0));
    let by_chance = limit(2) * (variance(a) + variance(b)).sqrt();
    let is_other = |a: Option<f64>, b: Option<f64>| match (a, b) {
        (Some(a), Some(b)) => (a / b).ln().abs() > by_chance.max(OTHER_NOISE),
        (a, b) => a.is_some() != b.is_some(),
    };
    is_other(a.noise_translation_um, b.noise_translation_um)
        || is_other(a.noise_rotation_urad, b.noise_rotation_urad)
}

/// Refuse results of another format, machine or kind of readings.
///
/// # Errors
/// [`Incompatible`].
pub fn same_subject(a: &Run, b: &Run) -> Result<(), Incompatible> {
    if a.format != b.format {
        let (a_format, b_format) = (a.format.clone(), b.format.clone());
        return Err(Incompatible::Format { a: a.file.clone(), a_format, b: b.file.clone(), b_format });
    }
    let (Some(of_a), Some(of_b)) = (&a.origin, &b.origin) else { return Ok(()) };
    let subjects =
        [("machines", &of_a.machine, &of_b.machine), ("kinds of readings", &of_a.measurand, &of_b.measurand)];
    match subjects.into_iter().find(|(_, a, b)| a != b) {
        None => Ok(()),
        Some((what, a_value, b_value)) => Err(Incompatible::Subject {
            a: a.file.clone(),
            b: b.file.clone(),
            what,
            a_value: a_value.clone(),
            b_value: b_value.clone(),
        }),
    }
}

fn warnings(a: &Run, b: &Run) -> Vec<String> {
    let mut all = Vec::new();
    for run in [a, b].into_iter().filter(|r| r.origin.is_none()) {
        all.push(format!(
            "{} does not say which machine and files it is about (an older version wrote it): whether it belongs beside the other \
             one was not checked.",
            run.file
        ));
    }
    if let (Some(of_a), Some(of_b)) = (&a.origin, &b.origin) {
        all.extend(differences(of_a, of_b).map(str::to_owned));
    }
    if a.noise_source != b.noise_source {
        all.push(format!(
            "The noise comes from different sources: {} and {}.",
            a.noise_source.word(),
            b.noise_source.word()
        ));
    }
    if (&a.excluded, a.keep_all) != (&b.excluded, b.keep_all) {
        all.push("The readings were chosen differently: lines left out by name, or all kept.".to_owned());
    }
    if a.read_as != b.read_as {
        all.push(
            "The files were read differently: one of them, or both in different ways, with corrections."
                .to_owned(),
        );
    }
    all
}

fn differences(a: &Origin, b: &Origin) -> impl Iterator<Item = &'static str> {
    let hexapod = "The hexapod files differ: joints, noise or nominal values may not be the same.";
    let data = "The measurements differ: the change may come from the machine, the plan or the readings.";
    let same = "Both come from the same measurements: they share their noise and differ by less than independent ones would.";
    let holdout = "The held-out readings differ, so the errors are not for the same poses.";
    let program = "They were made with different versions of the program.";
    [
        (a.hexapod_sha256 != b.hexapod_sha256, hexapod),
        (a.data_sha256 != b.data_sha256, data),
        (a.data_sha256 == b.data_sha256, same),
        (a.holdout_sha256 != b.holdout_sha256, holdout),
        (a.program != b.program, program),
    ]
    .into_iter()
    .filter_map(|(holds, text)| holds.then_some(text))
}

fn probabilities(a: &Run, b: &Run) -> Vec<(Explanation, [f64; 2])> {
    let names: BTreeSet<&Explanation> = a.probabilities.keys().chain(b.probabilities.keys()).collect();
    let of = |run: &Run, name: &Explanation| run.probabilities.get(name).copied().unwrap_or(0.0);
    let mut all: Vec<(Explanation, [f64; 2])> =
        names.into_iter().map(|n| (n.clone(), [of(a, n), of(b, n)])).collect();
    let largest = |p: &[f64; 2]| p[0].max(p[1]);
    all.sort_by(|x, y| largest(&y.1).total_cmp(&largest(&x.1)).then(x.0.cmp(&y.0)));
    all
}

/// Ratio of the errors of the final models, held out in the same way.
fn error(a: &Run, b: &Run) -> Option<ErrorChange> {
    let file = |run: &Run| run.origin.as_ref().map(|o| o.holdout_sha256.is_some());
    let one_has_a_file = file(a).zip(file(b)).is_some_and(|(a, b)| a != b);
    let (a, b) = (a.steps.last()?, b.steps.last()?);
    if a.holdout.is_some() != b.holdout.is_some() || one_has_a_file {
        return None;
    }
    ratio(a.error(), b.error())
}

fn ratio(a: &ErrorSummary, b: &ErrorSummary) -> Option<ErrorChange> {
    let ratio = b.chi2_reduced / a.chi2_reduced;
    let law = FisherSnedecor::new(b.count as f64, a.count as f64).ok().filter(|_| ratio.is_finite())?;
    let p = (2.0 * law.sf(ratio).min(law.cdf(ratio))).min(1.0);
    Some(ErrorChange { ratio, p, changed: if p < CHANCE { Changed::Yes } else { Changed::No } })
}

fn common(a: &Run, b: &Run) -> usize {
    a.parameters.iter().filter(|p| find(b, &p.name).is_some()).count()
}

fn find<'a>(run: &'a Run, name: &str) -> Option<&'a Estimate> {
    run.parameters.iter().find(|p| p.name == name)
}

/// Standard deviations that a normal number exceeds to either side with the chance shared by so many.
fn limit(parameters: usize) -> f64 {
    Normal::standard().inverse_cdf(1.0 - 0.5 * CHANCE / parameters.max(1) as f64)
}

/// Those of the first in their order, then those that only the second has.
fn parameters(a: &Run, b: &Run, limit: f64) -> Vec<ParameterChange> {
    let of_a = a.parameters.iter().map(|p| parameter(Some(p), find(b, &p.name), limit));
    let only_b = b.parameters.iter().filter(|p| find(a, &p.name).is_none());
    of_a.chain(only_b.map(|p| parameter(None, Some(p), limit))).flatten().collect()
}

fn parameter(a: Option<&Estimate>, b: Option<&Estimate>, limit: f64) -> Option<ParameterChange> {
    let either = a.or(b)?;
    let numbers = |p: Option<&Estimate>| p.map(|p| [p.value, p.std]);
    let comparable = a.zip(b).filter(|(a, b)| a.unit == b.unit);
    let sigmas = comparable.map(|(a, b)| (b.value - a.value) / a.std.hypot(b.std)).filter(|s| s.is_finite());
    let changed = match (a.zip(b), sigmas) {
        (None, _) => Changed::OnlyInOne,
        (_, Some(s)) if s.abs() > limit => Changed::Yes,
        _ => Changed::No,
    };
    let (name, unit) = (either.name.clone(), either.unit.clone());
    Some(ParameterChange { name, unit, a: numbers(a), b: numbers(b), sigmas, changed })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::estimation::noise::NoiseSource;
    use crate::estimation::residuals::Rms;

    fn origin() -> Origin {
        Origin {
            program: "hexbench 0.1.0".into(),
            machine: "bench".into(),
            measurand: "deflections".into(),
            hexapod_sha256: "1".into(),
            data_sha256: "2".into(),
            holdout_sha256: None,
            drawn_from: None,
        }
    }

    fn run(stiffness: f64, chi2: f64) -> Run {
        let rms = Rms { translation_um: Some(0.5), rotation_urad: Some(3.0) };
        let fitted = ErrorSummary { chi2_reduced: chi2, rms, per_coordinate: [1.0; 6], count: 600 };
        let unit = "N/um".to_owned();
        Run {
            file: "a.json".into(),
            format: "diagnosis/1".into(),
            verdict: None,
            added: Vec::new(),
            probabilities: [(Explanation::Nothing, 1.0)].into(),
            steps: vec![super::super::RunStep { terms: Vec::new(), fitted, holdout: None }],
            noise_translation_um: Some(0.5),
            noise_rotation_urad: Some(3.0),
            noise_source: NoiseSource::Metrology,
            noise_dof: None,
            parameters: vec![Estimate { name: "leg-1.stiffness".into(), value: stiffness, std: 0.03, unit }],
            origin: Some(origin()),
            excluded: Vec::new(),
            keep_all: false,
            read_as: Vec::new(),
        }
    }

    #[test]
    fn a_difference_is_told_in_combined_uncertainties() {
        // sqrt(0.03^2 + 0.03^2) = 0.0424; two-sided 1 % point of the normal law: 2.5758.
        let near = between(run(4.0, 1.0), run(4.1, 1.1)).unwrap();
        assert!((near.sigmas_beyond_chance - 2.5758).abs() < 1e-4, "{}", near.sigmas_beyond_chance);
        assert!((near.parameters[0].sigmas.unwrap() - 0.1 / 0.0424).abs() < 0.01, "{:?}", near.parameters);
        assert_eq!(near.parameters[0].changed, Changed::No);
        assert_eq!(near.error.unwrap().changed, Changed::No);
        let far = between(run(4.0, 1.0), run(4.2, 1.5)).unwrap();
        assert_eq!([far.parameters[0].changed, far.error.unwrap().changed], [Changed::Yes; 2]);
    }

    #[test]
    fn a_noise_that_repeats_tell_is_another_one_only_beyond_chance() {
        let with = |noise: f64, noise_dof: Option<f64>| Run {
            noise_translation_um: Some(noise),
            noise_dof,
            ..run(4.0, 1.0)
        };
        // 400 degrees of freedom, half of them of the translations: 5 % each, 7.1 % between two; the two-sided 0.5 % point is 2.81.
        let changed = |a, b| between(a, b).unwrap().noise_changed;
        assert!(!changed(with(0.5, Some(400.0)), with(0.6, Some(400.0))));
        assert!(changed(with(0.5, Some(400.0)), with(0.62, Some(400.0))));
        assert!(changed(with(0.5, None), with(0.52, None)));
    }

    #[test]
    fn what_only_one_has_is_no_difference() {
        let mut other = run(4.0, 1.0);
        other.parameters[0].name = "base-compliance.rotation-x".into();
        let runs = between(run(4.0, 1.0), other).unwrap();
        assert!(runs.parameters.iter().all(|p| p.changed == Changed::OnlyInOne && p.sigmas.is_none()));
        assert_eq!(runs.parameters.len(), 2);
    }

    #[test]
    fn other_machines_kinds_and_formats_are_refused() {
        let with = |change: fn(&mut Run)| {
            let mut other = run(4.0, 1.0);
            change(&mut other);
            between(run(4.0, 1.0), other).unwrap_err().to_string()
        };
        let machine = with(|r| r.origin.as_mut().unwrap().machine = "other".into());
        assert!(machine.ends_with("are about different machines: bench and other"), "{machine}");
        let kind = with(|r| r.origin.as_mut().unwrap().measurand = "absolute poses".into());
        assert!(kind.contains("different kinds of readings"), "{kind}");
        assert!(with(|r| r.format = "comparison/1".into()).contains("same format"));
    }

    #[test]
    fn other_data_and_unknown_origins_are_warned_of() {
        let mut other = run(4.0, 1.0);
        other.origin.as_mut().unwrap().data_sha256 = "3".into();
        assert!(
            between(run(4.0, 1.0), other.clone()).unwrap().warnings[0].starts_with("The measurements differ")
        );
        other.origin.as_mut().unwrap().holdout_sha256 = Some("4".into());
        assert!(between(run(4.0, 1.0), other.clone()).unwrap().error.is_none(), "one has a holdout file");
        other.origin = None;
        assert!(between(run(4.0, 1.0), other).unwrap().warnings[0].contains("was not checked"));
    }
}
