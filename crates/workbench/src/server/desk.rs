//! The engine as the server sees it.

use serde::Serialize;

use crate::bench::{self, Given, LoadedCampaign, Refusal};
use crate::wire::{
    Ask, Export, FileText, Guess, KeepSession, Open, PlanReadings, Selection, ServerLimits, Try,
};

/// An engine. [`LoadedCampaign`] is the one there is; tests bring others, slow ones and ones that fall over.
///
/// # Errors
/// Everything but the catalogue may be refused with a [`Refusal`].
#[expect(clippy::missing_errors_doc, reason = "said once, above")]
pub trait Desk: Send + Sync + Sized + 'static {
    /// Everything there is to choose from.
    fn catalogue(limits: ServerLimits, given: Option<&Given>) -> impl Serialize;
    /// Load, read or simulate.
    fn open(request: &Open, given: Option<&Given>, limits: &ServerLimits) -> Result<Self, Refusal>;
    /// What it is.
    fn opened(&self, id: &str) -> Result<impl Serialize, Refusal>;
    /// Bytes of the files it was made from.
    fn bytes(&self) -> usize;
    /// Springs with the selected terms.
    fn view(&self, selection: &Selection) -> Result<impl Serialize + use<Self>, Refusal>;
    /// Each of some terms beside the selected ones.
    fn try_each(&self, each: &Try) -> Result<impl Serialize + use<Self>, Refusal>;
    /// What the residuals of the selected terms follow.
    fn followed(&self, selection: &Selection) -> Result<impl Serialize + use<Self>, Refusal>;
    /// Springs with the selected terms beside the springs alone, in one picture.
    fn picture(&self, selection: &Selection) -> Result<impl Serialize + use<Self>, Refusal>;
    /// What is wrong with the files.
    fn check(&self, ask: &Ask) -> Result<impl Serialize + use<Self>, Refusal>;
    /// The diagnosis.
    fn diagnose(&self, ask: &Ask) -> Result<impl Serialize + use<Self>, Refusal>;
    /// The readings to take next.
    fn plan(&self, asked: &PlanReadings) -> Result<impl Serialize + use<Self>, Refusal>;
    /// The law that no catalogue has.
    fn discover(&self, ask: &Ask) -> Result<impl Serialize + use<Self>, Refusal>;
    /// A file to take home.
    fn export(&self, export: &Export) -> Result<impl Serialize + use<Self>, Refusal>;
    /// What was done, to be kept.
    fn keep(&self, kept: &KeepSession) -> Result<impl Serialize + use<Self>, Refusal>;
    /// What was done, to be gone on with.
    fn resume(&self, file: &FileText) -> Result<impl Serialize + use<Self>, Refusal>;
    /// What is hidden.
    fn reveal(&self, guess: &Guess) -> Result<impl Serialize + use<Self>, Refusal>;
}

/// Methods that the engine has under the same names.
macro_rules! forwarded {
    ($($name:ident($asked:ty)),+ $(,)?) => {
        $(fn $name(&self, asked: &$asked) -> Result<impl Serialize + use<>, Refusal> {
            self.$name(asked)
        })+
    };
}

impl Desk for LoadedCampaign {
    fn catalogue(limits: ServerLimits, given: Option<&Given>) -> impl Serialize {
        bench::catalogue(limits, given)
    }

    fn open(request: &Open, given: Option<&Given>, limits: &ServerLimits) -> Result<Self, Refusal> {
        Self::open(request, given, limits)
    }

    fn opened(&self, id: &str) -> Result<impl Serialize, Refusal> {
        self.opened(id)
    }

    fn bytes(&self) -> usize {
        self.bytes()
    }

    forwarded! {
        view(Selection),
        try_each(Try),
        followed(Selection),
        picture(Selection),
        check(Ask),
        diagnose(Ask),
        plan(PlanReadings),
        discover(Ask),
        export(Export),
        keep(KeepSession),
        resume(FileText),
        reveal(Guess),
    }
}
