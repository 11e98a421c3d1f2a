//! The page of all classes.

use std::fmt::Write as _;
use std::fs;

use super::Class;
use super::fate::Fate;
use crate::support::root;

/// Set to write the page instead of comparing it.
const BLESS: &str = "HEXBENCH_BLESS";

const HEAD: &str = "# What becomes of faults\n\n\
Written by `HEXBENCH_BLESS=1 cargo test --workspace --test cli -- --ignored faults`; do not edit.\n\n\
Every case is a run of the command on files, arguments or a place in which something is wrong. *Refused*: exit code 2 to 5 with the place and \
the next step. *Told*: an answer with a warning, a finding, or a verdict that claims nothing. *Survived*: the right answer (that of the \
sound files), the old file or the complete new one, the bytes of an undisturbed run. *Cannot be known*: another answer, since the file \
is as good as the sound one; what that is stands below. The test fails where an answer is wrong and nothing is said, and where a run panics, is ended by a \
signal, takes two minutes, or is refused without a next step; it fails too when these counts change.\n\n\
| class | what is wrong | cases | refused | told | survived | cannot be known | wrong and silent |\n\
|---|---|---|---|---|---|---|---|\n";

/// The row of a class without its counts of what could not be done here.
fn row(class: &Class, fates: &[Fate]) -> String {
    let count = |is: fn(&Fate) -> bool| fates.iter().filter(|fate| is(fate)).count();
    let counts = [
        fates.len(),
        count(|f| *f == Fate::Refused),
        count(|f| *f == Fate::Told),
        count(|f| *f == Fate::Survived),
        count(|f| *f == Fate::Undetectable),
        count(|f| matches!(f, Fate::Silent(_))),
    ];
    let counts = counts.map(|n| if n == 0 { " ".to_owned() } else { format!(" {n} ") });
    format!("| {} | {} |{}|\n", class.number, class.what, counts.join("|"))
}

fn notes(classes: &[(&Class, Vec<Fate>)]) -> String {
    let mut text = String::from("\n## What cannot be known\n\n");
    for (class, _) in classes.iter().filter(|(class, _)| !class.unknowable.is_empty()) {
        let _ = writeln!(text, "- {}: {}.", class.number, class.unknowable);
    }
    text
}

/// Compares the page with the counts, or writes it. A row of which something cannot be done here is not compared.
pub(super) fn check(classes: &[(&Class, Vec<Fate>)]) {
    let path = root().join("docs/results/faults.md");
    let rows: Vec<String> = classes.iter().map(|(class, fates)| row(class, fates)).collect();
    let skipped = |k: usize| classes[k].1.contains(&Fate::Skipped);
    if std::env::var_os(BLESS).is_some() && !(0..rows.len()).any(skipped) {
        fs::write(&path, [HEAD, &rows.concat(), &notes(classes)].concat()).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    for (k, row) in rows.iter().enumerate().filter(|(k, _)| !skipped(*k)) {
        assert!(kept.contains(row), "docs/results/faults.md is stale, class {}: {row}", classes[k].0.number);
    }
    assert!(kept.starts_with(HEAD) && kept.ends_with(&notes(classes)), "docs/results/faults.md is stale");
    assert_eq!(kept.matches("\n| ").count(), classes.len() + 1, "docs/results/faults.md has other classes");
}
