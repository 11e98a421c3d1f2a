//! What can become of a case.

use serde_json::Value;

use super::bench::Run;

/// What became of one case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Fate {
    /// Refused with its place and the next step.
    Refused,
    /// Answered with a warning, a finding, or a verdict that claims nothing.
    Told,
    /// The answer of the sound file; the old file or the whole new one; the bytes of an undisturbed run.
    Survived,
    /// As good a file as the sound one, with another answer.
    Undetectable,
    /// Another answer, of which nothing is said.
    Silent(String),
    /// Neither an answer nor a refusal as it should be: a panic, a signal, a run without end, no next step.
    Broken(String),
    /// The system does not let a test do this.
    Skipped,
}

impl Fate {
    /// Another answer of a file in which nothing is wrong by itself cannot be known.
    pub(super) fn where_sound(self, is_sound: bool) -> Self {
        if is_sound && matches!(self, Self::Silent(_)) { Self::Undetectable } else { self }
    }

    /// An answer that names this effect says what is wrong.
    pub(super) fn or_told_as(self, effect: &str) -> Self {
        if matches!(&self, Self::Silent(answer) if answer.contains(effect)) { Self::Told } else { self }
    }

    /// What must be so, else the case is broken for this reason.
    pub(super) fn survived_if(holds: bool, why: impl FnOnce() -> String) -> Self {
        if holds { Self::Survived } else { Self::Broken(why()) }
    }

    /// A run that has to be refused.
    pub(super) fn of_refusal(run: &Run) -> Self {
        match refusal(run) {
            Some(fate) => fate,
            None => Self::Broken(format!("not refused: {}", run.said)),
        }
    }
}

/// What a run is that gives no answer; none for one that does.
fn refusal(run: &Run) -> Option<Fate> {
    let first = run.said.lines().find(|line| line.starts_with("error: ")).unwrap_or_default();
    // Bad input names its file or line; what the data do not determine has no place in them.
    let has_place = match run.code {
        Some(3) => first.matches(": ").count() >= 2 || first.contains(" line "),
        _ => !first.is_empty(),
    };
    match run.code {
        Some(0) => None,
        Some(2..=5) if run.said.contains("next: ") && has_place => Some(Fate::Refused),
        code => Some(Fate::Broken(format!("exit {code:?}: {}", run.said))),
    }
}

/// What a command says of a machine.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Answer {
    verdict: String,
    effects: Vec<String>,
    /// Stiffness of each leg and its standard uncertainty.
    springs: Vec<[f64; 2]>,
    /// Whether something is said to be wrong, or nothing is claimed.
    is_told: bool,
}

/// Verdicts that claim something of the machine.
const CLAIMS: [&str; 2] = ["adequate", "named"];
/// Standard uncertainties by which springs may differ in a diagnosis that is right.
const RIGHT_SIGMAS: f64 = 4.0;

impl Answer {
    /// From the JSON of `fit` or `diagnose` on standard output.
    pub(super) fn of(run: &Run) -> Self {
        let json: Value = serde_json::from_slice(&run.shown).unwrap_or_else(|_| panic!("{}", run.said));
        let list = |key: &str| json[key].as_array().cloned().unwrap_or_default();
        let number = |value: &Value| value.as_f64().unwrap_or(f64::NAN);
        let verdict = json["verdict"].as_str().unwrap_or(CLAIMS[0]).to_owned();
        let springs = list("parameters");
        let springs =
            springs.iter().filter(|p| p["name"].as_str().is_some_and(|n| n.ends_with(".stiffness")));
        let springs: Vec<[f64; 2]> = springs.map(|p| [number(&p["value"]), number(&p["std"])]).collect();
        Self {
            // A leg that the data leave open is said to be.
            is_told: run.said.contains("warning: ")
                || springs.len() < 6
                || !list("findings").is_empty()
                || !CLAIMS.contains(&verdict.as_str()),
            effects: list("added").iter().filter_map(|id| id.as_str().map(str::to_owned)).collect(),
            springs,
            verdict,
        }
    }

    /// Stiffness of each leg and its standard uncertainty.
    pub(super) fn springs(&self) -> &[[f64; 2]] {
        &self.springs
    }

    /// Whether something is said to be wrong, or nothing is claimed.
    pub(super) fn is_told(&self) -> bool {
        self.is_told
    }

    /// Nothing is wrong with the files behind it.
    pub(super) fn assert_sound(self) -> Self {
        assert!(!self.is_told && self.springs.len() == 6, "{self:?}");
        self
    }

    /// The same of which only the stiffnesses count: too few readings show nothing else.
    pub(super) fn has_springs_of(&self, sound: &Self) -> bool {
        let near = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs() <= RIGHT_SIGMAS * a[1].max(b[1]);
        self.springs.len() == sound.springs.len() && self.springs.iter().zip(&sound.springs).all(near)
    }

    fn is_as(&self, sound: &Self) -> bool {
        let near = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).abs() <= RIGHT_SIGMAS * a[1].max(b[1]);
        let wide = |a: &[f64; 2], b: &[f64; 2]| a[1] <= RIGHT_SIGMAS * b[1];
        let springs = || self.springs.iter().zip(&sound.springs).all(|(a, b)| near(a, b) && wide(a, b));
        self.verdict == sound.verdict
            && self.effects == sound.effects
            && self.springs.len() == sound.springs.len()
            && springs()
    }
}

/// The fate of a run beside the answer to the sound files.
pub(super) fn judged(run: &Run, sound: &Answer) -> Fate {
    if let Some(fate) = refusal(run) {
        return fate;
    }
    let answer = Answer::of(run);
    if answer.is_as(sound) {
        Fate::Survived
    } else if answer.is_told {
        Fate::Told
    } else {
        Fate::Silent(format!("{answer:?} in place of {sound:?}"))
    }
}
