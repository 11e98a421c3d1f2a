//! Tables the command writes: the columns of a conditions file, then results.

use hexbench_core::files::CsvText;
use hexbench_core::{Dataset, Hexapod, Matrix6, Observation};

/// Unit of a result column.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Unit {
    Mm,
    Um,
    Deg,
    Urad,
}

impl Unit {
    fn name(self) -> &'static str {
        match self {
            Self::Mm => "mm",
            Self::Um => "um",
            Self::Deg => "deg",
            Self::Urad => "urad",
        }
    }

    /// Decimals reach a picometre and a picoradian, so that rounding never shows.
    fn text(self, si: f64) -> String {
        let number = match self {
            Self::Mm => format!("{:.9}", si * 1e3),
            Self::Deg => format!("{:.11}", si.to_degrees()),
            Self::Um | Self::Urad => format!("{:.6}", si * 1e6),
        };
        let minus_zero = number.starts_with('-') && number.chars().all(|c| matches!(c, '-' | '0' | '.'));
        number[usize::from(minus_zero)..].to_owned()
    }
}

/// A conditions file of a machine.
pub(crate) fn conditions(rows: &Dataset, machine: &Hexapod) -> String {
    let rows = &*machine.angles.as_stated(rows);
    let mut text = CsvText::new(conditions_header(rows));
    rows.observations.iter().for_each(|row| text.row(condition(rows, row)));
    text.into_text()
}

/// Header of the columns that say what a row is about.
pub(crate) fn conditions_header(rows: &Dataset) -> Vec<&'static str> {
    let c = rows.columns;
    let pose = ["pose", "repeat", "a_mm", "b_mm", "c_mm", "alpha_deg", "beta_deg", "gamma_deg"];
    let wrench = ["fx_N", "fy_N", "fz_N", "mx_Nm", "my_Nm", "mz_Nm"];
    let reference = ["ref_fx_N", "ref_fy_N", "ref_fz_N", "ref_mx_Nm", "ref_my_Nm", "ref_mz_Nm"];
    let optional = [
        (c.approach, "approach"),
        (c.overload, "overload"),
        (c.delta_t, "delta_T_K"),
        (c.elapsed, "elapsed_s"),
        (c.reference_age, "ref_age_s"),
        (c.reference_record, "ref_record"),
        (c.order, "order"),
    ];
    let reference = reference.into_iter().filter(|_| c.reference);
    let optional = optional.into_iter().filter_map(|(there, name)| there.then_some(name));
    pose.into_iter().chain(wrench).chain(reference).chain(optional).collect()
}

/// The same columns of one row, whose angles are [stated](hexbench_core::AngleConvention::as_stated).
pub(crate) fn condition(rows: &Dataset, o: &Observation) -> Vec<String> {
    let c = rows.columns;
    let plain = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>();
    let optional = [
        (c.approach, o.approach.sign()),
        (c.overload, o.overload),
        (c.delta_t, o.delta_t),
        (c.elapsed, o.elapsed),
        (c.reference_age, o.reference_age.unwrap_or_default()),
        (c.reference_record, o.reference_record.unwrap_or_default() as f64),
        (c.order, o.order.unwrap_or_default() as f64),
    ];
    let reference = if c.reference { plain(&o.reference.to_array()) } else { Vec::new() };
    [o.pose_id.to_string(), o.repeat.to_string()]
        .into_iter()
        .chain(values(&o.pose.to_array(), [Unit::Mm, Unit::Deg]))
        .chain(plain(&o.wrench.to_array()))
        .chain(reference)
        .chain(optional.iter().filter(|x| x.0).map(|x| x.1.to_string()))
        .collect()
}

/// Names of six results: three translations, three rotations.
pub(crate) fn names(prefix: &str, names: &[&str; 6], units: [Unit; 2]) -> Vec<String> {
    names.iter().enumerate().map(|(k, name)| format!("{prefix}{name}_{}", units[k / 3].name())).collect()
}

/// Six results: three translations (m), three rotations (rad).
pub(crate) fn values(si: &[f64; 6], units: [Unit; 2]) -> Vec<String> {
    si.iter().enumerate().map(|(k, value)| units[k / 3].text(*value)).collect()
}

/// Any results in um (m) or urad (rad).
pub(crate) fn micro(si: impl IntoIterator<Item = f64>) -> impl Iterator<Item = String> {
    si.into_iter().map(|value| Unit::Um.text(value))
}

/// Columns of the correlations of six numbers, `x_corr_FIRST_SECOND`.
pub(crate) fn correlation_names(numbers: &[&str; 6]) -> Vec<String> {
    pairs().map(|(i, j)| format!("x_corr_{}_{}", numbers[i], numbers[j])).collect()
}

/// The correlations of six numbers; zero where one of them has no variance.
pub(crate) fn correlations(covariance: &Matrix6) -> Vec<String> {
    let correlation = |(i, j): (usize, usize)| {
        let scale = (covariance[(i, i)] * covariance[(j, j)]).sqrt();
        format!("{:.6}", if scale > 0.0 { covariance[(i, j)] / scale } else { 0.0 })
    };
    pairs().map(correlation).collect()
}

fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..6).flat_map(|i| (i + 1..6).map(move |j| (i, j)))
}
