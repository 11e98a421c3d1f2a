//! What surrounds a command: names, languages, options, another simulator.

use std::fs;

use super::bench::{Bench, CLEAN, FEW, Share, run};
use super::fate::Fate;
use crate::hostile_text::{HOSTILE, hostile_machine, is_harmless};

/// Pages and messages about files with hostile names.
pub(super) fn injections(share: Share) -> Vec<Fate> {
    let data = format!("{HOSTILE}.csv");
    let file = format!("{HOSTILE}.toml");
    let cases: [&[&str]; 12] = [
        &["check", &file, &data],
        &["compare", &file, &data],
        &["compare", &file, &data, "--markdown", "-"],
        &["compare", &file, &data, "--html", "-"],
        &["compare", &file, &data, "--json", "-"],
        &["diagnose", &file, &data, "--verbose"],
        &["diagnose", &file, &data, "--html", "-"],
        &["fit", &file, &data],
        &["power", &file, &data],
        &["fit", &file, "absent.csv"],
        &["fit", &data, &file],
        &["predict", &file, &data],
    ];
    share.each(&cases, |words| {
        let bench = Bench::empty();
        hostile_machine(bench.path());
        let run = bench.run(words);
        let shown = String::from_utf8_lossy(&run.shown);
        let is_harmless = is_harmless(&run.shown) && is_harmless(run.said.as_bytes());
        if !is_harmless || shown.contains("<script>alert") {
            return Fate::Broken(format!("{words:?}: {shown}{}", run.said));
        }
        if run.code == Some(0) { Fate::Survived } else { Fate::of_refusal(&run) }
    })
}

/// Where, in which language and by how many threads a diagnosis is made.
pub(super) fn environments(share: Share) -> Vec<Fate> {
    let words = ["diagnose", "hexapod.toml", "measurements.csv", "--json", "-"];
    let bench = Bench::with(&CLEAN.machine, CLEAN.readings.text());
    let sound = bench.run(&words);
    assert_eq!(sound.code, Some(0), "{}", sound.said);
    let variables: [&[(&str, &str)]; 14] = [
        &[("LC_ALL", "de_DE.UTF-8"), ("LANG", "de_DE.UTF-8")],
        &[("LC_ALL", "tr_TR.UTF-8")],
        &[("LC_ALL", "C")],
        &[("LC_NUMERIC", "fr_FR")],
        &[("LANG", "\u{202e}")],
        &[("TZ", "Pacific/Apia")],
        &[("TZ", "nowhere")],
        &[("HOME", "")],
        &[("TMPDIR", "/none")],
        &[("COLUMNS", "3")],
        &[("RAYON_NUM_THREADS", "2")],
        &[("RAYON_NUM_THREADS", "5")],
        &[("RAYON_NUM_THREADS", "many")],
        &[("RUST_BACKTRACE", "full"), ("NO_COLOR", "1")],
    ];
    let same = |run: &super::bench::Run| {
        Fate::survived_if(run.code == Some(0) && run.shown == sound.shown, || {
            format!("{:?} {}", run.code, run.said)
        })
    };
    let mut fates = share.each(&variables, |all| {
        let mut command = bench.command(&words);
        for (name, value) in *all {
            command.env(name, value);
        }
        same(&run(&mut command))
    });
    fates.push(same(&run(bench.command(&words).env_clear())));
    fates.extend(share.each(&["a b", "\u{e4}\u{4e2d}", "-o", "'; x", "..."], |name| {
        fs::create_dir_all(bench.at(name)).unwrap();
        for file in ["hexapod.toml", "measurements.csv"] {
            fs::copy(bench.at(file), bench.at(name).join(file)).unwrap();
        }
        same(&run(bench.command(&words).current_dir(bench.at(name))))
    }));
    fates
}

/// Options that cannot be meant.
pub(super) fn options(share: Share) -> Vec<Fate> {
    let cases: [&[&str]; 18] = [
        &[],
        &["fit"],
        &["fit", "hexapod.toml"],
        &["fit", "measurements.csv", "hexapod.toml"],
        &["fit", "hexapod.toml", "measurements.csv", "--add", "no-such-term"],
        &["fit", "hexapod.toml", "measurements.csv", "--add", "base-compliance:no-such-form"],
        &["fit", "hexapod.toml", "measurements.csv", "--coverage", "101"],
        &["fit", "hexapod.toml", "measurements.csv", "--estimator", "none"],
        &["fit", "hexapod.toml", "measurements.csv", "--estimator", "paper", "--add", "creep"],
        &["fit", "hexapod.toml", "measurements.csv", "--read-as", "nonsense"],
        &["diagnose", "hexapod.toml", "measurements.csv", "--exclude", "0"],
        &["diagnose", "hexapod.toml", "measurements.csv", "--exclude", "99999"],
        &["diagnose", "hexapod.toml", "measurements.csv", "--exclude", "1-99999"],
        &["diagnose", "hexapod.toml", "measurements.csv", "--exclude", "x"],
        &["diagnose", "hexapod.toml", "measurements.csv", "--check=nonsense"],
        &["diagnose", "hexapod.toml", "measurements.csv", "--quiet", "--verbose"],
        &["diagnose", "hexapod.toml", "measurements.csv", "--no-such-option"],
        &["compare", "hexapod.toml", "measurements.csv", "--table", "x.docx"],
    ];
    share.each(&cases, |words| {
        let bench = Bench::with(&FEW.machine, FEW.readings.text());
        let run = bench.run(words);
        // The usage of a command is its next step.
        let is_usage = run.code == Some(2)
            && (run.said.contains("Usage:")
                || run.said.contains("possible values")
                || run.said.contains("--help"));
        if is_usage { Fate::Refused } else { Fate::of_refusal(&run) }
    })
}

/// Numbers of MuJoCo that are none, as `scripts/mujoco_check.py --inject-nan` makes them: the files that hold them are refused.
pub(super) fn no_number(share: Share) -> Vec<Fate> {
    let readings = ["da_um", "dc_um", "dgamma_urad"];
    let cases: Vec<_> =
        readings.iter().flat_map(|name| ["nan", "-nan", "NaN", "1e400"].map(|text| (name, text))).collect();
    share.each(&cases, |(name, text)| {
        let column = FEW.readings.column(name);
        FEW.fit(FEW.readings.with(5, column, text).text())
    })
}
