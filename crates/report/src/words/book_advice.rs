//! What to do about the changes of a book.

use std::collections::BTreeSet;

use hexbench_core::words::joined;
use hexbench_model::estimation::parameters::leg_of_stiffness;
use hexbench_model::results::book::{CampaignBook, ChangeKind, ChartChange, ChartSubject, ControlChart};

use super::book::{all_changes, campaign, scattered};

/// Legs of a hexapod.
const LEGS: usize = 6;

/// One sentence or two: the next step.
pub(super) fn advice(book: &CampaignBook) -> String {
    let changes = all_changes(book);
    if changes.is_empty() {
        return match scattered(book).next() {
            None => "Continue: changes of the sizes below would have been reported nine times out of ten.".to_owned(),
            Some(_) => "Take two consecutive campaigns without touching the machine. If they agree, the machine or its setup changes \
                        from one campaign to the next; if not, the noise is larger than stated."
                .to_owned(),
        };
    }
    one_campaign(book, &changes)
        .or_else(|| legs(book, &changes))
        .or_else(|| effects(&changes))
        .unwrap_or_else(|| error(book, &changes))
}

type Found<'a> = (&'a ControlChart, &'a ChartChange);

/// Everything odd is in one campaign.
fn one_campaign(book: &CampaignBook, changes: &[Found<'_>]) -> Option<String> {
    let first = changes[0].1.campaign;
    let alone = |(_, c): &Found<'_>| c.kind == ChangeKind::Alone && c.campaign == first;
    changes.iter().all(alone).then(|| {
        format!(
            "Check the log of {} for what was different (setup, temperature, load cell); repeat it, or omit it from the book.",
            campaign(book, first)
        )
    })
}

fn legs(book: &CampaignBook, changes: &[Found<'_>]) -> Option<String> {
    let of_legs: Vec<(usize, &ChartChange)> =
        changes.iter().filter_map(|(chart, c)| Some((leg_of_stiffness(&chart.name)?, *c))).collect();
    let legs: BTreeSet<usize> = of_legs.iter().map(|(leg, _)| leg + 1).collect();
    let (_, strongest) = of_legs.first()?;
    let alike = of_legs.iter().all(|(_, c)| (c.size > 0.0) == (strongest.size > 0.0));
    if legs.len() == LEGS && alike {
        return Some(
            "All legs changed in the same direction. Check first what they share: the calibration of the load cell, the scale \
             of the instrument, the temperature, the base."
                .to_owned(),
        );
    }
    let words: Vec<String> = legs.iter().map(ToString::to_string).collect();
    let noun = if words.len() == 1 { "leg" } else { "legs" };
    let when = match strongest.kind {
        ChangeKind::Step => format!(" before {}", campaign(book, strongest.campaign)),
        ChangeKind::Alone => format!(" in {}", campaign(book, strongest.campaign)),
        ChangeKind::Drift => " since the first campaign".to_owned(),
    };
    Some(format!(
        "Check {noun} {}: joints, preload, drive, and any work done{when}. A model fitted to earlier readings no longer predicts this \
         machine; fit it to newer readings.",
        joined(&words)
    ))
}

fn effects(changes: &[Found<'_>]) -> Option<String> {
    let effect = |(chart, _): &Found<'_>| {
        let id = chart.name.split('.').next()?;
        (chart.about == ChartSubject::Effect).then(|| id.to_owned())
    };
    let ids: BTreeSet<String> = changes.iter().filter_map(effect).collect();
    let words: Vec<String> = ids.iter().map(|id| format!("`hexbench terms {id}`")).collect();
    (!words.is_empty()).then(|| {
        format!(
            "{} explains the effect and what it depends on; a model fitted to earlier readings no longer predicts this machine.",
            joined(&words)
        )
    })
}

fn error(book: &CampaignBook, changes: &[Found<'_>]) -> String {
    let grown = changes.iter().find(|(_, c)| c.size > 0.0);
    grown.map_or_else(
        || "The error fell; keep the change.".to_owned(),
        |(_, c)| {
            format!(
                "The model explains the machine less well than before: `hexbench diagnose` on the readings of {} \
                 names the new effect, or says that no known effect explains it.",
                campaign(book, c.campaign)
            )
        },
    )
}
