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

/// `X_mm is a_mm` for each name of a header that stands for one of the missing columns.
pub(crate) fn likely<'a>(header: impl Iterator<Item = &'a str>, missing: &[String]) -> Vec<String> {
    let stands_for = |text: &'a str| {
        let (base, bracketed) = without_brackets(text.trim());
        let base = base.trim().replace([' ', '-'], "_");
        let (name, unit) = base.split_once('_').map_or((base.as_str(), bracketed), |(n, u)| (n, Some(u)));
        let lower = name.to_lowercase();
        let here = ELSEWHERE.iter().find(|(elsewhere, _)| *elsewhere == lower)?.1;
        let usual = missing.iter().find(|column| column.split('_').next() == Some(here))?;
        let unit = unit.map_or_else(|| usual.clone(), |unit| format!("{here}_{unit}"));
        Some(format!("{} is {unit}", text.trim()))
    };
    header.filter_map(stands_for).collect()
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
    }
}
