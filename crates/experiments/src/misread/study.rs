//! Running the protocol.

use super::{MisreadFate, MisreadProtocol, MisreadRecord};
use crate::harness::{self, Field, Study};
use crate::journal::Identity;
use crate::trial::TrialError;

/// All trials of a protocol.
pub type Misread = Study<MisreadProtocol>;

impl harness::Protocol for MisreadProtocol {
    type Record = MisreadRecord;
    type Error = TrialError;

    fn identity(&self) -> Identity {
        let scenes: Vec<String> = self.scenes.iter().map(|s| format!("{} {}", s.name, s.digest)).collect();
        let settings = [
            ("misstatements", self.misstatements.join(", ")),
            ("trials", self.trials.to_string()),
            ("sound", self.sound.to_string()),
            ("scenes", scenes.join(", ")),
            ("seed", self.seed.to_string()),
        ];
        Identity::new("misread", "misread-trials/1", settings)
    }

    fn trials(&self) -> u64 {
        self.all() as u64
    }

    fn trial(&self, number: u64) -> Result<MisreadRecord, TrialError> {
        MisreadRecord::of(&self.job(number), self.seed)
    }

    fn name(&self, number: u64) -> String {
        self.job(number).name()
    }

    fn fields(&self) -> Vec<Field<MisreadRecord>> {
        words().into_iter().chain(numbers()).collect()
    }
}

fn words() -> Vec<Field<MisreadRecord>> {
    vec![
        Field::text("misstatement", "what is misstated, or sound", |r: &MisreadRecord| {
            r.misstatement.clone().unwrap_or_else(|| "sound".to_owned())
        }),
        Field::text("kind", "kind of the campaign", |r: &MisreadRecord| r.campaign.kind.clone()),
        Field::text("family", "family of the machine", |r: &MisreadRecord| r.campaign.family.clone()),
        Field::text("plan", "plan of the measurements", |r: &MisreadRecord| r.campaign.plan.clone()),
        Field::text("hidden", "hidden effects", |r: &MisreadRecord| r.campaign.hidden.clone()),
        Field::text("verdict", "the verdict, or refused", MisreadRecord::verdict_word),
        Field::text("added", "effects named", |r: &MisreadRecord| r.added.join("+")),
        Field::text("findings", "kinds of the findings", |r: &MisreadRecord| r.findings.join("+")),
        Field::text("fate", "what became of the misstatement", |r: &MisreadRecord| {
            r.fate().map_or("", MisreadFate::words)
        }),
        Field::text("refusal", "why there is no answer", |r: &MisreadRecord| r.refusal.clone()),
    ]
}

fn numbers() -> Vec<Field<MisreadRecord>> {
    let p = |name| (name, "1");
    let flag = |is: bool| f64::from(u8::from(is));
    let chi2 = |place: usize, is_written: bool| {
        move |r: &MisreadRecord| {
            r.change.as_ref().map(|c| if is_written { c.written[place] } else { c.meant[place] })
        }
    };
    vec![
        Field::number(p("size"), "effects over their usual size", |r: &MisreadRecord| r.campaign.size),
        Field::number(p("matters"), "the plain answer is another one", move |r: &MisreadRecord| {
            flag(r.matters())
        }),
        Field::number(p("looks_right"), "it is, and no misfit shows it", move |r: &MisreadRecord| {
            flag(r.looks_right())
        }),
        Field::number(
            p("springs_meant"),
            "chi-square per degree of freedom, springs, as meant",
            chi2(0, false),
        ),
        Field::number(p("springs_written"), "the same as written", chi2(0, true)),
        Field::number(
            p("holdout_meant"),
            "held-out chi-square per number, springs, as meant",
            chi2(1, false),
        ),
        Field::number(p("holdout_written"), "the same as written", chi2(1, true)),
    ]
}
