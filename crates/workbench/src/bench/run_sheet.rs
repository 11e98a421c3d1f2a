//! The readings asked for, as a table to be taken to the machine and filled in.

use std::fmt::Write;

use hexbench_model::results::diagnose::NextReport;

use super::refusal::{Refusal, RefusalKind};

const SET: &str = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,ref_fx_N,ref_fy_N,ref_fz_N,\
                   ref_mx_Nm,ref_my_Nm,ref_mz_Nm,approach,delta_T_K,elapsed_s";
const READ: &str = "da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad";
const READ_ABSOLUTE: &str =
    "measured_a_mm,measured_b_mm,measured_c_mm,measured_alpha_deg,measured_beta_deg,measured_gamma_deg";

/// A row for every reading, what is to be read left empty: filled in, it is a file of measurements.
///
/// # Errors
/// [`RefusalKind::Conflict`] where no reading is asked for.
pub(super) fn run_sheet(next: &[NextReport], is_absolute: bool) -> Result<String, Refusal> {
    if next.is_empty() {
        let refused = "the diagnosis of these data asks for no more readings";
        let otherwise = "`hexbench design` and `hexbench discriminate` plan readings for other purposes.";
        return Err(Refusal::new(RefusalKind::Conflict, refused, otherwise));
    }
    let mut text = format!("{SET},{}\n", if is_absolute { READ_ABSOLUTE } else { READ });
    for (k, r) in next.iter().enumerate() {
        let six = |values: &[f64; 6]| values.map(|x| x.to_string()).join(",");
        for repeat in 1..=r.repeats {
            let (pose, wrench, reference) = (six(&r.pose), six(&r.wrench), six(&r.reference));
            let (approach, warmer, wait) = (r.approach.sign(), r.delta_t_k, r.elapsed_s);
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                "{},{repeat},{pose},{wrench},{reference},{approach},{warmer},{wait},,,,,,",
                k + 1
            );
        }
    }
    Ok(text)
}
