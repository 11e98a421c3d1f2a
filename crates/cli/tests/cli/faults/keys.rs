//! Lines of TOML files that are not as they should be.

use std::fs;

use serde_json::Value;

use super::bench::{Bench, FEW, Share};
use super::fate::Fate;
use crate::support::root;

/// A study that is over at once.
pub(super) const STUDY: &str = "format = \"study/1\"\ntitle = \"short\"\nseed = 3\ntrials = 8\ntask = \"springs\"\n\
                     [axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\nposes = [3]\nnoise_scale = [1]\n";

/// A file, and the command that reads it.
struct Reader {
    name: &'static str,
    text: String,
    words: &'static [&'static str],
    /// What it writes.
    output: &'static str,
}

fn readers() -> [Reader; 4] {
    let read = |path: &str| fs::read_to_string(root().join(path)).unwrap();
    [
        Reader {
            name: "hexapod.toml",
            text: FEW.machine.clone(),
            words: &["fit", "hexapod.toml", "measurements.csv", "--json", "out"],
            output: "out",
        },
        Reader {
            name: "scene/scene.toml",
            text: read("scenes/hidden-1/scene.toml"),
            words: &["simulate", "scene", "-o", "sim"],
            output: "sim/measurements.csv",
        },
        Reader {
            name: "study.toml",
            text: STUDY.into(),
            words: &["study", "study.toml", "-o", "out"],
            output: "out/cells.csv",
        },
        Reader {
            name: "term.toml",
            text: read("fuzz/corpus/term/shape"),
            words: &["fit", "hexapod.toml", "measurements.csv", "--term", "term.toml", "--json", "out"],
            output: "out",
        },
    ]
}

impl Reader {
    /// What the command says of a text in place of the sound one, and what it writes.
    fn read(&self, text: &str) -> (Fate, String) {
        let bench = Bench::with(&FEW.machine, FEW.readings.text());
        let scene = root().join("scenes/hidden-1");
        fs::create_dir_all(bench.at("scene/sealed")).unwrap();
        for name in ["hexapod.toml", "sealed/truth.toml"] {
            fs::copy(scene.join(name), bench.at("scene").join(name)).unwrap();
        }
        bench.write(self.name, text);
        let run = bench.run(self.words);
        if run.code != Some(0) {
            return (Fate::of_refusal(&run), String::new());
        }
        let fate = if run.said.contains("warning: ") { Fate::Told } else { Fate::Survived };
        (fate, numbers(&fs::read_to_string(bench.at(self.output)).unwrap()))
    }
}

/// What a file says: of JSON its parameters, since digests of the inputs stand beside them.
fn numbers(text: &str) -> String {
    serde_json::from_str::<Value>(text).map_or(text.to_owned(), |json| json["parameters"].to_string())
}

/// How a line is changed; the last makes no file that another author might have written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Change {
    LeftOut,
    Doubled,
    Misspelt,
}

fn changed(text: &str, k: usize, change: Change) -> String {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    match change {
        Change::LeftOut => drop(lines.remove(k)),
        Change::Doubled => lines.insert(k, lines[k].clone()),
        Change::Misspelt => {
            let mut letters: Vec<char> = lines[k].chars().collect();
            letters.swap(0, 1);
            lines[k] = letters.into_iter().collect();
        }
    }
    lines.join("\n") + "\n"
}

/// Every line of every file.
pub(super) fn lines(share: Share) -> Vec<Fate> {
    readers().iter().flat_map(|reader| of(reader, share)).collect()
}

fn of(reader: &Reader, share: Share) -> Vec<Fate> {
    let (fate, sound) = reader.read(&reader.text);
    assert_eq!(fate, Fate::Survived, "{}", reader.name);
    let all: Vec<&str> = reader.text.lines().collect();
    let filled = (0..all.len()).filter(|k| all[*k].len() > 1);
    let kinds = [Change::LeftOut, Change::Doubled, Change::Misspelt];
    // Of a line of numbers no letters can be exchanged.
    let fits = |k: usize, change| change != Change::Misspelt || all[k].starts_with(char::is_alphabetic);
    let cases: Vec<_> = filled
        .flat_map(|k| kinds.map(|change| (k, change)))
        .filter(|(k, change)| fits(*k, *change))
        .collect();
    share.each(&cases, |(k, change)| match reader.read(&changed(&reader.text, *k, *change)) {
        (Fate::Survived, same) if same == sound => Fate::Survived,
        (Fate::Survived, _) => {
            let line = format!("{}: {change:?} {}", reader.name, all[*k]);
            // Keys and readings of a list may be fewer; a name that nobody knows may not be passed over.
            Fate::Silent(line).where_sound(*change != Change::Misspelt)
        }
        (fate, _) => fate,
    })
}
