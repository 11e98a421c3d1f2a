//! The bundled suites stay as they are; what is wrong with a suite is said with its place.

use std::path::Path;

use super::{BUNDLED, ChallengeSuite};
use crate::challenge::ChallengeError;

/// Name, version, SHA-256 of the file, number of cases.
const FROZEN: [(&str, u64, &str, usize); 1] =
    [("springs-and-effects", 2, "e158df7523be8d32dfe1954f0378da33fe30010a20e2c7c5c45c95cb1b23edcc", 84)];

fn suite(text: &str) -> Result<ChallengeSuite, ChallengeError> {
    ChallengeSuite::from_text(text, Path::new("suite.toml"))
}

fn message(cases: &str) -> String {
    let text = format!(
        "format = \"challenge-suite/1\"\nname = \"tiny\"\nversion = 1\ntitle = \"t\"\nseed = 3\n{cases}\n"
    );
    suite(&text).unwrap_err().to_string()
}

#[test]
fn a_bundled_suite_that_changes_has_another_version() {
    for (bundled, (name, version, sha256, cases)) in BUNDLED.iter().zip(FROZEN) {
        let found = suite(bundled.text).unwrap();
        assert_eq!((bundled.name, found.name.as_str()), (name, name));
        assert!(
            found.version == version && found.sha256 == sha256,
            "data/challenges/{name}.toml is frozen. Answers that were scored under version {version} would no longer be \
             comparable: restore the file (git checkout), or make it version {} and put that and the digest {} here.",
            version + 1,
            found.sha256
        );
        assert_eq!(found.cases(), cases);
    }
}

#[test]
fn a_suite_says_where_it_is_wrong() {
    for (cases, expected) in [
        ("", "the key \"cases\" is missing"),
        ("[cases]", "a suite has a case at least"),
        ("[cases.a]\nkind = \"clean\"", "the key \"count\" is missing"),
        ("[cases.a]\nkind = \"claen\"\ncount = 1", "\"claen\": there is no kind with this name"),
        ("[cases.a]\nkind = \"clean\"\ncount = 0", "must be a whole number from 1"),
        ("[cases.a]\nkind = \"clean\"\ncount = 1\ndistance = 5", "have no distance"),
        ("[cases.a]\nkind = \"single\"\ncount = 1\ndistance = [9, 5]", "distances rise"),
        (
            "[cases.a]\nkind = \"single\"\ncount = 1\neffects = [\"crep\"]",
            "\"crep\": there is no effect with this name",
        ),
        (
            "[cases.a]\nkind = \"single\"\ncount = 1\ndistance = 5\nsize_factor = 2",
            "line 9, column 12 (distance): \"5\": there is a size_factor too",
        ),
        (
            "[cases.a]\nkind = \"single\"\ncount = 1\nsize_um = 2\nsize_nm_per_N = 2",
            "there is a size_nm_per_N too",
        ),
        (
            "[cases.a]\nkind = \"single\"\ncount = 1\nsize_nm_per_N = 2",
            "effects that are drawn have sizes in different units",
        ),
        ("[cases.a]\nkind = \"single\"\ncount = 1\nsize_factor = [4, 2]", "sizes rise and are positive"),
        (
            "[cases.a]\nkind = \"single\"\ncount = 1\neffects = [\"creep\"]\nsize_nm_per_N = 2",
            "the size of creep is in %, not in nm/N",
        ),
        ("[cases.a]\nkind = \"clean\"\ncount = 1\nsize_factor = 2", "have no size"),
        (
            "[cases.a]\nkind = \"pair\"\ncount = 1\neffects = [\"creep+bas\"]",
            "there is no effect with the name \"bas\"",
        ),
        (
            "[cases.a]\nkind = \"pair\"\ncount = 1\neffects = [[{ id = \"creep\", size_um = 2 }, \"leg-coupling\"]]",
            "the size of creep is in %, not in um",
        ),
        (
            "[cases.a]\nkind = \"single\"\ncount = 1\neffects = [{ id = \"creep\", size_percent = 9 }]\ndistance = 20",
            "creep has a size of its own",
        ),
        (
            "[cases.a]\nkind = \"single\"\ncount = 1\neffects = [{ id = \"creep\", sise_percent = 9 }]",
            "(sise_percent): unknown key",
        ),
        ("[cases.a]\nkind = \"single\"\ncount = 1\neffects = [\"out:formula\"]", "needs its formula"),
        (
            "[cases.a]\nkind = \"single\"\ncount = 1\neffects = [{ id = \"out:formula\", elongation = \"2*(f\" }]",
            "not closed",
        ),
        (
            "[cases.a]\nkind = \"clean\"\ncount = 1\nlaboratory = \"joints\"",
            "\"joints\": there is no laboratory fault with this name",
        ),
        ("[cases.a]\nkind = \"absolute\"\ncount = 1\nlaboratory = \"drift-1\"", "faults of deflections"),
        ("[cases.a]\nkind = \"clean\"\ncount = 1\nnoise_um_urad = [1]", "two standard deviations"),
        (
            "[cases.a]\nkind = \"clean\"\ncount = 1\nnoise_scale = 1\nnoise_um_urad = [1, 2]",
            "there is a noise_scale too",
        ),
        ("[cases.a]\nkind = \"single\"\ncount = 1\nplan = \"absolute\"", "belong to the kind \"absolute\""),
        (
            "[cases.a]\nkind = \"clean\"\ncount = 1\nread_by = \"gauges\"",
            "there is no set of sensors with this name",
        ),
        ("[cases.a]\nkind = \"absolute\"\ncount = 1\nread_by = \"scales\"", "absolute poses are read whole"),
        ("[cases.a]\nkind = \"single\"\ncount = 6000", "at most 5000"),
    ] {
        let found = message(cases);
        assert!(found.contains(expected) && found.contains("suite.toml"), "{cases}: {found}");
    }
}

#[test]
fn a_suite_that_is_not_there_is_told_with_those_that_are() {
    let error = ChallengeSuite::named("sprigns").unwrap_err();
    assert!(error.next_step().contains("springs-and-effects"), "{}", error.next_step());
}
