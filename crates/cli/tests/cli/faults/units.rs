//! Numbers in another unit than their name says, and optional numbers that are wrong.

use super::bench::{SPARSE, Share};
use super::fate::Fate;
use super::table::{Table, number};

const FORCES: [&str; 6] = ["fx_N", "fy_N", "fz_N", "ref_fx_N", "ref_fy_N", "ref_fz_N"];
const MOMENTS: [&str; 6] = ["mx_Nm", "my_Nm", "mz_Nm", "ref_mx_Nm", "ref_my_Nm", "ref_mz_Nm"];
const SHIFTS: [&str; 3] = ["da_um", "db_um", "dc_um"];
const TURNS: [&str; 3] = ["dalpha_urad", "dbeta_urad", "dgamma_urad"];
const PLACES: [&str; 3] = ["a_mm", "b_mm", "c_mm"];
const ANGLES: [&str; 3] = ["alpha_deg", "beta_deg", "gamma_deg"];

const DEGREES: f64 = 57.295_779_513_082_32;

/// The stiffness of a leg in the drawing of a machine that states one.
const NOMINAL: &str = "\n[legs]\nnominal_stiffness_N_per_um = 3.5\n";

/// Groups of columns, the factors by which people mistake them, and whether springs of another size say the same.
pub(super) fn groups(share: Share) -> Vec<Fate> {
    let loads: Vec<&str> = FORCES.into_iter().chain(MOMENTS).collect();
    let readings: Vec<&str> = SHIFTS.into_iter().chain(TURNS).collect();
    let of: [(&[&str], &[f64], bool); 8] = [
        (&FORCES, &[1000.0, 1e-3, 9.806_65, 1.0 / 9.806_65, 4.448_22, 1.0 / 4.448_22], false),
        (&MOMENTS, &[1000.0, 1e-3, 9.806_65, 1.0 / 9.806_65, 0.112_985, 1.355_82], false),
        (&loads, &[1000.0, 1e-3, 9.806_65, 4.448_22], true),
        (&SHIFTS, &[1000.0, 1e-3, 25.4, 1.0 / 25.4], false),
        (&TURNS, &[1000.0, 1e-3, DEGREES, 1.0 / DEGREES, 4.848_14, 17.4533], false),
        (&readings, &[1000.0, 1e-3, 25.4], true),
        (&PLACES, &[1000.0, 1e-3, 10.0, 0.1, 25.4, 1.0 / 25.4], false),
        (&ANGLES, &[DEGREES, 1.0 / DEGREES, 60.0, 1.0 / 60.0], false),
    ];
    let cases: Vec<_> = of
        .iter()
        .flat_map(|(names, factors, alike)| factors.iter().map(move |f| (*names, *f, *alike)))
        .collect();
    let mut fates = share.each(&cases, |(names, factor, alike)| {
        SPARSE.ask(SPARSE.readings.scaled(names, *factor).text()).where_sound(*alike)
    });
    // What is alike without a stated stiffness is not with one.
    let stated = [&SPARSE.machine, NOMINAL].concat();
    let alike: Vec<_> =
        cases.iter().filter(|(_, factor, alike)| *alike && (*factor).log10().abs() >= 1.0).collect();
    fates.extend(share.each(&alike, |(names, factor, _)| {
        SPARSE.ask_of(&stated, SPARSE.readings.scaled(names, *factor).text())
    }));
    let joints = [10.0, 0.1, 25.4, 1.0 / 25.4, 1000.0, 1e-3];
    fates.extend(
        share.each(&joints, |factor| SPARSE.ask_of(scaled(&SPARSE.machine, *factor), SPARSE.readings.text())),
    );
    fates
}

/// A machine whose joints are all multiplied.
fn scaled(machine: &str, factor: f64) -> String {
    let line = |line: &str| match line.trim().strip_prefix('[').and_then(|rest| rest.strip_suffix("],")) {
        Some(cells) => {
            let cells = cells.split(',').map(|cell| (number(cell.trim()) * factor).to_string());
            format!("[{}],\n", cells.collect::<Vec<_>>().join(", "))
        }
        None => format!("{line}\n"),
    };
    machine.lines().map(line).collect()
}

/// Numbers that a machine need not state, wrongly stated.
pub(super) fn optional(share: Share) -> Vec<Fate> {
    let keys = [
        ("legs", "nominal_stiffness_N_per_um", &["3500", "0.0035", "1e-9", "1e12", "-3.5", "0"][..]),
        ("base", "mounting_plane_z_mm", &["200", "-2000", "-20000", "-200000", "9e7", "nan"]),
        ("payload", "center_of_gravity_mm", &["[0, 0, 4e5]", "[4e4, 0, 0]", "[0, 0]", "4"]),
    ];
    let one = |(table, key, values): (&str, &str, &'static [&'static str])| {
        let (table, key) = (table.to_owned(), key.to_owned());
        values.iter().map(move |value| format!("\n[{table}]\n{key} = {value}\n")).collect::<Vec<_>>()
    };
    let strokes = [(1000, 2000), (1, 2), (2000, 1000), (0, 10)];
    let strokes =
        strokes.map(|(least, most)| format!("\n[legs]\nmin_length_mm = {least}\nmax_length_mm = {most}\n"));
    let cases: Vec<_> = keys.into_iter().flat_map(one).chain(strokes).collect();
    share
        .each(&cases, |more| SPARSE.ask_of([&SPARSE.machine, more.as_str()].concat(), SPARSE.readings.text()))
}

/// Names of the columns of loads, readings and poses in threes.
pub(super) const WRENCHES: [[&str; 3]; 4] = [
    ["fx_N", "fy_N", "fz_N"],
    ["mx_Nm", "my_Nm", "mz_Nm"],
    ["ref_fx_N", "ref_fy_N", "ref_fz_N"],
    ["ref_mx_Nm", "ref_my_Nm", "ref_mz_Nm"],
];
/// The same of readings.
pub(super) const READINGS: [[&str; 3]; 2] = [SHIFTS, TURNS];
/// The same of poses.
pub(super) const POSES: [[&str; 3]; 2] = [PLACES, ANGLES];

/// The numbers of three columns of a row.
pub(super) fn three(table: &Table, row: usize, names: [&str; 3]) -> [f64; 3] {
    names.map(|name| number(&table.rows[row][table.column(name)]))
}
