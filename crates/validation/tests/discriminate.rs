//! Proposed readings against random ones, a handful of campaigns.

use hexbench_validation::Outcome;
use hexbench_validation::discriminate::{CONFUSIONS, Protocol, Record, discriminate};

#[test]
fn try_out() {
    let trials: usize = std::env::var("T").map_or(4, |t| t.parse().unwrap());
    let study = discriminate(Protocol { trials, ..Protocol::default() }, &CONFUSIONS, &|| ());
    println!("failures {}", study.failures);
    for (c, records) in &study.pairs {
        let share = |f: fn(&Record) -> Outcome| {
            let n = |o| records.iter().filter(|r| f(r) == o).count();
            format!("{}/{}/{}", n(Outcome::Right), n(Outcome::Honest), n(Outcome::Wrong))
        };
        println!(
            "{:50} {:3} before {:9} next {:9} random {:9} asked {:9} random {:9} readings {:.1} promised {:.2}",
            c.name(),
            records.len(),
            share(|r| r.before),
            share(|r| r.proposed),
            share(|r| r.proposed_random),
            share(|r| r.asked),
            share(|r| r.asked_random),
            records.iter().map(|r| r.readings as f64).sum::<f64>() / records.len() as f64,
            records.iter().map(|r| r.promised).sum::<f64>() / records.len() as f64,
        );
    }
}
