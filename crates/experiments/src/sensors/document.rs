//! The study as a page.

use hexbench_core::statistics::Proportion;
use hexbench_report::words::written_by;
use hexbench_report::{Block, Page, Section};
use hexbench_truth::campaign::{AlikeReadings, SensorFault, SensorSet};

use super::protocol::OF_A_FAULT;
use super::{AlikeStudy, SHOWN, SensorProtocol, SensorRecord, SensorStudy, sheets};
use crate::harness::unanswered;
use crate::robustness::DISTANCE;
use crate::shares::in_words;

/// The page.
pub fn page(study: &SensorStudy, alike: &AlikeStudy) -> Page {
    Page::new("What is said of campaigns read with gauges, balls, levels and scales")
        .with(
            Section::lead()
                .paragraph(written_by("hexbench validate sensors --markdown FILE"))
                .paragraph(protocol(study, alike))
                .detail(),
        )
        .with(Section::new("In short").list(headlines(study, alike)))
        .with(Section::new("Way by way").paragraph(WAYS).table(sheets::ways(study)))
        .with(Section::new("Sensors that are wrong").paragraph(faults()).table(sheets::faults(study)))
        .with(
            Section::new("What the readings show of a place")
                .paragraph(PLACE)
                .table(sheets::shown(study, SensorFault::Place)),
        )
        .with(missed(study))
        .with(Section::new("Equal information").paragraph(SAME).table(sheets::alike(alike)))
        .with(unanswered(study.failures.iter().chain(&alike.failures)))
        .with(Section::new("Again").with(Block::code(format!(
            "hexbench validate sensors --seed {} --trials {} --alike {} -o DIR --markdown docs/results/sensors.md",
            study.protocol.seed, study.protocol.trials, alike.protocol.campaigns
        ))))
}

fn protocol(study: &SensorStudy, alike: &AlikeStudy) -> String {
    let SensorProtocol { seed, trials } = study.protocol;
    format!(
        "{trials} campaigns are read in each of {} ways, half of them on clean machines, half with one effect of the catalogue that six pose \
         numbers would show at distance {DISTANCE}; {} of each of {} faults of the first sensor; and {} campaigns in ways that tell the \
         same (seed {seed}). A reading is the exact finite displacement between the two states, plus noise: gauges 0.2 um, balls 0.6 um, \
         levels 1.5 urad, pose numbers 0.5 um and 3 urad. Sensors stand and look where the file says to 0.5 mm and 0.5 degrees and are \
         calibrated to 0.2 %, one standard deviation, which is what the program takes them for unless `[tolerances]` says otherwise; joints \
         and loads are exact.",
        SensorSet::ALL.len(),
        OF_A_FAULT * trials,
        SensorFault::ALL.len(),
        alike.protocol.campaigns,
    )
}

const WAYS: &str = "Counts with exact binomial 95 % bounds. Clean right: a clean machine is called adequate, or its data are blamed. Effect \
first: the hidden effect is the first one named; open: it is among those that cannot be told apart, or too weak to name. Named falsely: an \
effect that is not there is named. Told: something is said of the data, where nothing is wrong with them.";

fn faults() -> String {
    format!(
        "The first sensor reads with the other sign, in inches where the file says micrometers (factor 25.4), stands 10 mm beside its \
         place, or shows 5 % too much. Readings show a fault when, at its true size and without noise, it adds more than {SHOWN} to the chi-square that springs and the \
         hidden effect leave beside sensors that stand and show to their tolerance: six standard deviations. Named: the first finding calls it by its \
         name."
    )
}

/// What was said where the readings show a fault and nothing calls it by its name.
fn missed(study: &SensorStudy) -> Option<Section> {
    let line = |r: &SensorRecord| {
        let information = r.information.unwrap_or(0.0).round();
        let (hidden, answer) = (r.of.answer.hidden_words(), r.of.answer.answer());
        format!(
            "{}, {} on {} ({}): chi-square {information}; hidden {hidden}, said {answer}.",
            r.of.fault,
            r.set.word(),
            r.of.answer.family,
            r.of.answer.plan.name()
        )
    };
    let all = study.records.iter().filter(|r| r.shows_fault() && !r.is_named());
    Section::new("Shown and not named").list(all.map(line)).unless_empty()
}

const PLACE: &str = "The same beside springs and the hidden effect, by what the fault adds to the chi-square without noise. The place is off \
along x, whatever the sensor looks at: a gauge shows that only as far as the platform turns about the axis across its direction and x, and \
six springs can take up part of it. Where a fault adds as much as chance does (9, three standard deviations, and less), no program that \
seldom accuses sound sensors can name it.";

const SAME: &str = "One campaign with upright platforms is read with three balls in the plane of the mobile origin, as the pose that they boil \
down to, with its standard deviations, and with six gauges whose places and standard deviations are such that they tell the same of a motion: \
the covariance of the boiled-down pose is diagonal there, so its standard deviations are all of it. The errors of pose and gauges are those \
that follow from the errors drawn for the balls. One campaign in four has an effect. Inputs and noise are exact, and stated so. Apart: the \
largest difference of the six leg stiffnesses from those of the pose, in standard deviations, where the answer is the same. What is left is the \
noise of one reading times the turn of the legs under the load: a measured pose says where the platform turned to, beside other readings the \
model does. Then a fifth of the cells, at random, stays empty; where as many numbers of every kind are missing as on the average, intervals are \
1 / sqrt(0.8) times as wide, 11.8 % wider. Nine numbers of three balls have three to spare, so cells missing there cost less.";

/// The figures everything else explains, one sentence each.
pub fn headlines(study: &SensorStudy, alike: &AlikeStudy) -> Vec<String> {
    let sound = || study.records.iter().filter(|r| r.fault().is_none());
    let gauges = || study.records.iter().filter(|r| r.has_sound_sensors());
    let covered: Proportion = sound().map(|r| r.of.stiffness_coverage()).sum();
    let clean = |r: &&SensorRecord| r.of.is_clean();
    let mut lines = vec![
        format!(
            "With sound sensors clean machines are called so in {}; an effect that is not there is named in {}.",
            in_words(Proportion::count(sound().filter(clean), |r| r.of.is_right())),
            in_words(Proportion::count(sound(), |r| r.of.names_falsely())),
        ),
        format!(
            "Of clean machines with sound sensors a sensor is said to be wrong in {}; beside an effect in {}.",
            in_words(Proportion::count(gauges().filter(clean), |r| r.accuses_a_sensor())),
            in_words(Proportion::count(gauges().filter(|r| !clean(r)), |r| r.accuses_a_sensor())),
        ),
        format!("Leg stiffnesses lie within 95 % intervals in {}.", in_words(covered)),
    ];
    lines.extend(SensorFault::ALL.map(|fault| named(study, fault)));
    lines.extend(AlikeReadings::ALL.into_iter().enumerate().skip(1).map(|(k, way)| {
        let same = Proportion::count(alike.records.iter(), |r| r.whole[0].says_the_same(&r.whole[k]));
        format!("Read as {} the answer is that of the pose in {}.", way.words(), in_words(same))
    }));
    lines
}

fn named(study: &SensorStudy, fault: SensorFault) -> String {
    let records = study.of_group(fault.word());
    let shown = records.iter().filter(|r| r.shows_fault());
    let hidden = records.iter().filter(|r| !r.shows_fault()).count();
    format!(
        "{} is called by its name in {} where the readings show it; in {hidden} they do not.",
        fault.word(),
        in_words(Proportion::count(shown, |r| r.is_named())),
    )
}
