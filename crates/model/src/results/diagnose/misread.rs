//! Whether the file means what it says: other readings of it against every effect of the catalogue.

use std::sync::Arc;

use hexbench_core::{Dataset, Hexapod};
use rayon::prelude::*;

use super::judged::{Judged, prepare};
use crate::effects::term::Term;
use crate::error::ModelError;
use crate::estimation::fit::Fit;
use crate::inference::diagnosis::{explain, springs_alone};
use crate::inference::examination::Finding;
use crate::inference::misread::{Answered, AsWritten, Change, Origin, Readings, Target, Way, finding, other_readings};

/// Ways to read a file that are weighed against the effects.
const WAYS_EXPLAINED: usize = 3;
/// Ways of reading reported at most.
const MOST_REPORTED: usize = 6;
/// Twice the log-likelihood by which another reading of the file, with its effects, has to be better than the file as written.
const GAIN: f64 = 40.0;
/// Share of the error as written that another reading may leave.
const BETTER_SHARE: f64 = 0.7;
/// Error over the noise that springs alone leave of a sound file at most.
const SOUND_LEVEL: f64 = 1.15;
/// Error over the noise of springs alone beyond which a mistake without a size, that explains all of it, needs no rivals.
const EVIDENT_LEVEL: f64 = 2.0;
/// Share of the platform's radius, and the turn in rad, beyond which an offset or a tilt of the loads is no effect of the machine.
const NO_EFFECT: f64 = 0.3;
/// A compliance this many standard deviations below zero is no spring.
const NEGATIVE_SIGMAS: f64 = 3.0;

/// The best explanation of a file read in one way.
struct Explained {
    /// Twice the negative log-likelihood, to a constant of the file.
    cost: f64,
    /// Error over the noise.
    level: f64,
    /// True when every leg is a spring.
    is_machine: bool,
}

/// The file as written, with springs alone, and what it seems to mean instead; none when it seems to mean what it says.
///
/// # Errors
/// As [`prepare`], for a file that can be fitted in no way as it is written.
pub(super) fn misread(
    hexapod: &Hexapod,
    data: &Dataset,
    terms: &[Arc<dyn Term>],
) -> Result<Option<Judged>, ModelError> {
    let Some(findings) = misread_findings(hexapod, data, terms) else { return Ok(None) };
    let campaign = prepare(hexapod, data).map_err(|cause| match findings.first() {
        Some(f) => {
            ModelError::Misread { cause: Box::new(cause), meaning: f.text.clone(), next: f.next.clone() }
        }
        None => cause,
    })?;
    let outcome = springs_alone(&campaign)?;
    Ok(Some(Judged { data: data.clone(), campaign, outcome, findings }))
}

/// What a file seems to mean instead of what it says; none when it seems to mean what it says.
pub fn misread_findings(hexapod: &Hexapod, data: &Dataset, terms: &[Arc<dyn Term>]) -> Option<Vec<Finding>> {
    let readings = other_readings(hexapod, data)?;
    Weighing { hexapod, data, terms, readings: &readings }.findings()
}

/// Other readings of a file against the file as written, each with the effects that explain it best.
struct Weighing<'a> {
    hexapod: &'a Hexapod,
    data: &'a Dataset,
    terms: &'a [Arc<dyn Term>],
    readings: &'a Readings,
}

impl Weighing<'_> {
    fn findings(&self) -> Option<Vec<Finding>> {
        let best = self.readings.ways.first()?;
        let springs = match (self.readings.level, self.readings.is_negative) {
            (None, _) => AsWritten::Nothing,
            (_, true) => AsWritten::Negative,
            (Some(level), false) => AsWritten::Level(level),
        };
        let is_evident = !matches!(springs, AsWritten::Level(level) if level < EVIDENT_LEVEL);
        if is_evident && best.level < SOUND_LEVEL && !is_like_an_effect(best) {
            return Some(self.of(best, Answered { written: springs, other: best.level }));
        }
        let written = self.explained(None);
        let candidates = self.candidates();
        let all: Vec<Option<Explained>> = candidates.par_iter().map(|way| self.explained(Some(way))).collect();
        let all = candidates.iter().zip(all).filter_map(|(way, explained)| Some((*way, explained?)));
        let machines = all.filter(|(_, explained)| explained.is_machine);
        let (way, other) = machines.min_by(|a, b| a.1.cost.total_cmp(&b.1.cost))?;
        let as_written = match &written {
            None => AsWritten::Nothing,
            Some(w) if !w.is_machine => AsWritten::Negative,
            Some(w) if self.is_better(way, &other, w) => AsWritten::Level(w.level),
            Some(_) => return None,
        };
        Some(self.of(way, Answered { written: as_written, other: other.level }))
    }

    /// What is reported of a way of reading and of those that explain the file alike.
    fn of(&self, way: &Way, answered: Answered) -> Vec<Finding> {
        let mut alike = self.readings.like(way);
        alike.truncate(MOST_REPORTED);
        let share = 1.0 / alike.len().max(1) as f64;
        alike.iter().map(|way| finding(way, &alike, answered, share)).collect()
    }

    fn is_better(&self, way: &Way, other: &Explained, written: &Explained) -> bool {
        if is_like_an_effect(way) {
            return self.is_no_effect(way) && other.cost < written.cost + GAIN;
        }
        // Any way of reading soaks up a little of what no effect explains: it has to explain most of it, or everything.
        let is_most = other.level < BETTER_SHARE * written.level || other.level < SOUND_LEVEL;
        written.cost - other.cost > GAIN && is_most
    }

    /// True for sizes that no effect of a machine has.
    fn is_no_effect(&self, way: &Way) -> bool {
        let radius = self.hexapod.platform_radius();
        way.changes.iter().all(|change| match change {
            Change::Origin(_, at) => at.norm() > NO_EFFECT * radius,
            Change::Turned(_, by) => by.norm() > NO_EFFECT,
            _ => true,
        })
    }

    /// The best way of reading, and the best ones that do not explain the file alike.
    fn candidates(&self) -> Vec<&Way> {
        let mut chosen: Vec<&Way> = Vec::new();
        for way in &self.readings.ways {
            let is_known = |c: &&Way| self.readings.like(c).iter().any(|w| w.changes == way.changes);
            if chosen.len() < WAYS_EXPLAINED && !chosen.iter().any(is_known) {
                chosen.push(way);
            }
        }
        chosen
    }

    fn explained(&self, way: Option<&Way>) -> Option<Explained> {
        let (mut hexapod, mut data) = (self.hexapod.clone(), self.data.clone());
        for change in way.iter().flat_map(|way| &way.changes) {
            change.apply(&mut hexapod, &mut data);
        }
        let campaign = prepare(&hexapod, &data).ok()?;
        let outcome = explain(&campaign, self.terms).ok()?;
        let best = &outcome.best;
        let numbers = 6.0 * campaign.groups.len() as f64;
        let variance = best.lack_of_fit / best.lack_of_fit_dof.max(1.0);
        let level = variance.max(1.0);
        let lack = numbers * (level.ln() + variance / level) + best.parameters.iter().count() as f64 * numbers.ln();
        Some(Explained {
            cost: lack + way.map_or(0.0, |way| way.beside_springs),
            level: variance.sqrt(),
            is_machine: is_machine(best),
        })
    }
}

/// True when the catalogue has an effect that does the same: only the size tells a mistake from it.
fn is_like_an_effect(way: &Way) -> bool {
    way.changes.iter().all(|change| {
        matches!(
            change,
            Change::Origin(Origin::MomentsMobile | Origin::ReadingsMobile, _) | Change::Turned(Target::Wrench, _)
        )
    })
}

fn is_machine(fit: &Fit) -> bool {
    (0..6).all(|leg| fit.point.compliances[leg] > -NEGATIVE_SIGMAS * fit.std(leg))
}
