//! Plans that must be refused. Measured values are passed over: only what is to be done, and how well it is read, can be wrong.

use super::bad_input;
use super::samples::{Table, deflections};

/// A plan of two rows.
fn plan() -> Table {
    ["da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"]
        .iter()
        .fold(deflections(), |table, name| table.without(name))
}

bad_input! { "plan.csv";
    an_empty_plan_is_refused: "empty file", "" => (0, 0), "the file is empty";
    a_plan_without_loads_is_refused: "loads missing", plan().without("fz_N").text() => (1, 0), "missing: fz_N";
    a_load_that_is_no_number_is_refused: "text instead of a load", plan().set("fz_N", "heavy").text()
        => (3, 11), "this is not a number";
    a_plan_with_half_a_reference_is_refused: "part of the reference wrench", plan().with("ref_fz_N", "0").text()
        => (1, 0), "must be complete or absent";
    a_plan_without_its_rotation_noise_is_refused: "part of the standard deviations",
        plan().with("sigma_translation_um", "0.5").text() => (1, 0), "missing: sigma_alpha_urad";
    a_plan_with_a_sigma_of_zero_is_refused: "standard deviation of zero",
        plan().with("sigma_translation_um", "0").with("sigma_rotation_urad", "1").text()
        => (2, 16), "greater than zero";
}
