//! Names that other programs give to the same quantities: for hints, never read as such.

use super::column_name::without_brackets;

/// Names elsewhere, in small letters, and the column here. Names alone do not tell in which order angles turn.
const ELSEWHERE: [(&str, &str); 18] = [
    ("x", "a"),
    ("y", "b"),
    ("z", "c"),
    ("rx", "alpha"),
    ("ry", "beta"),
    ("rz", "gamma"),
    ("u", "alpha"),
    ("v", "beta"),
    ("w", "gamma"),
    ("roll", "alpha"),
    ("pitch", "beta"),
    ("yaw", "gamma"),
    ("dx", "da"),
    ("dy", "db"),
    ("dz", "dc"),
    ("du", "dalpha"),
    ("dv", "dbeta"),
    ("dw", "dgamma"),
];

/// Words of other languages before an axis, small and without accents, and the columns of the three axes.
const QUANTITIES: [(&[&str], [&str; 3]); 6] = [
    (&["kraft", "force", "fuerza", "forza", "effort", "load", "last"], ["fx", "fy", "fz"]),
    (&["moment", "drehmoment", "momento", "couple", "torque", "par"], ["mx", "my", "mz"]),
    (&["position", "posicion", "posizione", "lage"], ["a", "b", "c"]),
    (&["winkel", "angle", "angulo", "angolo"], ["alpha", "beta", "gamma"]),
    (
        &[
            "verschiebung",
            "weg",
            "deplacement",
            "desplazamiento",
            "spostamento",
            "displacement",
            "deflection",
        ],
        ["da", "db", "dc"],
    ),
    (&["verdrehung", "rotation", "rotacion", "giro", "rotazione"], ["dalpha", "dbeta", "dgamma"]),
];

/// `X_mm is a_mm` for each name of a header that stands for one of the missing columns.
pub(crate) fn likely<'a>(header: impl Iterator<Item = &'a str>, missing: &[String]) -> Vec<String> {
    let stands_for = |text: &'a str| {
        let (base, bracketed) = without_brackets(text.trim());
        let words: Vec<&str> = base.split(['_', ' ', '-', '.']).filter(|word| !word.is_empty()).collect();
        let (here, used) = column_of(&words)?;
        let rest = words[used..].join("_");
        let unit = bracketed.or((!rest.is_empty()).then_some(rest.as_str()));
        let usual = missing.iter().find(|column| column.split('_').next() == Some(here))?;
        let unit = unit.map_or_else(|| usual.clone(), |unit| format!("{here}_{unit}"));
        Some(format!("{} is {unit}", text.trim()))
    };
    header.filter_map(stands_for).collect()
}

/// The column that the first words stand for, and how many they are.
fn column_of(words: &[&str]) -> Option<(&'static str, usize)> {
    let first = plain(words.first()?);
    if let Some((_, here)) = ELSEWHERE.iter().find(|(elsewhere, _)| *elsewhere == first) {
        return Some((here, 1));
    }
    let axis =
        ["x", "y", "z"].iter().position(|axis| words.get(1).is_some_and(|word| plain(word) == *axis))?;
    let (_, columns) = QUANTITIES.iter().find(|(names, _)| names.contains(&first.as_str()))?;
    Some((columns[axis], 2))
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
    use super::likely;

    #[test]
    fn a_hint_keeps_the_unit_and_names_only_what_is_missing() {
        let missing = ["a_mm", "gamma_deg"].map(str::to_owned);
        let header = ["X [um]", "Y [um]", "W_mdeg", "yaw", "humidity"];
        assert_eq!(
            likely(header.into_iter(), &missing),
            ["X [um] is a_um", "W_mdeg is gamma_mdeg", "yaw is gamma_deg"]
        );
        let missing = ["fz_N", "mx_Nm", "da_um"].map(str::to_owned);
        let header = ["Kraft z [kN]", "Couple_x_Nm", "Déplacement x", "Kraftz", "Force y"];
        assert_eq!(
            likely(header.into_iter(), &missing),
            ["Kraft z [kN] is fz_kN", "Couple_x_Nm is mx_Nm", "Déplacement x is da_um"]
        );
    }
}
