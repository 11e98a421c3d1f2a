//! Numbers that are none, and numbers beyond everything.

use std::fs;

use super::bench::{Bench, FEW, SPARSE, Share, Sound};
use super::fate::Fate;
use crate::support::root;

const NO_NUMBERS: [&str; 5] = ["nan", "inf", "-inf", "", "x"];
const EXTREMES: [&str; 6] = ["1e308", "-1e308", "1e31", "1e12", "-1e12", "1e-320"];
/// What numbers of TOML files become.
const IN_FILES: [&str; 7] = ["1e308", "-1e308", "1e-320", "0", "-1", "nan", "inf"];

/// Every column of three rows.
pub(super) fn no_numbers(share: Share) -> Vec<Fate> {
    let table = &FEW.readings;
    let cells = [0, 7, 20].iter().flat_map(|row| (0..table.names.len()).map(move |column| (*row, column)));
    let cases: Vec<_> = cells.flat_map(|cell| NO_NUMBERS.map(|text| (cell, text))).collect();
    share.each(&cases, |((row, column), text)| FEW.fit(table.with(*row, *column, text).text()))
}

/// One row of every column.
pub(super) fn extremes(share: Share) -> Vec<Fate> {
    let table = &SPARSE.readings;
    let cases: Vec<_> =
        (0..table.names.len()).flat_map(|column| EXTREMES.map(|text| (column, text))).collect();
    share.each(&cases, |(column, text)| {
        let readings = table.with(10, *column, text);
        // What is a place, a load or a time to the reader may be one.
        let may_be = text.contains("-320") || !table.names[*column].starts_with('d');
        SPARSE.ask(readings.text()).where_sound(may_be)
    })
}

/// A text with each of its numbers in turn replaced by each of some others; numbers in quotation marks stay.
fn with_other_numbers(text: &str) -> Vec<String> {
    let mut all = Vec::new();
    let mut start = None;
    for (at, symbol) in text.char_indices().chain([(text.len(), ' ')]) {
        let in_number = symbol.is_ascii_digit() || ['.', '-', '+', 'e'].contains(&symbol);
        match (start, in_number) {
            (None, true) if text[..at].ends_with([' ', '[']) => start = Some(at),
            (Some(from), false) => {
                if text[from..at].parse::<f64>().is_ok() {
                    let old: f64 = text[from..at].parse().unwrap();
                    let others =
                        IN_FILES.iter().filter(|new| new.parse::<f64>().unwrap().to_bits() != old.to_bits());
                    all.extend(others.map(|new| [&text[..from], new, &text[at..]].concat()));
                }
                start = None;
            }
            _ => {}
        }
    }
    all
}

/// Numbers of a machine, of a scene, of a model that is trusted.
pub(super) fn in_files(share: Share) -> Vec<Fate> {
    let Sound { machine, readings, .. } = &*SPARSE;
    // Two legs stand for six.
    let machines: Vec<_> = with_other_numbers(machine).into_iter().step_by(3).collect();
    let mut fates =
        share.each(&machines, |machine| SPARSE.ask_of(machine, readings.text()).where_sound(true));
    let scene = fs::read_to_string(root().join("scenes/hidden-1/scene.toml")).unwrap();
    fates.extend(share.each(&with_other_numbers(&scene), |scene| simulated(scene)));
    let model = fitted();
    let models: Vec<_> = with_other_numbers(&model).into_iter().step_by(5).collect();
    fates.extend(share.each(&models, |model| predicted(model)));
    fates
}

fn simulated(scene: &str) -> Fate {
    let bench = Bench::empty();
    let source = root().join("scenes/hidden-1");
    fs::create_dir_all(bench.at("scene/sealed")).unwrap();
    for name in ["hexapod.toml", "sealed/truth.toml"] {
        fs::copy(source.join(name), bench.at("scene").join(name)).unwrap();
    }
    bench.write("scene/scene.toml", scene);
    let run = bench.run(&["simulate", "scene", "-o", "out"]);
    if run.code != Some(0) {
        return Fate::of_refusal(&run);
    }
    // A number that a scene may have makes a campaign whose numbers can be read.
    let read = bench.run(&["compare", "out/hexapod.toml", "out/measurements.csv", "--json", "x.json"]);
    if read.code == Some(0) { Fate::Survived } else { Fate::of_refusal(&read) }
}

fn fitted() -> String {
    let bench = Bench::with(&FEW.machine, FEW.readings.text());
    let run = bench.run(&["fit", "hexapod.toml", "measurements.csv", "-o", "model.toml"]);
    assert_eq!(run.code, Some(0), "{}", run.said);
    fs::read_to_string(bench.at("model.toml")).unwrap()
}

/// A model that a hand has changed is refused by its seal.
fn predicted(model: &str) -> Fate {
    let bench = Bench::with(&FEW.machine, FEW.readings.text());
    bench.write("model.toml", model);
    Fate::of_refusal(&bench.run(&["predict", "model.toml", "measurements.csv"]))
}
