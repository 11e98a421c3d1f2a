//! Whether the file means what it says: other readings of it against every effect of the catalogue.

use hexbench_core::interrupt::go_on;
use hexbench_core::parallel;
use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};

use super::READINGS_OF_PART;
use super::judged::{Judged, prepare, without_rows};
use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::campaign::{Campaign, ConditionReadings};
use crate::estimation::fit::{Fit, fit_baseline};
use crate::estimation::tolerances::within_tolerances;
use crate::inference::diagnosis::{RankedSets, explain, springs_alone};
use crate::inference::examination::{Finding, gross_readings};
use crate::inference::misread::{
    AgainstWritten, AsMeant, AsWritten, Change, Readable, Readings, Way, as_deflections, finding,
    idle_columns, misplaced, misplaced_findings, other_readings, unwritten,
};

/// Ways to read a file that are weighed against the effects.
const WAYS_EXPLAINED: usize = 3;
/// Ways of reading reported at most.
const MOST_REPORTED: usize = 6;
/// Twice the log-likelihood by which another reading of the file, with its effects, has to be better than the file as written.
const GAIN: f64 = 40.0;
/// The same for a reading with a size, whose numbers are charged for already, and springs alone.
const SIZE_GAIN: f64 = 25.0;
/// Share of the error as written that another reading with a size may leave.
const BETTER_SHARE: f64 = 0.7;
/// The same for one without a size that leaves more than the noise: what no effect explains may be smaller in many other readings.
const FAR_BETTER_SHARE: f64 = 0.3;
/// Twice the logarithm of how many effects there are to choose from.
const EFFECT: f64 = 6.0;
/// Error over the noise that springs alone leave of a sound file at most.
const SOUND_LEVEL: f64 = 1.15;
/// Error over the noise of springs alone beyond which a mistake without a size, that explains all of it, needs no rivals.
const EVIDENT_LEVEL: f64 = 10.0;
/// Error over the noise of springs alone beyond which that part is enough.
const FAR_LEVEL: f64 = 3.0;
/// Readings of the part of a larger file that is enough in any case: what so many do not decide is no mistake of a whole file.
const READINGS_WEIGHED: usize = 4320;
/// Error over the noise that springs leave at most with loads as the readings tell them, beside effects that are there as well.
const UNWRITTEN_LEVEL: f64 = 3.0;
/// With so many legs of negative stiffness a file has some sign wrong, whatever else is at work.
const NEGATIVE_LEGS: usize = 4;
/// Standard deviations of chi-square by which an error may exceed the noise and still be taken for it.
const NOISE_SIGMAS: f64 = 2.0;
/// An explanation that leaves the stiffness of so many legs open says nothing of the machine.
const OPEN_LEGS: usize = 4;
/// Standard deviation of a compliance over its size, beyond which it is open.
const OPEN_SHARE: f64 = 0.5;
/// What a pattern is charged for more than a zero error that it repeats, in twice the log-likelihood.
const PATTERN: f64 = 8.0;
/// So many effects may look like one column of readings or loads that is off.
const MOST_LIKE_A_COLUMN: usize = 1;
/// A compliance this many standard deviations below zero is no spring.
const NEGATIVE_SIGMAS: f64 = 3.0;

/// The best explanation of a file read in one way.
struct Explained {
    /// Twice the negative log-likelihood, to a constant of the file.
    cost: f64,
    /// What patterns without a name would take off it.
    patterns: f64,
    /// The same of springs alone.
    springs_cost: f64,
    /// Error over the noise.
    level: f64,
    /// True when the error is what the noise alone leaves as often as not, or nearly.
    is_noise: bool,
    /// Effects it takes.
    effects: usize,
    /// Legs that would have a negative stiffness.
    negative: usize,
    /// True when all of them would by springs alone: the platform moves against its loads, and no effect makes a machine do so.
    all_springs_negative: bool,
    /// Legs whose stiffness it leaves open.
    open: usize,
}

/// A file before any effect is weighed.
pub(super) enum FirstLook {
    /// It does not seem to mean what it says: springs alone, and what it seems to mean instead.
    Misread(Box<Judged>),
    /// It seems to mean what it says; with its explanation, where that had to be known.
    Sound(Option<Box<(Campaign, RankedSets)>>),
}

/// Looks whether a file means what it says. `gross`: its [`gross_readings`], which say nothing of the others.
///
/// # Errors
/// As [`prepare`]; [`ModelError::Misread`] where nothing can be fitted as the file is written.
pub(super) fn first_look(
    hexapod: &Hexapod,
    data: &Dataset,
    terms: &[Arc<dyn Term>],
    gross: &[Finding],
) -> Result<FirstLook, ModelError> {
    let (findings, written) = looked_at(hexapod, data, terms, gross);
    let Some(findings) = findings else { return Ok(FirstLook::Sound(written.map(Box::new))) };
    let as_written = prepare(hexapod, data).and_then(|campaign| {
        let outcome = springs_alone(&campaign)?;
        Ok((campaign, outcome))
    });
    let (campaign, outcome) = as_written.map_err(|cause| match findings.first() {
        Some(f) => {
            let texts: Vec<&str> = findings.iter().map(|one| one.text.as_str()).collect();
            let (meaning, next) = (texts.join("; "), f.next.clone());
            ModelError::Misread { kind: f.kind, cause: Box::new(cause), meaning, next }
        }
        None => cause,
    })?;
    Ok(FirstLook::Misread(Box::new(Judged::of(data.clone(), campaign, outcome, findings))))
}

/// What a file seems to mean instead of what it says, and its gross readings; empty when it seems to mean what it says.
pub fn misread_findings(hexapod: &Hexapod, data: &Dataset, terms: &[Arc<dyn Term>]) -> Vec<Finding> {
    let gross = gross_readings(hexapod, data);
    looked_at(hexapod, data, terms, &gross).0.into_iter().flatten().chain(gross).collect()
}

/// What a file without its gross readings seems to mean, and the file as written explained by effects, once that was done.
fn looked_at(hexapod: &Hexapod, data: &Dataset, terms: &[Arc<dyn Term>], gross: &[Finding]) -> Looked {
    let idle = idle_columns(hexapod, data);
    if !idle.is_empty() {
        return (Some(idle), None);
    }
    if !gross.is_empty() {
        return (meant(hexapod, &without_rows(data, gross), terms).0, None);
    }
    meant(hexapod, data, terms)
}

/// What a file whose columns all tell something seems to mean, and likewise.
fn meant(hexapod: &Hexapod, data: &Dataset, terms: &[Arc<dyn Term>]) -> Looked {
    if !data.is_absolute() {
        let file = File { hexapod, data, readable: Readable::Everything };
        return match file.evident_in_part(terms) {
            Some(findings) => (Some(findings), None),
            None => file.weighed(terms),
        };
    }
    if let Some(found) = misplaced(hexapod, data) {
        return (Some(misplaced_findings(&found)), None);
    }
    let Some(deflections) = as_deflections(hexapod, data) else { return (None, None) };
    let file = File { hexapod, data: &deflections, readable: Readable::LoadsAndLegs };
    // Effects that explain differences say nothing yet of the poses.
    (file.evident_in_part(terms).or_else(|| file.weighed(terms).0), None)
}

type Looked = (Option<Vec<Finding>>, Option<(Campaign, RankedSets)>);

/// Machine and deflections.
#[derive(Clone, Copy)]
struct File<'a> {
    hexapod: &'a Hexapod,
    data: &'a Dataset,
    readable: Readable,
}

impl File<'_> {
    /// What the file seems to mean, and the file as written explained by effects, once that was done.
    fn weighed(self, terms: &[Arc<dyn Term>]) -> Looked {
        if let Some(part) = self.data.some_poses(READINGS_WEIGHED) {
            return (self.weighed_by(&part, 0.0, terms), None);
        }
        let Some(readings) = other_readings(self.hexapod, self.data, self.readable) else {
            return (None, None);
        };
        let (hexapod, data) = (self.hexapod, self.data);
        let mut weighing = Weighing { hexapod, data, terms, readings: &readings, written: None };
        (weighing.findings(), weighing.written)
    }

    /// What some poses of a large file say, where springs alone leave several times the noise of them: to weigh every effect against
    /// every mistake, a few hundred readings are as good as all.
    fn evident_in_part(self, terms: &[Arc<dyn Term>]) -> Option<Vec<Finding>> {
        self.weighed_by(&self.data.some_poses(READINGS_OF_PART)?, FAR_LEVEL, terms)
    }

    /// What some poses say, where springs alone leave more than so many times the noise of them.
    fn weighed_by(self, part: &Dataset, level: f64, terms: &[Arc<dyn Term>]) -> Option<Vec<Finding>> {
        let readings =
            other_readings(self.hexapod, part, self.readable)?.to_the_line(self.hexapod, self.data);
        let is_far = readings.is_negative || readings.level.is_none_or(|left| left > level);
        let hexapod = self.hexapod;
        let weighing = || Weighing { hexapod, data: part, terms, readings: &readings, written: None };
        is_far.then(|| weighing().findings()).flatten()
    }
}

/// Other readings of a file against the file as written, each with the effects that explain it best.
struct Weighing<'a> {
    hexapod: &'a Hexapod,
    data: &'a Dataset,
    terms: &'a [Arc<dyn Term>],
    readings: &'a Readings,
    /// The file as written, explained, once that is done.
    written: Option<(Campaign, RankedSets)>,
}

impl Weighing<'_> {
    fn findings(&mut self) -> Option<Vec<Finding>> {
        self.read_otherwise().or_else(|| self.unwritten())
    }

    /// Loads that explain what neither effects nor other readings of the file do, where no row states any of their component.
    fn unwritten(&mut self) -> Option<Vec<Finding>> {
        let springs = self.readings.level.unwrap_or(f64::INFINITY);
        let written = if springs > FAR_LEVEL { self.as_written() } else { return None };
        let least = match written {
            Some(written) if written.is_noise => return None,
            Some(written) => springs.min(written.level),
            None => springs,
        };
        let found = unwritten(self.hexapod, self.data)?;
        (found.level < UNWRITTEN_LEVEL.min(FAR_BETTER_SHARE * least)).then(|| vec![found.finding])
    }

    /// The file as written, explained by effects.
    fn as_written(&mut self) -> Option<Explained> {
        if self.written.is_none() {
            self.written = self.explain(None);
        }
        self.written.as_ref().map(|(campaign, outcome)| Explained::of(campaign, outcome, None))
    }

    /// What is meant instead, where another reading of the file explains it better than effects do.
    fn read_otherwise(&mut self) -> Option<Vec<Finding>> {
        let best = self.readings.ways.first()?;
        let springs = match (self.readings.level, self.readings.is_negative) {
            (None, _) => AsWritten::Nothing,
            (_, true) => AsWritten::Negative,
            (Some(level), false) => AsWritten::Level(level),
        };
        let is_evident = !matches!(springs, AsWritten::Level(level) if level < EVIDENT_LEVEL);
        let has_size = best.has_size() && matches!(springs, AsWritten::Level(_));
        // An effect, large enough, turns the sign of a leg as well.
        let may_be_an_effect = matches!(springs, AsWritten::Negative) && !best.is_a_sign();
        if is_evident && best.level < SOUND_LEVEL && !has_size && !may_be_an_effect {
            return Some(self.of(best, AgainstWritten { written: springs, other: best.level }));
        }
        if let Some(findings) = self.reversed() {
            return Some(findings);
        }
        let written = self.as_written();
        if written.as_ref().is_some_and(|w| self.needs_no_other_reading(w)) {
            return None;
        }
        if written.as_ref().is_some_and(|w| !self.candidates().iter().any(|way| self.may_be_better(way, w))) {
            return None;
        }
        let (way, other) = self.best_machine()?;
        let as_written = match &written {
            None => AsWritten::Nothing,
            Some(w) if !self.is_better(way, &other, w) => return None,
            Some(w) if w.negative > 0 => AsWritten::Negative,
            Some(w) if w.open >= OPEN_LEGS => AsWritten::Open(w.level),
            Some(w) => AsWritten::Level(w.level),
        };
        Some(self.of(way, AgainstWritten { written: as_written, other: other.level }))
    }

    /// What is said of a platform that moves against its loads: no effect makes a machine do so, and none has to be weighed.
    fn reversed(&self) -> Option<Vec<Finding>> {
        if !self.readings.is_negative {
            return None;
        }
        let springs = prepare(self.hexapod, self.data).and_then(|campaign| fit_baseline(&campaign)).ok()?;
        if negative_legs(&springs) < 6 {
            return None;
        }
        let way = self.candidates().into_iter().find(|way| way.is_a_sign())?;
        let other =
            self.explained(way).filter(|o| o.negative == 0 && (o.is_noise || o.level < SOUND_LEVEL))?;
        Some(self.of(way, AgainstWritten { written: AsWritten::Negative, other: other.level }))
    }

    /// The way of reading that explains the file best with effects beside springs, none of which is negative.
    fn best_machine(&self) -> Option<(&Way, Explained)> {
        let candidates = self.candidates();
        let (best, others) = candidates.split_first()?;
        let explain = |way: &Way| {
            go_on();
            self.explained(way).filter(|explained| explained.negative == 0)
        };
        let explained = explain(best);
        // What springs leave far more of is no rival of what effects explain to the noise.
        let is_settled = explained.as_ref().is_some_and(|explained| explained.is_noise);
        let is_rival = |way: &&Way| !is_settled || best.level > FAR_BETTER_SHARE * way.level;
        let rivals: Vec<&Way> = others.iter().copied().filter(is_rival).collect();
        let machines = parallel::filter_map(&rivals, |way| Some((*way, explain(way)?)));
        let machines = explained.map(|explained| (*best, explained)).into_iter().chain(machines);
        machines.min_by(|a, b| a.1.with_choice().total_cmp(&b.1.with_choice()))
    }

    /// True when effects explain the file as written to the noise, springs included, and no other reading does better with springs alone.
    fn needs_no_other_reading(&self, written: &Explained) -> bool {
        let better = |way: &Way| springs_may_do_better(way, written);
        let is_known = written.negative == 0 && written.open < OPEN_LEGS && !written.all_springs_negative;
        is_known && written.is_noise && !self.readings.ways.iter().any(better)
    }

    /// What is reported of a way of reading and of those that explain the file alike.
    fn of(&self, way: &Way, answered: AgainstWritten) -> Vec<Finding> {
        let mut alike = self.readings.like(way);
        alike.truncate(MOST_REPORTED);
        let share = 1.0 / alike.len().max(1) as f64;
        alike.iter().map(|way| finding(way, &alike, answered, share)).collect()
    }

    /// True unless what springs leave of a reading with a size rules it out, whatever effects may do beside them.
    fn may_be_better(&self, way: &Way, written: &Explained) -> bool {
        !way.has_size() || way.level < SOUND_LEVEL || self.takes_most(way, written)
    }

    /// True for a reading that takes most of an error off which effects leave something.
    fn takes_most(&self, way: &Way, written: &Explained) -> bool {
        !written.is_noise && way.level < BETTER_SHARE * self.readings.level.unwrap_or(f64::INFINITY)
    }

    fn is_better(&self, way: &Way, other: &Explained, written: &Explained) -> bool {
        if way.is_of_a_column() && is_explained(written) {
            return false;
        }
        // A size soaks up a little of anything, so it has to be better than what has no name as well.
        let patterns = if way.has_size() { written.patterns } else { 0.0 };
        // Some pattern is a zero error too: one that has come to its end before the first reading.
        let same = if way.is_a_zero_error() { patterns.min(GAIN + PATTERN) } else { 0.0 };
        let written_cost = written.cost - patterns + same;
        let gained = written.negative > 0 || written_cost - other.cost > gain(way, written);
        let springs = self.readings.level.unwrap_or(f64::INFINITY);
        let is_all = other.is_noise || other.level < SOUND_LEVEL;
        if way.has_size() {
            // It has to explain everything, and most of it without effects.
            let beside_effects = gained && is_all && self.takes_most(way, written);
            let springs_alone = way.level < SOUND_LEVEL && other.springs_cost < written_cost - SIZE_GAIN;
            return beside_effects || springs_alone;
        }
        let far = |now: f64, before: f64| now < FAR_BETTER_SHARE * before;
        let is_far_better = far(other.level, written.level) && far(way.level, springs);
        let is_reversed =
            (written.negative >= NEGATIVE_LEGS || written.all_springs_negative) && way.is_a_sign();
        is_reversed || (gained && (is_all || is_far_better))
    }

    /// The best way of reading, and the best ones that do not explain the file alike; readings of another size and noise of another
    /// size do so only as long as deflections are small.
    fn candidates(&self) -> Vec<&Way> {
        let mut chosen: Vec<&Way> = Vec::new();
        for way in &self.readings.ways {
            let is_like = |c: &&Way| self.readings.like(c).iter().any(|w| w.changes == way.changes);
            let is_known = |c: &&Way| is_like(c) && !way.changes.iter().all(Change::is_of_all_readings);
            if chosen.len() < WAYS_EXPLAINED && !chosen.iter().any(is_known) {
                chosen.push(way);
            }
        }
        chosen
    }

    fn explained(&self, way: &Way) -> Option<Explained> {
        let (campaign, outcome) = self.explain(Some(way))?;
        Some(Explained::of(&campaign, &outcome, Some(way)))
    }

    fn explain(&self, way: Option<&Way>) -> Option<(Campaign, RankedSets)> {
        let changes = way.map_or(&[][..], |way| &way.changes);
        let meant = AsMeant::of(self.hexapod, self.data, None, changes);
        let known = self.written.as_ref().map(|(campaign, _)| campaign.noise);
        let campaign = match known.filter(|noise| !noise.is_stated() && way.is_some_and(keeps_noise)) {
            // A noise that the reading itself makes larger would excuse it.
            Some(noise) => within_tolerances(Campaign::with_noise(&meant.hexapod, &meant.data, noise).ok()?),
            None => prepare(&meant.hexapod, &meant.data).ok()?,
        };
        let outcome = explain(&campaign, self.terms).ok()?;
        Some((campaign, outcome))
    }
}

impl Explained {
    /// The cost with what it takes to choose the effects: a mistake that explains everything by itself comes before others that
    /// need effects of the machine as well.
    fn with_choice(&self) -> f64 {
        self.cost + EFFECT * self.effects as f64
    }

    fn of(campaign: &Campaign, outcome: &RankedSets, way: Option<&Way>) -> Self {
        let best = &outcome.best;
        let beside = way.map_or(0.0, |way| way.beside_springs);
        let dof = best.lack_of_fit_dof.max(1.0);
        let variance = best.lack_of_fit / dof;
        Self {
            cost: lack(campaign, best) + beside,
            patterns: gain_of_patterns(campaign, outcome),
            springs_cost: lack(campaign, &outcome.baseline) + beside,
            level: variance.sqrt(),
            is_noise: variance < 1.0 + NOISE_SIGMAS * (2.0 / dof).sqrt(),
            effects: best.point.active.len(),
            negative: negative_legs(best),
            all_springs_negative: negative_legs(&outcome.baseline) == 6,
            open: open_legs(best),
        }
    }
}

/// True where readings so read have the noise that they have as written.
fn keeps_noise(way: &Way) -> bool {
    !way.changes.iter().any(Change::is_of_the_scale)
}

/// Twice the negative log-likelihood of averaged readings whose noise may be larger than stated, and what the parameters cost.
fn lack(campaign: &Campaign, fit: &Fit) -> f64 {
    let numbers = numbers(campaign);
    let parameters = fit.parameters.iter().count() as f64;
    likelihood(numbers, fit.lack_of_fit, fit) + parameters * numbers.ln()
}

/// What patterns without a name take off it, less what it takes to choose them.
fn gain_of_patterns(campaign: &Campaign, outcome: &RankedSets) -> f64 {
    let (best, drop) = (&outcome.best, outcome.drop_by_patterns());
    let chosen = (drop - outcome.gain_of_patterns()).max(0.0);
    let numbers = numbers(campaign);
    let left = (best.lack_of_fit - drop).max(0.0);
    likelihood(numbers, best.lack_of_fit, best) - likelihood(numbers, left, best) - chosen
}

/// Twice the negative log-likelihood where a fit would leave this chi-square.
fn likelihood(numbers: f64, chi2: f64, fit: &Fit) -> f64 {
    let variance = chi2 / fit.lack_of_fit_dof.max(1.0);
    let level = variance.max(1.0);
    numbers * (level.ln() + variance / level)
}

fn numbers(campaign: &Campaign) -> f64 {
    campaign.groups.iter().map(ConditionReadings::numbers).sum::<usize>() as f64
}

/// True when springs alone may explain another reading of the file better than effects explain the file as written; with a size, to the
/// noise. What springs gain is known with exact inputs so far, which is more than they gain beside tolerances.
fn springs_may_do_better(way: &Way, written: &Explained) -> bool {
    if way.is_of_a_column() && is_explained(written) {
        return false;
    }
    let springs = written.springs_cost - way.gain;
    if way.has_size() {
        way.level < SOUND_LEVEL && springs < written.cost - SIZE_GAIN
    } else {
        springs < written.cost - gain(way, written)
    }
}

/// True where one effect explains the file as written to the noise: its numbers, in plans of few loads, are those of one column that
/// is off, and no reading tells which it is.
fn is_explained(written: &Explained) -> bool {
    written.is_noise && written.effects <= MOST_LIKE_A_COLUMN
}

/// By how much another reading has to be better. Effects that explain everything and leave nothing known of the springs explain little
/// beside springs that explain as much by themselves: then the charges for the mistake and for the effects decide.
fn gain(way: &Way, written: &Explained) -> f64 {
    let is_open = written.open >= OPEN_LEGS && !way.has_size() && way.level < SOUND_LEVEL;
    if is_open { 0.0 } else { GAIN }
}

fn open_legs(fit: &Fit) -> usize {
    (0..6).filter(|&leg| fit.std(leg) > OPEN_SHARE * fit.point.compliances[leg].abs()).count()
}

fn negative_legs(fit: &Fit) -> usize {
    (0..6).filter(|&leg| fit.point.compliances[leg] < -NEGATIVE_SIGMAS * fit.std(leg)).count()
}
