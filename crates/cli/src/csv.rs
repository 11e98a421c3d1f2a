//! Tables the command writes: the columns of a conditions file, then results.

use std::fmt::Write;

use hexbench_core::{Dataset, Observation};

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
    fn write(self, text: &mut String, si: f64) {
        let number = match self {
            Self::Mm => format!("{:.9}", si * 1e3),
            Self::Deg => format!("{:.11}", si.to_degrees()),
            Self::Um | Self::Urad => format!("{:.6}", si * 1e6),
        };
        let minus_zero = number.starts_with('-') && number.chars().all(|c| matches!(c, '-' | '0' | '.'));
        text.push_str(&number[usize::from(minus_zero)..]);
    }
}

/// A conditions file.
pub(crate) fn conditions(rows: &Dataset) -> String {
    let mut text = conditions_header(rows) + "\n";
    for row in &rows.observations {
        condition(&mut text, rows, row);
        text.push('\n');
    }
    text
}

/// Header of the columns that say what a row is about.
pub(crate) fn conditions_header(rows: &Dataset) -> String {
    let mut text =
        "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm".to_owned();
    let c = rows.columns;
    let optional = [
        (c.reference, ",ref_fx_N,ref_fy_N,ref_fz_N,ref_mx_Nm,ref_my_Nm,ref_mz_Nm"),
        (c.approach, ",approach"),
        (c.delta_t, ",delta_T_K"),
        (c.elapsed, ",elapsed_s"),
    ];
    optional.iter().filter(|o| o.0).for_each(|o| text.push_str(o.1));
    text
}

/// The same columns of one row.
pub(crate) fn condition(text: &mut String, rows: &Dataset, o: &Observation) {
    let _ = write!(text, "{},{}", o.pose_id, o.repeat);
    values(text, &o.pose.to_array(), [Unit::Mm, Unit::Deg]);
    plain(text, &o.wrench.to_array());
    let c = rows.columns;
    if c.reference {
        plain(text, &o.reference.to_array());
    }
    let optional = [(c.approach, o.approach), (c.delta_t, o.delta_t), (c.elapsed, o.elapsed)];
    optional.iter().filter(|x| x.0).for_each(|x| plain(text, &[x.1]));
}

fn plain(text: &mut String, numbers: &[f64]) {
    for x in numbers {
        let _ = write!(text, ",{x}");
    }
}

/// Names of six results: three translations, three rotations.
pub(crate) fn names(text: &mut String, prefix: &str, names: &[&str; 6], units: [Unit; 2]) {
    for (k, name) in names.iter().enumerate() {
        let _ = write!(text, ",{prefix}{name}_{}", units[k / 3].name());
    }
}

/// Six results: three translations (m), three rotations (rad).
pub(crate) fn values(text: &mut String, si: &[f64; 6], units: [Unit; 2]) {
    for (k, value) in si.iter().enumerate() {
        text.push(',');
        units[k / 3].write(text, *value);
    }
}
