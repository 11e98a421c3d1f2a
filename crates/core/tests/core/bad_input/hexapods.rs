//! Hexapods that must be refused.

use super::bad_input;
use super::samples::{HEXAPOD, hexapod};

const JOINT: &str = "[-54.75, 150.25, -165]";

fn without_base() -> String {
    let (before, rest) = HEXAPOD.split_once("base_joints_mm").unwrap();
    let (_, after) = rest.split_once("platform_joints_mm").unwrap();
    format!("{before}platform_joints_mm{after}")
}

bad_input! { "hexapod.toml";
    an_empty_hexapod_is_refused: "empty file", "" => (0, 0), "must be \"hexapod/1\"";
    broken_toml_is_refused: "not TOML", hexapod("[geometry]", "[geometry") => (4, 10), "not valid TOML";
    another_format_is_refused: "another format", hexapod("hexapod/1", "hexapod/9") => (1, 10), "must be \"hexapod/1\"";
    a_later_format_is_named_before_its_new_keys: "later format", hexapod("hexapod/1\"", "hexapod/2\"\nnew = 1")
        => (1, 10), "must be";
    a_missing_key_is_refused: "required key missing", without_base()
        => (0, 0), "\"base_joints_mm\" is missing";
    a_misspelled_key_is_refused: "misspelled key", hexapod("sigma_rotation_urad", "sigma_rotaton_urad")
        => (24, 1), "probably \"sigma_rotation_urad\" is meant";
    an_unknown_key_is_refused: "unknown key", hexapod("[base]", "[base]\ncolour = 1") => (33, 1), "unknown key";
    a_key_without_unit_is_refused: "key without unit", hexapod("min_length_mm", "min_length") => (28, 1), "has no unit";
    a_key_in_an_unknown_unit_is_refused: "key with an unknown unit", hexapod("min_length_mm", "min_length_ft")
        => (28, 1), "\"ft\" is not a known unit";
    a_key_in_two_units_is_refused: "key in two units", hexapod("min_length_mm = 150", "min_length_mm = 150\nmin_length_m = 0.15")
        => (29, 1), "given twice";
    seven_joints_are_refused: "wrong number of joints", hexapod(JOINT, "[0, 0, 0], [-54.75, 150.25, -165]")
        => (5, 18), "expected six joints, found 7";
    a_flat_joint_is_refused: "joint with two coordinates", hexapod(JOINT, "[-54.75, 150.25]")
        => (8, 3), "expected three coordinates [x, y, z], found 2";
    a_nan_in_a_joint_is_refused: "NaN in a joint", hexapod(JOINT, "[-54.75, nan, -165]") => (8, 12), "NaN and infinity";
    an_infinity_in_a_joint_is_refused: "infinity in a joint", hexapod(JOINT, "[-54.75, 1e400, -165]")
        => (8, 12), "too large; the limit is 1e30";
    text_in_a_joint_is_refused: "text in a joint", hexapod(JOINT, "[-54.75, \"150\", -165]")
        => (8, 12), "expected a number, found string";
    a_table_that_is_a_number_is_refused: "number instead of a table", hexapod("[base]\nmounting_plane_z_mm = -170\n", "")
        .replacen("name =", "base = 3\nname =", 1) => (2, 8), "expected a table, found integer";
    coinciding_joints_are_refused: "two joints at one point", hexapod(JOINT, "[157.5, 27.75, -165]")
        => (8, 3), "base joints 2 and 3 are at the same point";
    a_leg_without_length_is_refused: "leg without length", hexapod("[77.25, 92, 0]", "[157.5, 27.75, -165]")
        => (13, 22), "leg 2 has no length";
    metres_taken_for_millimetres_are_refused: "joints in the wrong unit",
        hexapod("platform_joints_mm", "platform_joints_nm") => (13, 22), "hexapod measures between 1 mm and";
    a_sigma_of_zero_is_refused: "standard deviation of zero", hexapod("sigma_translation_um = 0.5", "sigma_translation_um = 0")
        => (23, 24), "standard deviation must be greater than zero";
    a_negative_stiffness_is_refused: "negative stiffness", hexapod("4.5", "[4, 4, 4, 4, 4, -4]") => (27, 46), "stiffness must be greater";
    a_stroke_in_reverse_is_refused: "stroke limits in reverse", hexapod("min_length_mm = 150", "min_length_mm = 300")
        => (29, 17), "smaller than the longest";
    half_a_stroke_is_refused: "one stroke limit", hexapod("min_length_mm = 150\n", "") => (0, 0), "\"min_length_mm\" is missing";
    a_seventh_leg_is_refused: "bracket with leg 7", hexapod("[5, 6]", "[5, 7]") => (30, 29), "numbered 1 to 6";
    a_key_stated_twice_is_refused: "key twice", HEXAPOD.replacen("name = \"bench\"", "name = \"a\"\nname = \"b\"", 1)
        => (3, 1), "not valid TOML";
}
