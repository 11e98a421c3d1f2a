//! Too few readings, wrong ones, and noise that is not as stated.

use super::bench::{CLEAN, Share, Sound, YIELDING};
use super::fate::Fate;
use super::table::{Table, number};

/// The first rows, and the rows of the first poses.
pub(super) fn few(share: Share) -> Vec<Fate> {
    let all = &YIELDING.readings;
    let rows = (1..14).map(|count| Table { rows: all.rows[..count].to_vec(), ..all.clone() });
    let pose = all.column("pose");
    let poses = (1..8).map(|count| {
        let rows = all.rows.iter().filter(|row| number(&row[pose]) <= f64::from(count)).cloned();
        Table { rows: rows.collect(), ..all.clone() }
    });
    let tables: Vec<_> = rows.chain(poses).collect();
    share.each(&tables, |table| YIELDING.springs_of(table.text()))
}

const SIZES: [f64; 5] = [5.0, 8.0, 20.0, 100.0, 1000.0];

/// One to three numbers of a translation or a rotation off by so many standard deviations.
pub(super) fn blunders(share: Share) -> Vec<Fate> {
    let cells = [(31, "da_um", 0.5), (90, "dbeta_urad", 3.0), (140, "dc_um", 0.5)];
    let counts = SIZES.into_iter().flat_map(|size| (1..=3).map(move |count| (size, count)));
    let cases: Vec<_> = counts.flat_map(|case| [&*CLEAN, &*YIELDING].map(|sound| (case, sound))).collect();
    share.each(&cases, |((size, count), sound): &((f64, usize), &Sound)| {
        let mut table = sound.readings.clone();
        for (row, name, sigma) in &cells[..*count] {
            let column = table.column(name);
            let cell = &mut table.rows[*row][column];
            *cell = (number(cell) + size * sigma).to_string();
        }
        sound.diagnose(table.text())
    })
}

const CLAIMS: [f64; 8] = [0.3, 0.5, 0.7, 0.85, 1.2, 1.5, 2.0, 3.0];

/// Noise stated too small and too large.
pub(super) fn claims(share: Share) -> Vec<Fate> {
    let cases: Vec<_> =
        CLAIMS.into_iter().flat_map(|claim| [&*CLEAN, &*YIELDING].map(|s| (claim, s))).collect();
    share.each(&cases, |(claim, sound): &(f64, &Sound)| {
        let stated =
            |key: &str, value: f64| (format!("{key} = {value}\n"), format!("{key} = {}\n", value * claim));
        let changes = [stated("sigma_translation_um", 0.5), stated("sigma_rotation_urad", 3.0)];
        let machine = changes.iter().fold(sound.machine.clone(), |text, (old, new)| {
            assert!(text.contains(old), "{text}");
            text.replace(old, new)
        });
        sound.diagnose_of(machine, sound.readings.text())
    })
}
