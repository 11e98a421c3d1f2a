//! Bytes: cut, flipped, exchanged, too many, of another encoding.

use std::fs::File;

use super::bench::{Bench, FEW, Share};
use super::chance::Chance;
use super::fate::Fate;
use super::table::Table;

/// Readings cut at every 5th byte, and the machine at every 2nd.
pub(super) fn cuts(share: Share) -> Vec<Fate> {
    let text = FEW.readings.text();
    let places: Vec<_> = (0..text.len()).step_by(5).chain(line_ends(&text)).collect();
    let mut fates =
        share.each(&places, |cut| FEW.fit(&text[..*cut]).where_sound(text[..*cut].ends_with('\n')));
    let machine = &FEW.machine;
    let places: Vec<_> = (0..machine.len()).step_by(2).collect();
    fates.extend(share.each(&places, |cut| {
        // What may be left out is behind the last bracket.
        FEW.fit_of(&machine[..*cut], &text).where_sound(machine[..*cut].trim_end().ends_with(']'))
    }));
    fates
}

/// Where a row ends and two rows or more are left.
fn line_ends(text: &str) -> impl Iterator<Item = usize> {
    text.match_indices('\n').map(|(at, _)| at + 1).filter(|end| *end < text.len())
}

/// One bit of the readings, one of the machine.
pub(super) fn flips(share: Share) -> Vec<Fate> {
    let text = FEW.readings.text();
    let seeds: Vec<u64> = (0..600).collect();
    let mut fates = share.each(&seeds, |seed| {
        let bytes = flipped(text.as_bytes(), *seed);
        let is_sound = std::str::from_utf8(&bytes).is_ok_and(|t| Table::of(t).is_sound_beside(&FEW.readings));
        FEW.fit(bytes).where_sound(is_sound)
    });
    fates.extend(share.each(&seeds[..300], |seed| {
        let bytes = flipped(FEW.machine.as_bytes(), *seed);
        let is_sound = differ_in_numbers(&bytes, FEW.machine.as_bytes());
        FEW.fit_of(bytes, &text).where_sound(is_sound)
    }));
    fates
}

fn flipped(bytes: &[u8], seed: u64) -> Vec<u8> {
    let mut chance = Chance(seed);
    let mut bytes = bytes.to_vec();
    let at = chance.below(bytes.len());
    bytes[at] ^= 1 << chance.below(8);
    bytes
}

/// True where only characters of numbers, names and remarks differ.
fn differ_in_numbers(bytes: &[u8], sound: &[u8]) -> bool {
    let of_number = |byte: &u8| byte.is_ascii_digit() || b".-+e_ #".contains(byte);
    bytes.iter().zip(sound).all(|(a, b)| a == b || (of_number(a) && of_number(b)))
}

/// Rows and cells of the readings.
pub(super) fn shuffles(share: Share) -> Vec<Fate> {
    let seeds: Vec<u64> = (0..400).collect();
    share.each(&seeds, |seed| {
        let table = shuffled(*seed);
        FEW.ask(table.text()).where_sound(table.is_sound_beside(&FEW.readings))
    })
}

fn shuffled(seed: u64) -> Table {
    let mut table = FEW.readings.clone();
    let mut chance = Chance(seed);
    let [one, other] = [chance.below(table.rows.len()), chance.below(table.rows.len())];
    let [cell, another] = [chance.below(table.names.len()), chance.below(table.names.len())];
    match chance.below(7) {
        0 => drop(table.rows.remove(one)),
        1 => table.rows.insert(other, table.rows[one].clone()),
        2 => table.rows.swap(one, other),
        3 => table.rows[one].swap(cell, another),
        4 => drop(table.rows[one].remove(cell)),
        5 => table.rows[one].insert(cell, "0".into()),
        _ => table.names.swap(cell, another),
    }
    table
}

/// Files beyond every size.
pub(super) fn sizes(share: Share) -> Vec<Fate> {
    let (head, _) = FEW.readings.text().split_once('\n').map(|(a, b)| (a.to_owned(), b.to_owned())).unwrap();
    let wide = (0..100_000).map(|k| format!("c{k}_mm,")).collect::<Vec<_>>().concat();
    let text = FEW.readings.text();
    let tables = [
        [text.as_str(), &"1".repeat(50 << 20), "\n"].concat(),
        [&"x".repeat(2 << 20), ",", &text].concat(),
        [&wide, "\n", &wide.replace('c', "1"), "\n"].concat(),
        [&head, &"\n".repeat(5_000_000), &text[head.len()..]].concat(),
        text.replace(',', &[",", &" ".repeat(1000)].concat()),
    ];
    let mut fates = share.each(&tables, |table| FEW.fit(table));
    fates.extend(share.each(&["hexapod.toml", "measurements.csv"], |name| {
        let bench = Bench::with(&FEW.machine, &text);
        File::create(bench.at(name)).unwrap().set_len(1 << 30).unwrap();
        Fate::of_refusal(&bench.run(&["fit", "hexapod.toml", "measurements.csv"]))
    }));
    fates
}

fn utf16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    std::iter::once(0xfeff).chain(text.encode_utf16()).flat_map(bytes).collect()
}

/// The same texts in other bytes.
pub(super) fn encodings(share: Share) -> Vec<Fate> {
    let (text, machine) = (FEW.readings.text(), &FEW.machine);
    let forms: [fn(&str) -> Vec<u8>; 14] = [
        |t| ["\u{feff}", t].concat().into_bytes(),
        |t| utf16(t, u16::to_le_bytes),
        |t| utf16(t, u16::to_be_bytes),
        |t| utf16(t, u16::to_le_bytes)[2..].to_vec(),
        |t| t.replace('\n', "\r\n").into_bytes(),
        |t| t.replace('\n', "\r").into_bytes(),
        |t| [t.as_bytes(), b"\0"].concat(),
        |t| [b"# \xff\xfe\n", t.as_bytes()].concat(),
        |t| [b"# \xb5m\n", t.as_bytes()].concat(),
        |t| ["\u{202e}", t].concat().into_bytes(),
        |t| t.replace(' ', "\u{a0}").into_bytes(),
        |t| t.trim_end().as_bytes().to_vec(),
        |t| [t, "\u{1a}"].concat().into_bytes(),
        |t| t.replace('-', "\u{2212}").into_bytes(),
    ];
    let mut fates = share.each(&forms, |form| FEW.fit(form(&text)));
    fates.extend(share.each(&forms, |form| FEW.fit_of(form(machine), &text)));
    let separators: [fn(&str) -> String; 5] = [
        |t| t.replace(',', ";"),
        |t| t.replace(',', "\t"),
        |t| t.replace(',', ";").replace('.', ","),
        |t| t.replace(',', " "),
        |t| format!("\"{}\"\n", t.trim_end().replace(',', "\",\"").replace('\n', "\"\n\"")),
    ];
    fates.extend(share.each(&separators, |change| FEW.fit(change(&text))));
    fates
}
