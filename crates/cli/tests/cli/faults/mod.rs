//! What becomes of misuse, broken files, kills and full disks: counted in runs of the command, class by class.
//!
//! A refusal has to name its place and the next step; an answer has to be the right one, or to say what is wrong. What is neither is wrong
//! and silent, and fails the test, unless the file is by itself as good as the sound one: that no program can know.

mod bench;
mod chance;
mod concurrent;
mod document;
mod fate;
mod files;
mod frames;
mod keys;
mod noise;
mod numbers;
mod places;
mod server;
mod shapes;
mod singular;
mod surroundings;
mod table;
mod units;

use bench::Share;
use fate::Fate;

/// Most cases that are shown of a class.
const FEW_CASES: usize = 5;

/// A class of faults.
struct Class {
    /// Its number; sub-classes have a letter.
    number: &'static str,
    what: &'static str,
    cases: fn(Share) -> Vec<Fate>,
    /// What of it nobody can know, and why; empty where there is nothing.
    unknowable: &'static str,
}

impl Class {
    const fn new(number: &'static str, what: &'static str, cases: fn(Share) -> Vec<Fate>) -> Self {
        Self { number, what, cases, unknowable: "" }
    }

    const fn but(self, unknowable: &'static str) -> Self {
        Self { unknowable, ..self }
    }
}

/// Every so many cases in `./test`; all of them take some minutes.
const SHARE: usize = 12;

#[test]
fn a_share_of_every_class_of_faults_is_refused_told_or_survived() {
    let share = |class| wrong(class, &(class.cases)(Share(SHARE)));
    let wrong: Vec<String> = CLASSES.iter().filter_map(share).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn places_and_permissions_are_refused_or_survived_whoever_runs_the_command() {
    for number in ["18", "18b", "18c"] {
        let class = CLASSES.iter().find(|class| class.number == number).unwrap();
        assert_eq!(wrong(class, &(class.cases)(Share(1))), None);
    }
}

#[test]
#[ignore = "some minutes"]
fn every_class_of_faults_is_refused_told_or_survived_and_the_page_says_how_often() {
    let classes: Vec<(&Class, Vec<Fate>)> =
        CLASSES.iter().map(|class| (class, (class.cases)(Share(1)))).collect();
    let wrong: Vec<String> = classes.iter().filter_map(|(class, fates)| wrong(class, fates)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    document::check(&classes);
}

/// What is wrong with a class, with its first cases; none where nothing is.
fn wrong(class: &Class, fates: &[Fate]) -> Option<String> {
    let wrong: Vec<_> = fates.iter().filter(|f| matches!(f, Fate::Broken(_) | Fate::Silent(_))).collect();
    let is_unknowable = fates.contains(&Fate::Undetectable) && class.unknowable.is_empty();
    if wrong.is_empty() && !is_unknowable {
        return None;
    }
    let first = &wrong[..wrong.len().min(FEW_CASES)];
    let (number, what) = (class.number, class.what);
    Some(format!(
        "{number} ({what}): {} of {} cases, unknowable {is_unknowable}: {first:#?}",
        wrong.len(),
        fates.len()
    ))
}

/// Every class, in order.
static CLASSES: [Class; 29] = [
    Class::new("1", "a cell that is no number: nan, inf, empty, a word; every column", numbers::no_numbers),
    Class::new("1b", "a number far beyond its column: ±1e308, 1e31, 1e12, 1e-320; every column", numbers::extremes),
    Class::new("2", "a column left out, doubled, misspelled, in capitals, moved, or one too many", shapes::columns),
    Class::new("3", "a line of hexapod.toml, scene.toml, study.toml or a term left out, doubled, or with a misspelled key", keys::lines)
        .but("a key that may be left out is left out"),
    Class::new("4", "a group of columns in another unit than its name says", units::groups)
        .but("all loads too large by one factor, where no stiffness is stated: springs of another size do the same"),
    Class::new("4b", "an optional number of hexapod.toml wrong: stiffness, stroke, mounting plane", units::optional),
    Class::new("5", "axes exchanged or reversed: of wrenches in all 47 ways, of readings and poses in every sixth", frames::turned),
    Class::new("6", "wrenches in axes of the platform, about another point, or of the other body", frames::points),
    Class::new("7", "rows copied or in another order, legs in another order", frames::orders),
    Class::new("8", "machines ever nearer to a singular pose: condition 1e2 to 1e16", singular::ladder),
    Class::new("9", "too few readings: 1 to 13 rows, 1 to 7 poses (right: stiffnesses within their uncertainties)", noise::few),
    Class::new("10", "wrong numbers among good ones: 5 to 1000 standard deviations off", noise::blunders),
    Class::new("11", "a stated noise 0.3 to 3 times the real one", noise::claims),
    Class::new("12", "files cut at any byte", files::cuts).but("a cut at the end of a line leaves a shorter file"),
    Class::new("12c", "a bit that flips", files::flips).but("a digit that becomes another digit"),
    Class::new("12e", "rows and cells left out, doubled, exchanged", files::shuffles),
    Class::new("13", "files beyond every size: a gigabyte of nothing, long lines, many columns, many blank lines", files::sizes),
    Class::new("14", "encodings, ends of lines, separators", files::encodings),
    Class::new("15", "numbers of hexapod.toml, scene.toml and a model beyond physics", numbers::in_files),
    Class::new("16", "names that act on a terminal, a page, a spreadsheet", surroundings::injections),
    Class::new("17", "commands and studies killed at any instant", concurrent::kills),
    Class::new("18", "full disk, limits, closed and broken streams, folders that are not there", places::disks),
    Class::new("18b", "outputs that are inputs, devices, pipes, links", places::outputs),
    Class::new("18c", "files and folders that may not be read or written (as a user who is not root)", places::permissions),
    Class::new("19", "several commands on one file, several studies on one folder", concurrent::rivals),
    Class::new("20", "a second simulator that gives no number", surroundings::no_number),
    Class::new("21", "requests to the workbench: hosts, tokens, bodies", server::requests),
    Class::new("22", "languages, time zones, empty environments, threads, folders with odd names", surroundings::environments),
    Class::new("22b", "options that contradict each other or the files", surroundings::options),
];
