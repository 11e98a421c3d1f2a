//! Running a suite: every campaign on its own stream of random numbers.

use hexbench_truth::campaign::{Case, Kind};
use rayon::prelude::*;

use super::answered::Answered;
use super::fitted::Fitted;
use super::suite::{DISTANCES, MACHINES_SEED, Suite, seed_of};
use crate::TrialError;
use crate::recovery::noiseless::{Noiseless, recover};
use crate::recovery::scene::{Scene, Subject};

/// Parts of a run, each with a seed of its own.
const FITS: u64 = 0;
const DIAGNOSES: u64 = 1;

/// A campaign of a subject: what it gave, or nothing.
#[derive(Debug, Clone)]
pub struct OfSubject<T> {
    /// What was hidden.
    pub subject: Subject,
    /// `None` without an answer.
    pub found: Option<T>,
}

/// What one run of a suite gave.
#[derive(Debug, Clone, Default)]
pub struct Trials {
    /// Noisy campaigns fitted by the right model.
    pub fits: Vec<OfSubject<Fitted>>,
    /// Campaigns without noise.
    pub machines: Vec<OfSubject<Noiseless>>,
    /// Campaigns diagnosed.
    pub answers: Vec<Option<Answered>>,
    /// Why campaigns gave no answer.
    pub failures: Vec<String>,
}

#[derive(Debug, Clone, Copy)]
enum Job {
    Machine(Subject, usize),
    Fit(Subject, usize),
    Diagnose(Kind, usize),
}

enum Done {
    Machine(Subject, Result<Noiseless, TrialError>),
    Fit(Subject, Result<Fitted, TrialError>),
    Diagnose(Kind, Result<Box<Answered>, TrialError>),
}

/// Runs a suite; `step` is called after every campaign, from any thread. The same seed gives the same trials on any number of
/// threads.
pub fn run(suite: &Suite, seed: u64, step: &(dyn Fn() + Sync)) -> Trials {
    let one = |job: &Job| {
        let done = job.run(seed);
        step();
        done
    };
    let done: Vec<Done> = jobs(suite).par_iter().map(one).collect();
    done.into_iter().fold(Trials::default(), Trials::with)
}

fn jobs(suite: &Suite) -> Vec<Job> {
    // The longest first: no thread is left alone with one of them at the end.
    let diagnosed = suite.portions.iter().flat_map(|p| (0..p.trials).map(|i| Job::Diagnose(p.kind, i)));
    let of_each = |count: usize, job: fn(Subject, usize) -> Job| {
        suite.subjects.iter().flat_map(move |&s| (0..count).map(move |i| job(s, i)))
    };
    diagnosed.chain(of_each(suite.fits, Job::Fit)).chain(of_each(suite.machines, Job::Machine)).collect()
}

impl Job {
    fn run(self, seed: u64) -> Done {
        match self {
            Self::Machine(s, i) => Done::Machine(s, machine(&s, i)),
            Self::Fit(s, i) => Done::Fit(s, Fitted::run(&s, i, seed_of(seed, FITS))),
            Self::Diagnose(kind, i) => {
                let case = Case::draw(kind, i, seed_of(seed, DIAGNOSES), Some(DISTANCES));
                let answer = case.map_err(TrialError::from).and_then(|case| Answered::to(&case));
                Done::Diagnose(kind, answer.map(Box::new))
            }
        }
    }
}

fn machine(subject: &Subject, index: usize) -> Result<Noiseless, TrialError> {
    recover(subject, &Scene::draw(subject, index, MACHINES_SEED, None)?)
}

impl Trials {
    fn with(mut self, done: Done) -> Self {
        match done {
            Done::Machine(subject, r) => {
                let found = self.kept(r, &format!("{} without noise", subject.name));
                self.machines.push(OfSubject { subject, found });
            }
            Done::Fit(subject, r) => {
                let found = self.kept(r, subject.name);
                self.fits.push(OfSubject { subject, found });
            }
            Done::Diagnose(kind, r) => {
                let answer = self.kept(r, kind.name()).map(|boxed| *boxed);
                self.answers.push(answer);
            }
        }
        self
    }

    fn kept<T>(&mut self, result: Result<T, TrialError>, what: &str) -> Option<T> {
        result.map_err(|why| self.failures.push(format!("{what}: {why}"))).ok()
    }

    /// Campaigns fitted by the right model that gave an answer.
    pub fn fitted(&self) -> impl Iterator<Item = (&Subject, &Fitted)> {
        self.fits.iter().filter_map(|f| Some((&f.subject, f.found.as_ref()?)))
    }

    /// Campaigns diagnosed that gave an answer.
    pub fn answered(&self) -> impl Iterator<Item = &Answered> {
        self.answers.iter().flatten()
    }
}
