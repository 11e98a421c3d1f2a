//! Tables of measurements that must be refused.

use super::bad_input;
use super::samples::{deflections, poses};

/// Two bytes per character without the mark that says so.
fn utf16() -> Vec<u8> {
    deflections().text().encode_utf16().flat_map(u16::to_le_bytes).collect()
}

/// A row of units whose first deflection is said to be in another one.
fn with_units(da: &str) -> String {
    let text = deflections().text();
    let (names, rows) = text.split_once('\n').unwrap_or_default();
    let units = names
        .split(',')
        .map(|name| if name == "da_um" { da } else { name.rsplit_once('_').map_or("", |(_, unit)| unit) });
    format!("{names}\n{}\n{rows}", units.collect::<Vec<_>>().join(","))
}

fn without_end(bytes: usize) -> String {
    let text = deflections().text();
    text[..text.len() - bytes].to_owned()
}

fn one_line_of(bytes: usize) -> String {
    deflections().text() + &"7".repeat(bytes)
}

bad_input! { "measurements.csv";
    an_empty_file_is_refused: "empty file", "" => (0, 0), "the file is empty";
    a_file_of_blank_lines_is_refused: "only blank lines and comments", "\n# nothing\n\n" => (0, 0), "empty";
    a_header_without_rows_is_refused: "header only", deflections().no_rows().text() => (0, 0), "no row";
    rows_without_a_header_are_refused: "no header line", "1,1,6.5\n1,2,6.5\n" => (1, 0), "must name the columns";
    a_single_column_is_refused: "no separator", "pose repeat a_mm b_mm\n1 1 2 3\n" => (1, 0), "no separator found";
    utf16_is_refused: "UTF-16 text", utf16() => (0, 0), "UTF-16";
    another_unit_below_the_name_is_refused: "row of units that contradicts the names", with_units("mm") => (2, 16), "says \"um\"";
    a_date_is_refused: "date made of a number", deflections().set("fz_N", "3. Mai").text() => (3, 11), "this is a date";
    nul_bytes_are_refused: "NUL bytes", deflections().set("fx_N", "0\u{0}").text() => (3, 0), "is NUL";
    a_gigantic_line_is_refused: "a line of several megabytes", one_line_of(3 << 20) => (4, 0), "longer than 1048576 bytes";
    a_table_of_too_many_columns_is_refused: "more than 4096 columns", "x_a,".repeat(5000) + "\n" => (1, 0), "columns; the limit is 4096";
    bare_carriage_returns_are_refused: "old Macintosh line ends", deflections().text().replace('\n', "\r")
        => (0, 0), "bare carriage return";

    a_missing_column_is_refused: "required column missing", deflections().without("c_mm").without("beta_deg").text()
        => (1, 0), "missing: c_mm, beta_deg";
    missing_moments_are_refused: "moments missing",
        deflections().without("mx_Nm").without("my_Nm").without("mz_Nm").text() => (1, 0), "mx_Nm, my_Nm, mz_Nm";
    a_table_without_measured_values_is_refused: "nothing measured", "pose,a_mm\n1,2\n" => (1, 0), "no measured values";
    a_missing_deflection_is_refused: "one deflection missing", deflections().without("dbeta_urad").text()
        => (1, 0), "missing: dbeta_urad";
    a_repeated_column_is_refused: "column twice", deflections().with("fz_N", "1").text() => (1, 22), "given twice";
    a_quantity_in_two_units_is_refused: "quantity in two units", deflections().with("fz [kN]", "1").text()
        => (1, 22), "already in column 11 (fz_N)";
    a_misspelled_column_is_refused: "misspelled column", deflections().rename("dalpha_urad", "dapha_urad").text()
        => (1, 19), "probably \"dalpha_urad\" is meant";
    a_misspelled_optional_column_is_refused: "misspelled optional column", deflections().rename("approach", "aproach").text()
        => (1, 15), "probably \"approach\" is meant";
    a_column_without_unit_is_refused: "no unit", deflections().rename("fz_N", "fz").text() => (1, 11), "has no unit";
    an_unknown_unit_is_refused: "unknown unit", deflections().rename("fz_N", "fz_dyn").text()
        => (1, 11), "\"dyn\" is not a known unit";
    an_ambiguous_unit_is_refused: "unit whose case matters", deflections().rename("fz_N", "fz_mn").text()
        => (1, 11), "\"mn\" is not a known unit";
    a_unit_of_another_kind_is_refused: "wrong kind of unit", deflections().rename("dalpha_urad", "dalpha_um").text()
        => (1, 19), "um is a unit of length, but dalpha is an angle";
    a_nameless_column_is_refused: "column without a name", deflections().rename("fz_N", "").text() => (1, 11), "no name";
    an_incomplete_reference_is_refused: "part of the reference wrench", deflections().with("ref_fz_N", "0").text()
        => (1, 0), "missing: ref_fx_N, ref_fy_N, ref_mx_Nm";
    incomplete_sigmas_are_refused: "part of the standard deviations", deflections().with("sigma_translation_um", "0.5").text()
        => (1, 0), "missing: sigma_alpha_urad, sigma_beta_urad, sigma_gamma_urad";
    both_modes_are_refused: "deflections and absolute poses", deflections().with("measured_a_mm", "0").text()
        => (1, 0), "both deflections";
    both_rotations_are_refused: "Euler differences and rotation vector", deflections().with("drx_urad", "0").text()
        => (1, 0), "both Euler differences";
    a_reference_of_absolute_poses_is_refused: "reference wrench with absolute poses",
        ["ref_fx_N", "ref_fy_N", "ref_fz_N", "ref_mx_Nm", "ref_my_Nm", "ref_mz_Nm"].iter()
            .fold(poses(), |table, name| table.with(name, "0")).text() => (1, 0), "no reference state";

    nan_is_refused: "NaN", deflections().set("db_um", "NaN").text() => (3, 17), "NaN and infinity are not values";
    infinity_is_refused: "infinity", deflections().set("db_um", "-inf").text() => (3, 17), "NaN and infinity";
    an_overflowing_number_is_refused: "number beyond double precision", deflections().set("db_um", "1e400").text()
        => (3, 17), "too large; the limit is 1e30";
    an_empty_cell_is_refused: "empty cell", deflections().set("fz_N", "").text() => (3, 11), "the cell is empty";
    an_empty_cell_of_a_column_that_may_be_absent_is_refused: "empty cell of an optional column",
        deflections().with("delta_T_K", "").text() => (2, 22), "(delta_T_K): the cell is empty";
    text_in_a_number_is_refused: "text instead of a number", deflections().set("fz_N", "heavy").text()
        => (3, 11), "(fz_N): \"heavy\": this is not a number";
    a_unit_in_a_cell_is_refused: "unit in the cell", deflections().set("fz_N", "-338.5 N").text() => (3, 11), "not a number";
    thousands_separators_are_refused: "thousands separator", deflections().set("fz_N", "\"-1,338.5\"").text()
        => (3, 11), "written with thousands separators";
    a_quoted_decimal_comma_is_refused: "decimal comma in a comma-separated table",
        deflections().set("fz_N", "\"-338,5\"").text() => (3, 11), "\"-338,5\": the number is written with a comma";
    a_decimal_comma_that_splits_a_cell_is_refused: "decimal comma that splits a cell",
        deflections().set("fz_N", "-338,5").text() => (3, 0), "22 cells, the header has 21";
    mixed_decimals_are_refused: "decimal commas and points in one table",
        deflections().set("fz_N", "-338,5").separated(";") => (3, 11), "line 2 has the other kind";
    a_short_row_is_refused: "row with too few cells", deflections().text().replacen("1,2,", "1,", 1)
        => (3, 0), "20 cells, the header has 21";
    a_long_row_is_refused: "row with too many cells", deflections().text().replacen("1,2,", "1,2,3,", 1)
        => (3, 0), "22 cells, the header has 21";
    a_truncated_file_is_refused: "last line cut", without_end(20) => (3, 0), "ends after 19 of 21 cells";
    an_open_quote_is_refused: "quotation mark not closed", deflections().set("fz_N", "\"-338").text()
        => (3, 0), "quotation mark is not closed";
    a_pose_name_is_refused: "name instead of a pose number", deflections().set("pose", "P1").text() => (3, 1), "whole number";
    a_fractional_repeat_is_refused: "repeat that is not whole", deflections().set("repeat", "1.5").text()
        => (3, 2), "whole number";
    another_approach_is_refused: "approach of 0", deflections().set("approach", "0").text() => (3, 15), "1 or -1";
    an_overload_that_is_none_is_refused: "overload of half the load",
        deflections().with("overload", "0.5").text() => (2, 22), "at least 1";
    a_doubled_place_in_the_sequence_is_refused: "two rows with one position in the sequence of loads",
        deflections().with("order", "4").text() => (3, 0), "line 2 has the same position";
    an_order_of_absolute_poses_is_refused: "sequence of absolute poses",
        poses().with("order", "1").text() => (1, 0), "applies to deflections only";
    a_negative_age_is_refused: "negative age of a reference load",
        deflections().with("ref_age_s", "-1").text() => (2, 22), "cannot be negative";
    an_age_beside_absolute_poses_is_refused: "age of a reference load with absolute poses",
        poses().with("ref_age_s", "60").text() => (1, 0), "no reference state";
    a_record_that_is_no_number_is_refused: "reference record with a name",
        deflections().with("ref_record", "morning").text() => (2, 22), "whole number";
    a_record_beside_absolute_poses_is_refused: "reference record with absolute poses",
        poses().with("ref_record", "1").text() => (1, 0), "no reference state";
    a_sigma_of_zero_is_refused: "standard deviation of zero",
        deflections().with("sigma_translation_um", "0").with("sigma_rotation_urad", "1").text()
        => (2, 22), "greater than zero";
    an_angle_beyond_a_turn_is_refused: "angle in the wrong unit",
        deflections().rename("alpha_deg", "alpha_rad").text() => (2, 6), "1.194 turns";
}
