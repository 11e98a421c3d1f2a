//! Studies as a whole: what their numbers must be, whatever happens to the run.

use hexbench_report::render::plain;
use std::fs::{self, File};

use hexbench_experiments::ExperimentError;
use hexbench_experiments::calibration::Fate;
use hexbench_experiments::harness::{Sharded, Silent, compute};
use hexbench_experiments::journal::Journal;
use hexbench_experiments::recovery::tally::bounds;
use hexbench_experiments::sweep::columns::Status;
use hexbench_experiments::sweep::page::{Matching, equals, laws};
use hexbench_experiments::sweep::results::{self, CELLS, CellStatistics, Counted, TRIALS};
use hexbench_experiments::sweep::{Runner, SweepStudy};
use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::RowAccessor;

use super::support::study;

const SMALL: &str = "trials = 700\ntask = \"springs\"\nredraw = 50\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\n\
                     poses = [3]\nnoise_scale = [1, 2, 4]\n";

fn open(folder: &std::path::Path, runner: &Runner) -> Result<Journal, ExperimentError> {
    Journal::open(folder, runner.identity(), runner.shards())
}

pub(super) fn run(folder: &std::path::Path, study: SweepStudy) -> (Runner, Vec<CellStatistics>) {
    let runner = Runner::new(study).unwrap();
    let journal = open(folder, &runner).unwrap();
    let state = journal.state().unwrap();
    compute(&journal, &runner, &state.pending, &Silent).unwrap();
    let cells = results::write(&runner, &journal, &|| {}).unwrap();
    (runner, cells)
}

fn bytes(folder: &std::path::Path) -> [Vec<u8>; 2] {
    [TRIALS, CELLS].map(|name| fs::read(folder.join(name)).unwrap())
}

#[test]
fn intervals_cover_the_truth_in_their_share_of_the_trials() {
    let folder = tempfile::tempdir().unwrap();
    let rest = "trials = 2000\ntask = \"springs\"\nredraw = 20\n[axes]\ngeometry = [\"ring_b\", \"irregular\"]\n\
                plan = [\"random\"]\nposes = [6]\n";
    let (_, cells) = run(folder.path(), study(rest));
    for cell in &cells {
        let [share, ..] = cell.coverage();
        let [low, high] = bounds(cell.done(), 0.95, cells.len());
        assert!((low..=high).contains(&share), "cell {}: {share} not in {low} to {high}", cell.cell);
    }
}

#[test]
fn without_corrections_of_second_order_the_papers_estimator_misses_its_intervals_where_there_is_little_noise()
{
    let folder = tempfile::tempdir().unwrap();
    let rest = "trials = 500\ntask = \"springs\"\nredraw = 20\n[axes]\ngeometry = [\"ring_b\"]\nplan = [\"random\"]\n\
                poses = [6]\nestimator = [\"gls\", \"paper\"]\nnoise_scale = [0.05]\n";
    let (_, cells) = run(folder.path(), study(rest));
    let [[weighted, ..], [unweighted, ..]] = [cells[0].coverage(), cells[1].coverage()];
    let [low, high] = bounds(cells[0].done(), 0.95, 1);
    assert!((low..=high).contains(&weighted), "{weighted}");
    assert!(unweighted < low, "{unweighted}");
}

#[test]
fn the_error_is_proportional_to_the_noise_and_falls_with_the_root_of_the_readings() {
    /// 12000 errors behind each of four cells: the exponents are known to a few thousandths.
    const CLOSE: f64 = 0.02;
    let folder = tempfile::tempdir().unwrap();
    let rest = "trials = 2000\ntask = \"springs\"\nredraw = 20\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"random\"]\n\
                poses = [8]\nrepeats = [1, 4]\nnoise_scale = [0.1, 0.4]\n";
    let (runner, cells) = run(folder.path(), study(rest));
    let law = &laws(runner.study(), &cells)[0];
    let [repeats, noise] = [law.exponents[0], law.exponents[1]];
    assert!(repeats.0 == "repeats" && (repeats.1 + 0.5).abs() < CLOSE, "{repeats:?}");
    assert!(noise.0 == "noise_scale" && (noise.1 - 1.0).abs() < CLOSE, "{noise:?}");
}

#[test]
fn designed_poses_are_worth_more_than_as_many_random_ones() {
    let folder = tempfile::tempdir().unwrap();
    let rest = "trials = 400\ntask = \"springs\"\nredraw = 4\nstarts = 4\n[axes]\ngeometry = [\"ring_a\"]\n\
                plan = [\"A\", \"random\"]\nposes = [2, 3, 6]\n";
    let (runner, cells) = run(folder.path(), study(rest));
    let equal = equals(runner.study(), &cells);
    assert_eq!(equal.len(), 3);
    let page = plain(&hexbench_experiments::sweep::page::summary(runner.study(), &cells));
    assert!(page.contains("random poses as good"), "{page}");
    for e in &equal {
        let worth = match e.random_poses {
            Matching::About(n) | Matching::MoreThan(n) => n,
            Matching::FewerThan(_) => 0.0,
        };
        assert!(worth > e.poses || e.poses >= 6.0, "{e:?}");
        assert!(e.error_percent < e.random_error_percent, "{e:?}");
    }
}

#[test]
fn records_that_are_missing_or_damaged_are_computed_again_and_the_bytes_are_the_same() {
    let (whole, broken) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    run(whole.path(), study(SMALL));
    run(broken.path(), study(SMALL));
    let record = |n: u32| broken.path().join(format!("journal/{n:08}.shard"));
    fs::remove_file(record(0)).unwrap();
    let torn = fs::read(record(1)).unwrap();
    fs::write(record(1), &torn[..torn.len() / 2]).unwrap();
    let remains = broken.path().join("journal/.hexbench-x.part");
    fs::write(&remains, "half").unwrap();
    fs::remove_file(broken.path().join(TRIALS)).unwrap();

    let runner = Runner::new(study(SMALL)).unwrap();
    let journal = open(broken.path(), &runner).unwrap();
    let state = journal.state().unwrap();
    assert_eq!((state.pending.as_slice(), state.damaged), ([0, 1].as_slice(), 1));
    assert!(!remains.exists());
    drop(journal);
    run(broken.path(), study(SMALL));
    assert!(bytes(whole.path()) == bytes(broken.path()));
}

#[test]
fn results_are_not_written_from_part_of_the_shards() {
    let folder = tempfile::tempdir().unwrap();
    let runner = Runner::new(study(SMALL)).unwrap();
    let journal = open(folder.path(), &runner).unwrap();
    compute(&journal, &runner, &[0, 2], &Silent).unwrap();
    let missing = results::write(&runner, &journal, &|| {}).unwrap_err();
    assert!(matches!(missing, ExperimentError::Missing { shard: 1, .. }), "{missing}");
    assert!(!folder.path().join(TRIALS).exists());
}

#[test]
fn shards_computed_elsewhere_and_put_together_give_the_same_bytes() {
    let (whole, here, there) =
        (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    run(whole.path(), study(SMALL));
    let runner = Runner::new(study(SMALL)).unwrap();
    compute(&open(here.path(), &runner).unwrap(), &runner, &[2, 0], &Silent).unwrap();
    compute(&open(there.path(), &runner).unwrap(), &runner, &[1], &Silent).unwrap();
    let record = "journal/00000001.shard";
    fs::copy(there.path().join(record), here.path().join(record)).unwrap();
    let journal = open(here.path(), &runner).unwrap();
    assert_eq!(journal.state().unwrap().pending, Vec::<u64>::new());
    results::write(&runner, &journal, &|| {}).unwrap();
    assert!(bytes(whole.path()) == bytes(here.path()));
}

#[test]
fn one_run_at_a_time_works_in_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    let runner = Runner::new(study(SMALL)).unwrap();
    let first = open(folder.path(), &runner).unwrap();
    let second = open(folder.path(), &runner).err().unwrap();
    assert!(
        matches!(second, ExperimentError::Busy { holder: Some(pid), .. } if pid == std::process::id()),
        "{second}"
    );
    drop(first);
    assert!(open(folder.path(), &runner).is_ok());
}

#[test]
fn the_table_of_trials_reads_back_with_its_metadata_and_agrees_with_the_table_of_cells() {
    let folder = tempfile::tempdir().unwrap();
    let (runner, cells) = run(folder.path(), study(SMALL));
    let reader = SerializedFileReader::new(File::open(folder.path().join(TRIALS)).unwrap()).unwrap();
    let metadata = reader.metadata().file_metadata();
    let value = |key: &str| {
        let pairs = metadata.key_value_metadata().unwrap();
        pairs.iter().find(|p| p.key == key).and_then(|p| p.value.clone()).unwrap()
    };
    assert_eq!(value("study_sha256"), runner.study().hash());
    assert_eq!((value("format").as_str(), value("seed").as_str()), ("study-trials/1", "1"));
    let fields: serde_json::Value = serde_json::from_str(&value("fields")).unwrap();
    let names: Vec<String> =
        metadata.schema().get_fields().iter().map(|field| field.name().to_owned()).collect();
    assert!(names.iter().all(|name| fields.get(name).is_some()), "{names:?}");
    let at = |name: &str| names.iter().position(|n| n == name).unwrap();
    let (mut squares, mut count) = (0.0, 0_u32);
    for row in reader.get_row_iter(None).unwrap() {
        let row = row.unwrap();
        assert_eq!(row.get_string(at("status")).unwrap(), Status::NAMES[0]);
        if row.get_long(at("cell")).unwrap() == 1 {
            assert!((row.get_double(at("noise_scale")).unwrap() - 2.0).abs() < 1e-15);
            for leg in 1..=6 {
                let error = row.get_double(at(&format!("leg_{leg}_stiffness_error_percent"))).unwrap();
                squares += error * error;
                count += 1;
            }
        }
    }
    assert_eq!(count, 6 * 700);
    let rms = (squares / f64::from(count)).sqrt();
    assert!((rms / cells[1].springs.errors.rms() - 1.0).abs() < 1e-12, "{rms}");
}

#[test]
fn trials_without_an_answer_are_counted_and_have_no_results() {
    let folder = tempfile::tempdir().unwrap();
    // Legs never pull under the weight of the paper: no play can show.
    let rest = "trials = 40\ntask = \"springs\"\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"paper\"]\n\
                effect = [\"leg-asymmetry\"]\nsize_sigmas = [0, 20]\n";
    let (runner, cells) = run(folder.path(), study(rest));
    assert_eq!(cells[0].done(), 40);
    assert_eq!(cells[1].by_status[Status::NotVisible as usize], 40);
    let page = plain(&hexbench_experiments::sweep::page::summary(runner.study(), &cells));
    assert!(page.contains("effect not visible: 40"), "{page}");
    let table = fs::read_to_string(folder.path().join(CELLS)).unwrap();
    assert!(table.lines().nth(2).unwrap().ends_with(",40,0,0,40,,,,,,,,,"), "{table}");
}

#[test]
fn a_diagnosis_is_judged_and_finds_what_is_plain_to_see() {
    let folder = tempfile::tempdir().unwrap();
    let rest = "trials = 8\ntask = \"diagnose\"\nredraw = 2\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"rich\"]\n\
                effect = [\"thermal-expansion\"]\nsize_sigmas = [0, 40]\n";
    let (_, cells) = run(folder.path(), study(rest));
    for cell in &cells {
        assert_eq!(cell.done(), 8);
        let right = cell.answers.share(Counted::Of(Fate::Right));
        assert!(right.hits() >= 7, "cell {}: {:?}", cell.cell, cell.answers);
    }
    let [before, after] = cells[1].answers.holdout.map(|w| w.mean());
    assert!(before > 2.0 && after < 1.5, "{before} {after}");
}

/// Rows of the table of trials as words.
pub(super) fn column(folder: &std::path::Path, name: &str) -> Vec<String> {
    let reader = SerializedFileReader::new(File::open(folder.join(TRIALS)).unwrap()).unwrap();
    let value = |row: parquet::record::Row| {
        row.get_column_iter().find(|(own, _)| *own == name).map(|(_, field)| field.to_string()).unwrap()
    };
    reader.get_row_iter(None).unwrap().map(|row| value(row.unwrap())).collect()
}

#[test]
fn a_faint_effect_is_missed_not_wrong_and_a_plain_one_is_found_with_its_size() {
    let folder = tempfile::tempdir().unwrap();
    let rest = "trials = 8\ntask = \"diagnose\"\nredraw = 2\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"rich\"]\n\
                effect = [\"base-compliance\"]\nsize_nm_per_N = [0.001, 40]\nnoise_um_urad = [[0.5, 3]]\n";
    let (runner, cells) = run(folder.path(), study(rest));
    let count = |cell: usize, of| cells[cell].answers.share(of).hits();
    assert!(
        count(0, Counted::Of(Fate::Missed)) >= 7 && count(0, Counted::Seen) == 0,
        "{:?}",
        cells[0].answers
    );
    assert!(
        count(1, Counted::Seen) == 8 && count(1, Counted::Of(Fate::Right)) >= 5,
        "{:?}",
        cells[1].answers
    );
    let page = plain(&hexbench_experiments::sweep::page::summary(runner.study(), &cells));
    for told in ["What is said of what is hidden", "missed, %", "size of the effect (nm/N)"] {
        assert!(page.contains(told), "{told}: {page}");
    }
    assert!(!page.contains("wrong"), "{page}");
    let number = |text: &String| text.parse::<f64>().ok();
    let sizes = |name: &str| column(folder.path(), name).iter().map(number).collect::<Vec<_>>();
    let (truth, found) = (sizes("true_size_nm_per_N"), sizes("estimated_size_nm_per_N"));
    assert!(truth[8..].iter().all(|size| (size.unwrap() / 40.0 - 1.0).abs() < 1e-9), "{truth:?}");
    // Beside another effect in the model the size is shared with that one.
    let answers = column(folder.path(), "answer");
    let is_right = |said: &&String| *said == "\"base-compliance\"";
    let right = answers.iter().zip(&found).filter(|(said, _)| is_right(said)).filter_map(|(_, size)| *size);
    let right: Vec<f64> = right.collect();
    assert!(right.len() >= 5 && right.iter().all(|size| (size / 40.0 - 1.0).abs() < 0.1), "{found:?}");
    let named = answers.iter().filter(is_right).count();
    assert_eq!(named as u64, count(1, Counted::Of(Fate::Right)));
}

#[test]
fn a_laboratory_with_a_fault_measures_the_same_campaigns_and_a_careful_one_changes_nothing() {
    let rest = "trials = 4\ntask = \"diagnose\"\n[axes]\ngeometry = [\"ring_a\"]\nplan = [\"few-poses\"]\n\
                effect = [\"base-compliance\"]\nsize_sigmas = [20]\n";
    let outcome = |more: &str| {
        let folder = tempfile::tempdir().unwrap();
        let (_, cells) = run(folder.path(), study(&format!("{rest}{more}")));
        (cells, column(folder.path(), "laboratory"), column(folder.path(), "holdout_chi2_springs"))
    };
    let faults =
        "laboratory = [\"none\", \"joints-0.5mm\", \"noise-2x\", \"shared-reference\", \"unit-slip\"]\n";
    let (plain, _, chi2) = outcome("");
    let (cells, laboratory, chi2_of) = outcome(faults);
    assert_eq!((laboratory[0].as_str(), laboratory[16].as_str()), ("\"none\"", "\"unit-slip\""));
    assert_eq!(plain[0].answers, cells[0].answers);
    assert_eq!(chi2, chi2_of[..4]);
    for cell in 1..4 {
        assert_ne!(chi2, chi2_of[4 * cell..4 * cell + 4], "{}", laboratory[4 * cell]);
    }
    // A slip is in one entry to learn from, and is told as such or left out: the campaign is not lost.
    assert_eq!(cells[4].done(), 4);
}
