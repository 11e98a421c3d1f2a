//! Programs that hang, fork, crash, eat memory or write without end: each becomes a record, none a hang.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use hexbench_experiments::ExperimentError;
use hexbench_experiments::challenge::ChallengeError;
use hexbench_experiments::challenge::run::{End, Entrant, Manner, Program, RunLimits, run};
use hexbench_experiments::harness::{Progress, Silent};

use crate::interrupted::StopAfter;

use super::support::{Bench, EVERY_SORT, MANNER, ONE, entrant, files};

const USUAL: RunLimits = RunLimits { time_s: 20.0, memory_mb: 500, output_mb: 20 };
const SHORT: RunLimits = RunLimits { time_s: 0.4, ..USUAL };
/// An answer that passes the run; whether it can be read is seen when it is scored.
const WRITE: &str = "echo row > \"$2/predictions.csv\"";
/// Processes are started, watched and ended within this, on a busy machine too; left alone, they would sleep for longer.
const SOON: Duration = Duration::from_mins(1);

/// Command lines of all living processes that hold a word.
#[cfg(target_os = "linux")]
fn living(word: &str) -> usize {
    let processes = fs::read_dir("/proc").unwrap().flatten();
    let lines = processes.filter_map(|p| fs::read(p.path().join("cmdline")).ok());
    lines.filter(|line| String::from_utf8_lossy(line).contains(word)).count()
}

#[test]
fn a_program_finds_a_copy_of_the_public_files_and_no_way_to_the_truth() {
    let bench = Bench::of(ONE);
    let look = format!("echo $# \"$@\"; pwd; env; find \"$(dirname \"$1\")\" | sort; {WRITE}");
    let record = bench.record(&look, USUAL);
    assert_eq!((record.failure, record.code), (None, Some(0)));
    let seen = bench.kept("stdout.txt");
    let place = bench.folder.path().to_str().unwrap();
    assert!(!seen.contains(place) && !seen.contains("sealed") && !seen.contains("truth"), "{seen}");
    for expected in
        ["2 /", "/case/hexapod.toml", "/case/measurements.csv", "/case/predict.csv", "/out\n", "/work\n"]
    {
        assert!(seen.contains(expected), "{expected}: {seen}");
    }
    assert!(!seen.contains("CARGO"), "the surroundings are not handed on: {seen}");
    assert_eq!(bench.kept("predictions.csv"), "row\n");
}

#[test]
fn a_program_that_hangs_and_ignores_signals_is_ended_at_the_time_limit() {
    let begun = Instant::now();
    for script in ["trap '' TERM INT HUP; while :; do sleep 0.01; done", "trap '' TERM; sleep 1000 & wait"] {
        let record = Bench::of(ONE).record(script, SHORT);
        assert_eq!((record.end, record.failure.as_deref()), (End::TimeLimit, Some("time limit")));
        assert!(record.wall_s >= SHORT.time_s, "{}", record.wall_s);
    }
    assert!(begun.elapsed() < SOON, "{:?}", begun.elapsed());
}

#[cfg(target_os = "linux")]
#[test]
fn nothing_that_a_program_started_outlives_it() {
    const WORD: &str = "98761.25";
    let begun = Instant::now();
    let in_its_group = format!("sleep {WORD} & (sleep {WORD} &); {WRITE}");
    let in_a_session_of_its_own =
        format!("setsid sleep {WORD} & (setsid sh -c 'sleep {WORD} & sleep {WORD}' &); sleep 0.1; {WRITE}");
    let without_surroundings = format!("env -i setsid sleep {WORD} & sleep 0.1; {WRITE}");
    for script in [in_its_group, in_a_session_of_its_own, without_surroundings] {
        let record = Bench::of(ONE).record(&script, USUAL);
        assert_eq!(record.failure, None, "{script}");
        assert_eq!(living(WORD), 0, "{script}");
    }
    assert!(begun.elapsed() < SOON, "{:?}", begun.elapsed());
}

#[cfg(target_os = "linux")]
#[test]
fn processes_without_end_are_all_ended() {
    const WORD: &str = "98763.25";
    let script = format!("while :; do sleep {WORD} & sleep 0.002; done");
    let record = Bench::of(ONE).record(&script, SHORT);
    assert_eq!(record.end, End::TimeLimit);
    assert_eq!(living(WORD), 0);
}

#[cfg(target_os = "linux")]
#[test]
fn the_memory_limit_holds_for_one_process_and_for_all_together() {
    let limits = RunLimits { memory_mb: 120, ..USUAL };
    let alone = "awk 'BEGIN { s = \"x\"; while (1) s = s s }' || exit 9";
    let record = Bench::of(ONE).record(alone, limits);
    assert_eq!((record.end, record.code), (End::Exited, Some(9)), "{record:?}");
    let holding = "awk 'BEGIN { s = \"x\"; while (length(s) < 2^25) s = s s; system(\"sleep 30\") }' & ";
    let record = Bench::of(ONE).record(&format!("{}wait", holding.repeat(5)), limits);
    assert_eq!(record.failure.as_deref(), Some("memory limit"), "{record:?}");
    assert!(record.peak_memory_mb.unwrap() > 120.0, "{record:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn the_peak_of_memory_is_told() {
    let hold = format!(
        "awk 'BEGIN {{ s = \"x\"; while (length(s) < 2^25) s = s s; system(\"sleep 0.1\") }}'; {WRITE}"
    );
    let large = Bench::of(ONE).record(&hold, USUAL).peak_memory_mb.unwrap();
    let small = Bench::of(ONE).record(&format!("sleep 0.1; {WRITE}"), USUAL).peak_memory_mb.unwrap();
    assert!((33.0..200.0).contains(&large) && small < 20.0, "{small} MB, {large} MB");
}

#[test]
fn a_crash_an_exit_code_and_a_missing_answer_are_told() {
    for (script, end, code, why) in [
        ("kill -SEGV $$", End::Killed, Some(11), "ended by signal 11"),
        ("exit 3", End::Exited, Some(3), "exit code 3"),
        ("exit 0", End::Exited, Some(0), "it wrote no predictions.csv"),
        ("mkdir \"$2/predictions.csv\"", End::Exited, Some(0), "predictions.csv is not an ordinary file"),
        (
            "ln -s /etc/hostname \"$2/predictions.csv\"",
            End::Exited,
            Some(0),
            "predictions.csv is not an ordinary file",
        ),
    ] {
        let record = Bench::of(ONE).record(script, USUAL);
        assert_eq!((record.end, record.code, record.failure.as_deref()), (end, code, Some(why)), "{script}");
    }
}

#[test]
fn output_without_end_is_stopped() {
    let limits = RunLimits { output_mb: 2, ..USUAL };
    for script in [
        "yes",
        "yes > \"$2/predictions.csv\"",
        "i=0; while :; do i=$((i + 1)); head -c 100000 /dev/zero > \"$2/$i\"; done",
        "cd \"$HOME\"; i=0; while :; do i=$((i + 1)); head -c 100000 /dev/zero > $i; done",
    ] {
        let record = Bench::of(ONE).record(script, limits);
        assert_eq!(record.failure.as_deref(), Some("output limit"), "{script}: {record:?}");
    }
}

#[test]
fn of_what_is_printed_the_beginning_is_kept() {
    let bench = Bench::of(ONE);
    bench.record(&format!("yes | head -c 100000; echo oh >&2; {WRITE}"), USUAL);
    let printed = bench.kept("stdout.txt");
    assert!(printed.ends_with("\n[cut here: 100000 bytes were printed]\n") && printed.len() < 20_000);
    assert_eq!(bench.kept("stderr.txt"), "oh\n");
}

#[test]
fn a_run_goes_on_where_it_was_and_begins_anew_when_asked() {
    let bench = Bench::of(EVERY_SORT);
    let log = bench.folder.path().join("log");
    fs::write(&log, "").unwrap();
    // A file among the arguments would be a part of the program.
    let script = format!("echo called >> \"$0/log\"; {WRITE}");
    let calls = || fs::read_to_string(&log).unwrap().lines().count();
    assert_eq!(bench.run_with(&script, bench.folder.path(), USUAL).len(), 5);
    assert_eq!((bench.run_with(&script, bench.folder.path(), USUAL).len(), calls()), (0, 5));
    fs::remove_dir_all(bench.answers().join("cases/case-003")).unwrap();
    fs::write(bench.answers().join("cases/case-004/run.json"), "{").unwrap();
    fs::create_dir(bench.answers().join("cases/.part-killed")).unwrap();
    let fresh: Vec<String> =
        bench.run_with(&script, bench.folder.path(), USUAL).into_iter().map(|r| r.case).collect();
    assert_eq!((fresh, calls()), (vec!["case-003".to_owned(), "case-004".to_owned()], 7));
    assert!(!bench.answers().join("cases/.part-killed").exists());
    let again = Manner { again: true, ..MANNER };
    let summary = run(
        &bench.challenge,
        &entrant(&script, bench.folder.path(), USUAL),
        &bench.answers(),
        again,
        &|_| true,
        &Silent,
    )
    .unwrap();
    assert_eq!((summary.fresh.len(), calls()), (5, 12));
}

#[test]
fn a_run_that_is_stopped_goes_on_with_the_cases_that_are_left() {
    let bench = Bench::of(EVERY_SORT);
    let entrant = entrant(WRITE, Path::new("sh"), USUAL);
    let over = |progress: &dyn Progress| {
        run(&bench.challenge, &entrant, &bench.answers(), MANNER, &|_| true, progress)
    };
    let stopped = over(&StopAfter::new(2));
    assert!(matches!(stopped, Err(ChallengeError::Experiment(ExperimentError::Stopped))), "{stopped:?}");
    let rest = over(&Silent).unwrap();
    assert!(rest.earlier.len() >= 2 && rest.earlier.len() + rest.fresh.len() == 5, "{rest:?}");
}

#[test]
fn answers_of_another_program_limit_or_challenge_are_not_mixed() {
    let bench = Bench::of(ONE);
    bench.record(WRITE, USUAL);
    let zero = Path::new("sh");
    let refused = |challenge, script: &str, limits| {
        run(challenge, &entrant(script, zero, limits), &bench.answers(), MANNER, &|_| true, &Silent)
            .unwrap_err()
    };
    let program = refused(&bench.challenge, "exit 0", USUAL);
    assert!(matches!(program, ChallengeError::OtherProgram { .. }), "{program}");
    assert!(refused(&bench.challenge, WRITE, SHORT).to_string().contains("there the limits are 20 s"));
    let other = Bench::of(EVERY_SORT);
    let challenge = refused(&other.challenge, WRITE, USUAL);
    assert!(matches!(challenge, ChallengeError::OtherChallenge { .. }), "{challenge}");
}

/// A program in two files: a script, and a folder with what it imports.
fn in_two_files(bench: &Bench, word: &str) -> Entrant {
    let [script, library] = ["solve.sh", "library"].map(|name| bench.folder.path().join(name));
    fs::create_dir_all(library.join(".git")).unwrap();
    fs::write(&script, format!("echo {word}; {WRITE}")).unwrap();
    fs::write(library.join("module.sh"), "x=1").unwrap();
    let line = ["sh".to_owned(), script.display().to_string()];
    let program = Program::find(&line).unwrap().with_depends(&[library]).unwrap();
    Entrant { name: "script".to_owned(), program, limits: USUAL }
}

#[test]
fn an_edited_program_gets_no_old_answers_and_the_file_is_named() {
    let bench = Bench::of(ONE);
    let library = bench.folder.path().join("library");
    let go = |entrant: &Entrant, again: bool| {
        run(&bench.challenge, entrant, &bench.answers(), Manner { again, ..MANNER }, &|_| true, &Silent)
    };
    let first = in_two_files(&bench, "one");
    assert_eq!(go(&first, false).unwrap().fresh.len(), 1);
    assert_eq!(go(&first, false).unwrap().earlier.len(), 1);
    fs::write(library.join(".git/index"), "of no consequence").unwrap();
    assert_eq!(go(&first, false).unwrap().earlier.len(), 1);
    let edited = in_two_files(&bench, "two");
    let refused = go(&edited, false).unwrap_err().to_string();
    assert!(refused.contains("solve.sh was edited") && bench.kept("stdout.txt") == "one\n", "{refused}");
    assert_eq!(go(&edited, true).unwrap().fresh.len(), 1);
    assert_eq!(bench.kept("stdout.txt"), "two\n");
    for (change, name, told) in
        [("x=2", "module.sh", "module.sh was edited"), ("y=1", "new.sh", "new.sh did not belong")]
    {
        fs::write(library.join(name), change).unwrap();
        let refused = go(&edited, false).unwrap_err().to_string();
        assert!(refused.contains(told), "{refused}");
        go(&edited, true).unwrap();
    }
    fs::remove_file(library.join("new.sh")).unwrap();
    let refused = go(&edited, false).unwrap_err().to_string();
    assert!(refused.contains("new.sh belonged to the program"), "{refused}");
}

#[test]
fn a_program_that_is_edited_while_it_runs_has_no_answers() {
    let bench = Bench::of(ONE);
    let entrant = in_two_files(&bench, "one");
    let script = bench.folder.path().join("solve.sh");
    fs::write(&script, format!("{WRITE}; echo '# edited' >> \"$0\"")).unwrap();
    let go = || run(&bench.challenge, &entrant, &bench.answers(), MANNER, &|_| true, &Silent).unwrap_err();
    let refused = go();
    assert!(refused.to_string().contains("while the program ran"), "{refused}");
    assert!(matches!(go(), ChallengeError::OtherProgram { .. }));
}

#[test]
fn a_folder_that_holds_no_answers_is_left_alone() {
    let bench = Bench::of(ONE);
    let before = files(&bench.place());
    for again in [false, true] {
        let manner = Manner { again, ..MANNER };
        let refused = run(
            &bench.challenge,
            &entrant(WRITE, Path::new("sh"), USUAL),
            &bench.place(),
            manner,
            &|_| true,
            &Silent,
        );
        assert!(matches!(refused, Err(ChallengeError::NotEmpty(_))), "{refused:?}");
    }
    assert!(files(&bench.place()) == before);
}

#[test]
fn a_changed_case_is_not_answered() {
    let bench = Bench::of(ONE);
    fs::write(bench.place().join("cases/case-001/predict.csv"), "row\n").unwrap();
    let refused = run(
        &bench.challenge,
        &entrant(WRITE, Path::new("sh"), USUAL),
        &bench.answers(),
        MANNER,
        &|_| true,
        &Silent,
    );
    assert!(matches!(refused, Err(ChallengeError::Tampered { .. })), "{refused:?}");
}

#[test]
fn a_program_that_is_not_there_is_told_before_anything_runs() {
    let error = Program::find(&["no-such-program".to_owned()]).unwrap_err();
    assert_eq!(error.to_string(), "there is no program \"no-such-program\"");
}
