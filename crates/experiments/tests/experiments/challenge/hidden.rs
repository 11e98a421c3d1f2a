//! A program that knows the public cases by heart, and a seed that the organiser keeps.

use std::fs;

use hexbench_experiments::challenge::run::RunLimits;
use hexbench_experiments::challenge::score::{EntrantScore, score};
use hexbench_experiments::challenge::{Challenge, ChallengeError};

use super::support::{Bench, files, suite};

const CASES: &str = "[cases.clean]\nkind = \"clean\"\ncount = 3\nplan = \"paper\"\nmachine = \"ring_a\"\n";
/// Looks a case up by the digest of its measurements; what it does not know it answers with no motion.
const BY_HEART: &str = "h=$(sha256sum < \"$1/measurements.csv\" | cut -c1-64)\n\
    if [ -f \"$0/$h\" ]; then cp \"$0/$h\" \"$2/predictions.csv\"; else awk -F, '\
    NR == 1 { print \"row,da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad\" } \
    NR > 1 { print $1 \",0,0,0,0,0,0\" }' \"$1/predict.csv\" > \"$2/predictions.csv\"; fi";

/// What is true of every case, by the digest of its measurements: anyone makes it who knows suite and seed.
fn learnt(bench: &Bench) {
    let folder = bench.folder.path().join("learnt");
    fs::create_dir(&folder).unwrap();
    for id in &bench.challenge.manifest().cases {
        let digest = &bench.challenge.manifest().files[&format!("cases/{id}/measurements.csv")];
        let text = fs::read_to_string(bench.place().join("sealed").join(id).join("true.csv")).unwrap();
        let header: Vec<&str> = text.lines().next().unwrap().split(',').collect();
        let wanted = ["da_um", "db_um", "dc_um", "dalpha_urad", "dbeta_urad", "dgamma_urad"];
        let at = wanted.map(|name| header.iter().position(|h| *h == name).unwrap());
        let row = |(number, line): (usize, &str)| {
            let cells: Vec<&str> = line.split(',').collect();
            format!("{},{}\n", number + 1, at.map(|k| cells[k]).join(","))
        };
        let rows: String = text.lines().skip(1).enumerate().map(row).collect();
        fs::write(folder.join(digest), format!("row,{}\n{rows}", wanted.join(","))).unwrap();
    }
}

/// Scores of the program with what it learnt of `public`, on `bench`.
fn scored(bench: &Bench, public: &Bench) -> EntrantScore {
    bench.run_with(BY_HEART, &public.folder.path().join("learnt"), RunLimits::default());
    score(&bench.challenge, &[bench.answers()]).unwrap().entrants.remove(0)
}

#[test]
fn who_knows_the_public_suite_by_heart_is_perfect_there_and_nowhere_else() {
    let public = Bench::of(CASES);
    learnt(&public);
    let hidden = Bench::of_suite(&suite(CASES).with_hidden_seed(&"f3".repeat(20)).unwrap());
    let [known, unknown] = [&public, &hidden].map(|bench| scored(bench, &public).all);
    assert_eq!((known.answered, unknown.answered), (3, 3));
    // Readings are written with digits enough for a millionth of the noise.
    assert!(known.error_in_noise.unwrap() < 1e-3, "{known:?}");
    // Without motion everything is in error: many times the noise.
    assert!(unknown.error_in_noise.unwrap() > 3.0, "{unknown:?}");
    assert!(unknown.predictions_crps.unwrap().mean > 1000.0 * known.predictions_crps.unwrap().mean);
}

#[test]
fn a_hidden_seed_is_in_nothing_that_is_handed_out_and_gives_the_same_cases_again() {
    let text = "5b".repeat(20);
    let of = |text: &str| suite(CASES).with_hidden_seed(text).unwrap();
    let [one, again, other] =
        [of(&text), of(&format!("{text}\n")), of(&"5c".repeat(20))].map(|s| Bench::of_suite(&s));
    assert!(files(&one.place()) == files(&again.place()));
    assert_ne!(one.challenge.cases_sha256(), other.challenge.cases_sha256());
    let manifest = fs::read_to_string(one.place().join("challenge.toml")).unwrap();
    let seed = of(&text).seed;
    assert!(!manifest.contains("seed = ") && manifest.contains("seed_sha256 = "), "{manifest}");
    let public = fs::read_dir(one.place().join("cases")).unwrap().count();
    assert_eq!(public, 3);
    for (name, bytes) in files(&one.place()).into_iter().filter(|(name, _)| !name.starts_with("sealed")) {
        let text_of_file = String::from_utf8(bytes).unwrap();
        let tells = [seed.to_string(), format!("{seed:x}"), text.clone()];
        assert!(tells.iter().all(|word| !text_of_file.contains(word)), "{} tells the seed", name.display());
    }
    // What is handed out is enough to run a program, and not to score it.
    fs::remove_dir_all(one.place().join("sealed")).unwrap();
    Challenge::open(&one.place()).unwrap().verify_public().unwrap();
    let short = suite(CASES).with_hidden_seed("42").unwrap_err();
    assert!(matches!(short, ChallengeError::ShortSeed { found: 2, .. }), "{short}");
}
