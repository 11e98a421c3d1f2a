//! Running a program over the cases of a gate.

use std::path::{Path, PathBuf};

use tempfile::TempDir;

use super::GateError;
use super::values::GateValues;
use crate::challenge::run::{
    ANSWERS, Entrant, InsideFunction, Manner, ProgramFiles, of_part, run, run_inside, take_over,
};
use crate::challenge::score::{CaseScore, score};
use crate::challenge::{Challenge, ChallengeError};
use crate::error::ExperimentError;
use crate::harness::{ExperimentPart, Progress};

/// Runs in all of which a case must be worse to count, where runs do not differ.
pub const CONFIRMED: usize = 3;
/// Digits of the program's digest in the name of a folder.
const SHOWN: usize = 12;

/// A folder for cases and answers: one that stays, or one that goes away.
pub enum WorkFolder {
    /// It stays, and cases in it are used again.
    Kept(PathBuf),
    /// It goes away with this.
    Fresh(TempDir),
}

impl WorkFolder {
    /// The folder of a name, which is made; a temporary one without.
    ///
    /// # Errors
    /// [`ExperimentError::Write`].
    pub fn at(name: Option<&Path>) -> Result<Self, GateError> {
        let failed =
            |folder: &Path, cause| ChallengeError::from(ExperimentError::writing(folder)(cause)).into();
        if let Some(folder) = name {
            let made = std::fs::create_dir_all(folder);
            return made.map(|()| Self::Kept(folder.to_owned())).map_err(|cause| failed(folder, cause));
        }
        let made = tempfile::Builder::new().prefix("hexbench-gate-").tempdir();
        made.map(Self::Fresh).map_err(|cause| failed(&std::env::temp_dir(), cause))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        match self {
            Self::Kept(folder) => folder,
            Self::Fresh(folder) => folder.path(),
        }
    }
}

/// Where the answers of a work come from. A case is answered in one place, in all of its runs.
#[derive(Debug, Clone, Copy, Default)]
pub enum GateShare<'a> {
    /// From here.
    #[default]
    Whole,
    /// From here, of the cases of a part alone; the others have none.
    Part(ExperimentPart),
    /// From the work folders of parts; nothing is run.
    Parts(&'a [PathBuf]),
}

/// A program at work on the cases of a gate.
pub struct GateWork<'a> {
    /// The cases.
    pub challenge: &'a Challenge,
    /// The program.
    pub entrant: &'a Entrant,
    /// Folder for its answers.
    pub folder: PathBuf,
    /// Cases at once.
    pub jobs: usize,
    /// Told of every case.
    pub progress: &'a dyn Progress,
    /// What answers instead of a process, where the program is a function of this one.
    pub function: Option<InsideFunction<'a>>,
    /// Where the answers come from.
    pub share: GateShare<'a>,
}

/// What a check found.
#[derive(Debug, Clone)]
pub struct Checked {
    /// Scores of every case in the first run.
    pub cases: Vec<CaseScore>,
    /// Figures of the runs.
    pub values: GateValues,
    /// Cases that gave other figures in each run, though those of the baseline did not.
    pub scattered: Vec<String>,
}

impl<'a> GateWork<'a> {
    /// Answers go to a folder that is named after the program's digest: those before an edit stay beside those after it.
    ///
    /// # Errors
    /// [`GateError::Challenge`].
    pub fn new(
        challenge: &'a Challenge,
        entrant: &'a Entrant,
        work: &Path,
        jobs: usize,
        progress: &'a dyn Progress,
    ) -> Result<Self, GateError> {
        let digest = ProgramFiles::of(&entrant.program)?.sha256();
        let folder = work.join(format!("answers-{digest:.SHOWN$}"));
        Ok(Self { challenge, entrant, folder, jobs, progress, function: None, share: GateShare::Whole })
    }

    /// The same with answers from elsewhere, or of some cases alone.
    #[must_use]
    pub fn with_share(self, share: GateShare<'a>) -> Self {
        Self { share, ..self }
    }

    /// Number of cases that are answered here.
    pub fn own_cases(&self) -> usize {
        let is_own = self.own();
        self.challenge.manifest().cases.iter().filter(|id| is_own(id)).count()
    }

    /// True for the cases that are answered here.
    fn own(&self) -> Box<dyn Fn(&str) -> bool + '_> {
        match self.share {
            GateShare::Whole | GateShare::Parts(_) => Box::new(|_| true),
            GateShare::Part(part) => Box::new(of_part(self.challenge, part)),
        }
    }

    /// The same by a function of this process, one case after the other.
    #[must_use]
    pub fn by(self, function: Option<InsideFunction<'a>>) -> Self {
        Self { function, ..self }
    }

    /// Scores of every case in so many runs.
    ///
    /// # Errors
    /// [`GateError::Challenge`]; [`GateError::NothingAnswered`] by the first run.
    pub fn runs(&self, count: usize) -> Result<Vec<Vec<CaseScore>>, GateError> {
        let one = |number| {
            let cases = self.run(number, &|_| true)?;
            self.why_nothing_answered(&cases).map_or(Ok(cases), |why| Err(GateError::NothingAnswered(why)))
        };
        (0..count).map(one).collect()
    }

    /// Why the first of the cases that are answered here has no answer, where none of them has one.
    fn why_nothing_answered(&self, cases: &[CaseScore]) -> Option<String> {
        let is_own = self.own();
        let mut own = cases.iter().filter(|case| is_own(&case.id)).map(|case| case.failure.as_ref());
        let first = own.next()??;
        own.all(|failure| failure.is_some()).then(|| first.clone())
    }

    /// Runs once, and those cases again that differ from a baseline whose runs did not: a case counts as worse only when it is so in
    /// [`CONFIRMED`] runs.
    ///
    /// # Errors
    /// [`GateError::Challenge`].
    pub fn confirmed(&self, baseline: &GateValues) -> Result<Checked, GateError> {
        let cases = self.run(0, &|_| true)?;
        let (first, is_own) = (GateValues::of(std::slice::from_ref(&cases)), self.own());
        let differing: Vec<usize> =
            first.differing(baseline).into_iter().filter(|k| is_own(&cases[*k].id)).collect();
        let wanted = |id: &str| differing.iter().any(|k| cases[*k].id == id);
        let mut runs = vec![cases.clone()];
        if !differing.is_empty() {
            for number in 1..CONFIRMED {
                let again = self.run(number, &wanted)?;
                let kept =
                    |k: usize| if differing.contains(&k) { again[k].clone() } else { cases[k].clone() };
                runs.push((0..cases.len()).map(kept).collect());
            }
        }
        let all: Vec<GateValues> = runs.iter().map(|run| GateValues::of(std::slice::from_ref(run))).collect();
        let differs = |k: &usize| all[1..].iter().any(|other| other.differing(&all[0]).contains(k));
        let scattered = differing.iter().copied().filter(differs).map(|k| cases[k].id.clone()).collect();
        Ok(Checked { values: GateValues::best_of(&all), cases, scattered })
    }

    fn run(&self, number: usize, is_wanted: &dyn Fn(&str) -> bool) -> Result<Vec<CaseScore>, GateError> {
        let folder = self.folder.join(format!("run-{}", number + 1));
        let is_own = self.own();
        self.answer(&folder, &|id| is_wanted(id) && is_own(id))?;
        let mut scores = score(self.challenge, &[folder])?;
        Ok(scores.entrants.pop().map(|entrant| entrant.cases).unwrap_or_default())
    }

    fn answer(&self, folder: &Path, is_wanted: &dyn Fn(&str) -> bool) -> Result<(), GateError> {
        // Always anew: what a program imports may have changed where nobody said that it depends on it.
        let manner = Manner { jobs: self.jobs, again: true };
        let (challenge, entrant) = (self.challenge, self.entrant);
        match (self.share, self.function) {
            (GateShare::Parts(parts), _) => {
                let theirs = self.answered_in(parts, folder)?;
                take_over(challenge, entrant, folder, &theirs, manner.again, is_wanted)?
            }
            (_, Some(function)) => run_inside(challenge, entrant, folder, manner.again, is_wanted, function)?,
            (_, None) => run(challenge, entrant, folder, manner, is_wanted, self.progress)?,
        };
        Ok(())
    }

    /// The folders of a run in the work folders of parts; a part whose cases needed no further run has none.
    fn answered_in(&self, parts: &[PathBuf], run: &Path) -> Result<Vec<PathBuf>, GateError> {
        let (Some(work), Ok(own)) = (self.folder.parent(), run.strip_prefix(&self.folder)) else {
            return Ok(Vec::new());
        };
        let answers = self.folder.file_name().unwrap_or_default();
        let mut found = Vec::new();
        for part in parts {
            if same_folder(part, work) {
                return Err(GateError::PartIsWork(part.clone()));
            }
            let theirs = part.join(answers);
            if !theirs.is_dir() {
                return Err(GateError::NoPart(part.clone()));
            }
            found.extend(Some(theirs.join(own)).filter(|run| run.join(ANSWERS).is_file()));
        }
        Ok(found)
    }
}

fn same_folder(a: &Path, b: &Path) -> bool {
    a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b))
}
