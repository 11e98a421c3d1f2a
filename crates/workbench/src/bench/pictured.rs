//! The model of a selection beside the springs alone, in one picture.

use std::time::Instant;

use hexbench_report::charts::story_of_fits;

use super::LoadedCampaign;
use super::counted::Counted;
use super::refusal::Refusal;
use crate::wire::{Pictured, Selection};

impl LoadedCampaign {
    /// The one telling load: what the springs miss, what the selected terms explain, what is left, and both errors.
    ///
    /// # Errors
    /// [`Refusal`] for a term that is unknown, and for a model that cannot be fitted.
    pub fn picture(&self, selection: &Selection) -> Result<Pictured, Refusal> {
        let since = Instant::now();
        let counted = Counted::of(self, &selection.exclude)?;
        let task = counted.task();
        let alone = Selection { exclude: selection.exclude.clone(), ..Selection::default() };
        let (springs, model) = (self.judged(&counted, &alone)?, self.judged(&counted, selection)?);
        let name = selection.terms.iter().map(|id| format!("+ {id}")).collect::<Vec<_>>().join(" ");
        let picture = story_of_fits(&task, &springs, &model, name)?;
        Ok(Pictured { picture, milliseconds: since.elapsed().as_secs_f64() * 1e3 })
    }
}
