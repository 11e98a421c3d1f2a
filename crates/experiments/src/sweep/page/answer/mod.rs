//! The answer to the question of a study, in sentences.

mod index;
mod plans;
mod rank;
mod sentence;

use hexbench_report::{Block, Section};

use crate::sweep::question::Question;
use crate::sweep::results::CellStatistics;
use crate::sweep::study::SweepStudy;

pub use index::{IndexRank, ranks};
pub use plans::{AskedPlan, AskedPlans, Meets, groups, judged};
pub(super) use rank::rank_advantage;
pub use rank::rank_correlation;

/// One sentence for each machine, effect, size and noise; none where the study asks nothing.
pub fn sentences(study: &SweepStudy, cells: &[CellStatistics]) -> Vec<String> {
    match study.question {
        None => Vec::new(),
        Some(Question::Index) => {
            ranks(study, cells).iter().map(|found| index::sentence(study, found)).collect()
        }
        Some(question) => {
            groups(study, cells).iter().map(|group| sentence::of(study, question, group)).collect()
        }
    }
}

/// The section on top of the page.
pub(super) fn answer(study: &SweepStudy, cells: &[CellStatistics]) -> Option<Section> {
    let question = study.question?;
    let section = Section::new("Answer").with_all(sentences(study, cells).into_iter().map(Block::paragraph));
    Some(match question {
        Question::Index => section.table(index::table(study, cells)).paragraph(index::READING),
        Question::Share(..) | Question::Error(_) => section.paragraph(plans::READING),
    })
}
