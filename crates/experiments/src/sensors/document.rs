//! The study as a page.

use hexbench_core::statistics::Proportion;
use hexbench_report::words::written_by;
use hexbench_report::{Block, Page, Section, Table};
use hexbench_truth::campaign::{SensorFault, SensorSet};

use super::{DISTANCE, SensorProtocol, SensorStudy, named};
use crate::robustness::RobustnessRecord;
use crate::shares::{counted, percent, told};

/// The page.
pub fn page(study: &SensorStudy) -> Page {
    let SensorProtocol { seed, trials } = study.protocol;
    Page::new("What is said of campaigns read with gauges, balls, levels and scales")
        .with(
            Section::lead()
                .paragraph(written_by("hexbench validate sensors --markdown FILE"))
                .paragraph(format!(
                    "{trials} campaigns are read in each of {} ways, half of them on clean machines, half with one effect of the catalogue \
                     that six pose numbers would show at distance {DISTANCE}; and as many of each of {} faults of the first sensor (seed \
                     {seed}). A reading is the exact finite displacement between the two states, plus noise: gauges 0.2 um, balls 0.6 um, \
                     levels 1.5 urad, pose numbers 0.5 um and 3 urad. Sensors stand exactly where the file says; the program takes them to \
                     be good to 0.5 mm and 0.5 degrees, as it does unless `[tolerances]` says otherwise.",
                    SensorSet::ALL.len(),
                    SensorFault::ALL.len(),
                ))
                .detail(),
        )
        .with(Section::new("In short").list(headlines(study)))
        .with(Section::new("Way by way").paragraph(WORDS).table(table(study)))
        .with(
            Section::new("Without an answer")
                .list(study.failures.iter().map(|(name, why)| format!("{name}: {why}")))
                .unless_empty(),
        )
        .with(Section::new("Again").with(Block::code(format!(
            "hexbench validate sensors --seed {seed} --trials {trials} -o DIR --markdown docs/results/sensors.md"
        ))))
}

const WORDS: &str = "Counts with exact binomial 95 % bounds. Clean right: a clean machine is called adequate, or its data are blamed. Effect \
first: the hidden effect is the first one named; open: it is among those that cannot be told apart, or too weak to name. Named falsely: an \
effect that is not there is named. Told: something is said of the data; with a fault, its name comes first.";

/// The figures everything else explains, one sentence each.
pub fn headlines(study: &SensorStudy) -> Vec<String> {
    let sound = |r: &&RobustnessRecord| SensorSet::ALL.iter().any(|set| set.word() == r.fault);
    let all = || study.records.iter().filter(sound);
    let mut lines = vec![
        format!(
            "With sound sensors clean machines are called so in {}; an effect that is not there is named in {}.",
            told(Proportion::count(all().filter(|r| r.is_clean()), |r| r.is_right())),
            told(Proportion::count(all(), |r| r.names_falsely())),
        ),
        format!(
            "Leg stiffnesses lie within 95 % intervals in {}.",
            told(covered(&all().collect::<Vec<_>>()))
        ),
    ];
    for fault in SensorFault::ALL {
        let records = study.of_group(fault.word());
        lines.push(format!("{} is called by its name in {}.", fault.word(), told(named(&records, fault))));
    }
    lines
}

fn covered(records: &[&RobustnessRecord]) -> Proportion {
    records.iter().map(|r| r.stiffness_coverage()).sum()
}

/// One line for each way of reading and each fault.
pub fn table(study: &SensorStudy) -> Table {
    let mut table = Table::named([
        "read",
        "clean right",
        "effect first",
        "effect open",
        "named falsely",
        "told",
        "stiffness in 95 %",
    ]);
    let words =
        SensorSet::ALL.map(SensorSet::word).into_iter().chain(SensorFault::ALL.map(SensorFault::word));
    for word in words {
        let records = study.of_group(word);
        let clean = || records.iter().filter(|r| r.is_clean());
        let with = || records.iter().filter(|r| !r.is_clean());
        let fault = SensorFault::ALL.into_iter().find(|f| f.word() == word);
        let is_told = |r: &&&RobustnessRecord| match fault {
            Some(fault) => r.findings.first().is_some_and(|kind| kind == fault.word()),
            None => !r.findings.is_empty(),
        };
        let is_open =
            |r: &&&RobustnessRecord| !r.is_right() && r.answer.hidden.iter().all(|id| contains(r, id));
        table.row([
            word.to_owned(),
            counted(Proportion::count(clean(), |r| r.is_right())),
            counted(Proportion::count(with(), |r| r.is_right())),
            counted(Proportion::count(with(), is_open)),
            counted(Proportion::count(records.iter(), |r| r.names_falsely())),
            counted(Proportion::count(records.iter(), is_told)),
            percent(covered(&records)),
        ]);
    }
    table
}

/// True when an effect is among the explanations that hold 95 % of the probability.
fn contains(record: &RobustnessRecord, id: &str) -> bool {
    record.answer.credible.iter().any(|e| e.is_term(id))
}
