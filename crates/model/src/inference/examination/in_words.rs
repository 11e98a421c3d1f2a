//! Statements about the noise in words.

use hexbench_core::Matrix6;

use super::Look;
use super::finding::{Finding, FindingKind, probability};
use super::scatter::{Kind, Levels, Statement};
use crate::estimation::load_response::LoadScatter;
use crate::estimation::noise::{SharedReference, Structure};

/// Correlations of less are not worth a word.
const CORRELATED: f64 = 0.3;
/// Expansion of steel, 1/K.
const STEEL: f64 = 1.2e-5;

/// A statement that explains so many nats more than the noise as stated.
pub(super) fn finding(best: &Statement, gain: f64, look: &Look) -> Finding {
    let noise = look.noise;
    let level = format!("{:.2} times {noise}", best.level);
    let percent = |share: f64| format!("{:.0} %", 100.0 * share);
    let (kind, size, text, next) = match best.kind {
        Kind::Level | Kind::Law => (
            FindingKind::NoiseLevel,
            level.clone(),
            format!("the readings scatter by {level}, repeats and residuals alike"),
            "state the actual noise of the instrument, or omit it if there are repeats",
        ),
        Kind::Levels(levels) => {
            let size = sizes_of(levels, look);
            (
                FindingKind::NoiseLevel,
                size.clone(),
                format!("the noise is not {noise}, in repeats and residuals alike: {size}"),
                "state the actual noise of each coordinate (in sigma columns, or sigma_translation_um and sigma_rotation_urad)",
            )
        }
        Kind::Proportional(share) => (
            FindingKind::NoiseLevel,
            format!("{:.1} % of each reading, beside {level}", 100.0 * share),
            format!("repeats scatter the more the larger the deflection: by {:.1} % of it, beside {level}", 100.0 * share),
            "look for what varies with the load: its size, its direction, slip; state the noise of every reading in sigma columns",
        ),
        Kind::Tails(_) => (
            FindingKind::HeavyTails,
            format!("{level} in the middle, more in the tails"),
            format!("far more readings are outlying than a Gaussian with {noise} allows"),
            "look for disturbances of single readings: vibration, air, contact of the probe",
        ),
        Kind::Common(Structure::Setup { share }) => (
            FindingKind::SetupError,
            format!("{} of the variance, {:.2} times {noise}", percent(share), best.level * share.sqrt()),
            setup_words(look.is_complete),
            "set up the load and the pose again for every repeat",
        ),
        Kind::Common(Structure::Reference { share, record }) => {
            let (kind, text, next) = shared(record, look.is_absolute);
            (kind, format!("{} of the variance", percent(share)), text, next)
        }
        Kind::Common(Structure::Drift { share, correlation }) => (
            FindingKind::Drift,
            format!("{} of the variance, correlation {correlation:.2} from row to row", percent(share)),
            "part of the error of each row resembles that of the previous row: the instrument drifts during the measurement"
                .to_owned(),
            "read the reference more often, and measure the conditions in random order",
        ),
        Kind::Common(Structure::Loads { scatter, .. }) => (
            FindingKind::LoadNoise,
            size_of(scatter),
            format!(
                "the loads scatter about what the file states, by {} from condition to condition: the readings move as under other loads",
                size_of(scatter)
            ),
            "write down the loads with more digits, average the load cell longer, or weigh the masses",
        ),
        Kind::Common(Structure::Lengths { strain }) => (
            FindingKind::SetupError,
            format!("{:.2} um per meter of leg", 1e6 * strain),
            format!(
                "all legs lengthen alike from condition to condition, by {:.2} um per meter of leg: a temperature that differs and that the \
                 file does not state acts like this (by {:.2} K on steel)",
                1e6 * strain,
                strain / STEEL
            ),
            "write down the temperature of every reading (delta_T_K), or wait until it is steady",
        ),
        Kind::Common(Structure::Axes { covariance }) => {
            let (size, text) = by_axes(&covariance.matrix(), look);
            (FindingKind::NoiseLevel, size, text, "state the noise of every coordinate in sigma columns if they differ")
        }
        Kind::Common(Structure::Independent) => (FindingKind::NoiseLevel, level, String::new(), ""),
    };
    let (rows, read_as) = (Vec::new(), Vec::new());
    Finding {
        probability: probability(gain),
        rows,
        size,
        text,
        next: next.to_owned(),
        read_as,
        ..Finding::of(kind)
    }
}

/// Size and words of coordinates with a covariance of their own.
fn by_axes(covariance: &Matrix6, look: &Look) -> (String, String) {
    let (names, noise) = (&look.names, look.noise);
    let sigma = covariance.diagonal().map(f64::sqrt);
    let (least, most) = (sigma.imin(), sigma.imax());
    let correlation = |&(i, j): &(usize, usize)| covariance[(i, j)] / (sigma[i] * sigma[j]);
    let pairs = (0..6).flat_map(|i| (0..i).map(move |j| (i, j)));
    let (i, j) = pairs.max_by(|a, b| correlation(a).abs().total_cmp(&correlation(b).abs())).unwrap_or((1, 0));
    let largest = correlation(&(i, j));
    let size = format!("{:.2} to {:.2} times {noise}", sigma[least], sigma[most]);
    let text = format!(
        "the six numbers of a reading differ in noise: {} scatters by {:.2} times {noise}, {} by {:.2}",
        names[least], sigma[least], names[most], sigma[most]
    );
    if largest.abs() < CORRELATED {
        return (size, text);
    }
    (
        format!("{size}, correlation up to {largest:.2}"),
        format!("{text}; errors of {} and {} have a correlation of {largest:.2}", names[j], names[i]),
    )
}

/// Levels of one number and the others, or of translations and rotations.
fn sizes_of(levels: Levels, look: &Look) -> String {
    let Levels { alone, own, others } = levels;
    let (one, level, rest, other) = match alone {
        Some(k) => (look.names[k].as_str(), own, "the others", others),
        None => ("translations", others, "rotations", own),
    };
    format!("{one} by {level:.2} times {}, {rest} by {other:.2} times", look.noise)
}

/// Readings that share an error: what it is, and what to do.
fn shared(record: SharedReference, is_absolute: bool) -> (FindingKind, String, &'static str) {
    let (kind, who, next) = match record {
        SharedReference::Pose if is_absolute => (
            FindingKind::SharedReference,
            "all readings at a pose",
            "bring the platform to the pose again for every reading",
        ),
        SharedReference::Pose => (
            FindingKind::SharedReference,
            "all readings at a pose",
            "read the reference again for every reading",
        ),
        SharedReference::Repeat => (
            FindingKind::SharedReference,
            "the loads of one repeat at a pose",
            "read the reference again for every load",
        ),
        SharedReference::Named => (
            FindingKind::ReferenceRecord,
            "readings with one number in ref_record",
            "nothing: this is taken into account; more frequent reference readings reduce the uncertainty",
        ),
    };
    let how = if is_absolute {
        "as where the platform stands a little elsewhere at every pose"
    } else {
        "as differences from one reference reading do"
    };
    (kind, format!("{who} share an error, {how}"), next)
}

/// What repeats that agree too well mean.
fn setup_words(is_complete: bool) -> String {
    const SETUP: &str = "repeats of one condition agree better with each other than with the rest: they share an error of the setup";
    if is_complete {
        return SETUP.to_owned();
    }
    format!("{SETUP}; in so few conditions, an effect far larger than is plausible would look the same")
}

fn size_of(scatter: LoadScatter) -> String {
    match scatter {
        LoadScatter::Sizes([force, moment]) => format!("{force:.2} N and {moment:.3} N m"),
        LoadScatter::Shares(share) => format!("{:.2} % of every force and moment", 100.0 * share),
        LoadScatter::Factor(share) => format!("{:.2} % of the load", 100.0 * share),
    }
}
