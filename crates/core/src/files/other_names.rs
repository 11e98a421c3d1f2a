//! Names that other programs give to the same quantities: for hints, never read as such.

use super::column_name::without_brackets;
use super::columns::{COLUMNS, Column};
use super::units::unit_named;

/// Columns of the three axes, and what they hold.
type Triple = [&'static str; 3];

const POSITION: Triple = ["a", "b", "c"];
const ANGLES: Triple = ["alpha", "beta", "gamma"];
const FORCE: Triple = ["fx", "fy", "fz"];
const MOMENT: Triple = ["mx", "my", "mz"];
const SHIFT: Triple = ["da", "db", "dc"];
const TURN: Triple = ["dalpha", "dbeta", "dgamma"];
const ROTATION_VECTOR: Triple = ["drx", "dry", "drz"];
const MEASURED_POSITION: Triple = ["measured_a", "measured_b", "measured_c"];
const MEASURED_ANGLES: Triple = ["measured_alpha", "measured_beta", "measured_gamma"];

/// Names of three axes elsewhere, in small letters, and the columns here that they may stand for. Names alone do not tell in which order
/// angles turn.
const AXES: [(Triple, &[Triple]); 7] = [
    (["x", "y", "z"], &[POSITION, MEASURED_POSITION, SHIFT]),
    (["rx", "ry", "rz"], &[ANGLES, MEASURED_ANGLES, ROTATION_VECTOR, TURN]),
    (["u", "v", "w"], &[ANGLES, MEASURED_ANGLES, TURN]),
    (["roll", "pitch", "yaw"], &[ANGLES, MEASURED_ANGLES, TURN]),
    (["dx", "dy", "dz"], &[SHIFT]),
    (["du", "dv", "dw"], &[TURN]),
    (["tx", "ty", "tz"], &[MOMENT, POSITION]),
];

/// Names of single quantities elsewhere, likewise.
const SINGLE: [(&str, &[&str]); 7] = [
    ("t", &["elapsed", "delta_T"]),
    ("time", &["elapsed"]),
    ("zeit", &["elapsed"]),
    ("dt", &["delta_T", "elapsed"]),
    ("temp", &["delta_T"]),
    ("temperature", &["delta_T"]),
    ("temperatur", &["delta_T"]),
];

/// Words of other languages before an axis, small and without accents, and the columns of the three axes.
const QUANTITIES: [(&[&str], Triple); 6] = [
    (&["kraft", "force", "fuerza", "forza", "effort", "load", "last"], FORCE),
    (&["moment", "drehmoment", "momento", "couple", "torque", "par"], MOMENT),
    (&["position", "posicion", "posizione", "lage"], POSITION),
    (&["winkel", "angle", "angulo", "angolo"], ANGLES),
    (
        &[
            "verschiebung",
            "weg",
            "deplacement",
            "desplazamiento",
            "spostamento",
            "displacement",
            "deflection",
            "delta",
        ],
        SHIFT,
    ),
    (&["verdrehung", "rotation", "rotacion", "giro", "rotazione"], TURN),
];

/// `X_mm is a_mm` for each name that stands for one of the `wanted` columns.
pub(crate) fn likely<'a>(
    names: impl IntoIterator<Item = &'a str>,
    wanted: impl Fn(&Column) -> bool,
) -> Vec<String> {
    let pair = |text: &'a str| Some(format!("{} is {}", text.trim(), stands_for(text, &wanted)?));
    names.into_iter().filter_map(pair).collect()
}

/// The `wanted` column that a name of another program stands for, with its unit: of several that one whose usual unit it is.
pub(crate) fn stands_for(text: &str, wanted: impl Fn(&Column) -> bool) -> Option<String> {
    let (base, bracketed) = without_brackets(text.trim());
    let words: Vec<&str> = base.split(['_', ' ', '-', '.']).filter(|word| !word.is_empty()).collect();
    let (names, used) = columns_of(&words)?;
    let rest = words[used..].join("_");
    let stated = bracketed.or((!rest.is_empty()).then_some(rest.as_str()));
    let unit = |column: &Column| stated.and_then(|text| unit_named(text, column.kind));
    let columns = names.iter().filter_map(|name| COLUMNS.iter().find(|column| column.name == *name));
    let fits = |column: &&Column| wanted(column) && unit(column).is_none_or(|unit| unit.kind == column.kind);
    let is_usual = |column: &&Column| unit(column).is_some_and(|unit| unit.name == column.usual_unit());
    let fitting: Vec<&Column> = columns.filter(fits).collect();
    let meant = fitting.iter().copied().find(is_usual).or(fitting.first().copied())?;
    // Of the temperature in C, which is no unit here, the usual unit is proposed.
    let stated = stated.filter(|_| unit(meant).is_some());
    Some(stated.map_or_else(|| meant.usual_name(), |unit| format!("{}_{unit}", meant.name)))
}

/// The columns that the first words may stand for, and how many these words are.
fn columns_of(words: &[&str]) -> Option<(Vec<&'static str>, usize)> {
    let first = plain(words.first()?);
    let of_axes = AXES.iter().find_map(|(names, triples)| {
        let axis = names.iter().position(|name| *name == first)?;
        Some(triples.iter().map(|triple| triple[axis]).collect())
    });
    let single = || SINGLE.iter().find(|(name, _)| *name == first).map(|(_, columns)| columns.to_vec());
    if let Some(columns) = of_axes.or_else(single) {
        return Some((columns, 1));
    }
    let axis =
        ["x", "y", "z"].iter().position(|axis| words.get(1).is_some_and(|word| plain(word) == *axis))?;
    let (_, columns) = QUANTITIES.iter().find(|(names, _)| names.contains(&first.as_str()))?;
    Some((vec![columns[axis]], 2))
}

fn plain(word: &str) -> String {
    let without_accent = |symbol: char| match symbol {
        'á' | 'à' | 'â' => 'a',
        'é' | 'è' | 'ê' => 'e',
        'í' => 'i',
        'ó' | 'ô' => 'o',
        'ú' => 'u',
        other => other,
    };
    word.chars().flat_map(char::to_lowercase).map(without_accent).collect()
}

#[cfg(test)]
mod tests {
    use super::{Column, likely, stands_for};

    #[test]
    fn a_hint_keeps_the_unit_and_names_only_what_is_wanted() {
        let among = |names: &'static [&str]| move |column: &Column| names.contains(&column.name);
        // A unit that no column takes would be refused next.
        for (column, meant) in [("W_mrad", "gamma_mrad"), ("W_mdeg", "gamma_deg")] {
            let header = ["X [um]", "Y [um]", column, "yaw", "humidity"];
            let hint = format!("{column} is {meant}");
            assert_eq!(
                likely(header, among(&["a", "gamma"])),
                ["X [um] is a_um", hint.as_str(), "yaw is gamma_deg"]
            );
        }
        let header = ["Kraft z [kN]", "Couple_x_Nm", "Déplacement x", "Kraftz", "Force y"];
        assert_eq!(
            likely(header, among(&["fz", "mx", "da"])),
            ["Kraft z [kN] is fz_kN", "Couple_x_Nm is mx_Nm", "Déplacement x is da_um"]
        );
    }

    #[test]
    fn the_unit_tells_which_of_several_columns_is_meant() {
        let any = |_: &Column| true;
        for (elsewhere, here) in [
            ("x_um", "da_um"),
            ("x_mm", "a_mm"),
            ("T_K", "delta_T_K"),
            ("t [s]", "elapsed_s"),
            ("dT_degC", "delta_T_degC"),
            ("temp_C", "delta_T_K"),
            ("tx_Nm", "mx_Nm"),
            ("rz_urad", "drz_urad"),
            ("delta_y_um", "db_um"),
        ] {
            assert_eq!(stands_for(elsewhere, any).as_deref(), Some(here), "{elsewhere}");
        }
        assert_eq!(stands_for("dx_urad", any), None);
        assert_eq!(stands_for("humidity_%", any), None);
    }
}
