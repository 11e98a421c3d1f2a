//! Figures of campaigns that have something in common: a misstatement, a family, a plan.

use std::collections::BTreeMap;

use hexbench_core::statistics::Proportion;
use hexbench_truth::misstatements;

use super::{MisreadFate, MisreadRecord};
use crate::shares::or_dash;

/// Misread campaigns with something in common.
#[derive(Debug)]
pub struct MisreadGroup<'a> {
    /// What they have in common.
    pub name: String,
    /// Their trials.
    pub records: Vec<&'a MisreadRecord>,
}

impl<'a> MisreadGroup<'a> {
    /// All misread campaigns.
    pub fn of_all(records: &'a [MisreadRecord]) -> Self {
        let misread = records.iter().filter(|r| r.misstatement.is_some());
        Self { name: "all".to_owned(), records: misread.collect() }
    }

    /// One for each misstatement with a trial, in the order of the registry.
    pub fn of_each_misstatement(records: &'a [MisreadRecord]) -> Vec<Self> {
        let of = |id: &str| Self {
            name: id.to_owned(),
            records: records.iter().filter(|r| r.misstatement.as_deref() == Some(id)).collect(),
        };
        let all = misstatements::registry().map(|entry| of(entry.id));
        all.filter(|group| !group.records.is_empty()).collect()
    }

    /// One for each word of the campaigns.
    pub fn of_each(records: &'a [MisreadRecord], word: fn(&MisreadRecord) -> &str) -> Vec<Self> {
        let mut groups: BTreeMap<&str, Vec<&MisreadRecord>> = BTreeMap::new();
        for r in records.iter().filter(|r| r.misstatement.is_some()) {
            groups.entry(word(r)).or_default().push(r);
        }
        groups.into_iter().map(|(name, records)| Self { name: name.to_owned(), records }).collect()
    }

    fn mattering(&self) -> impl Iterator<Item = &MisreadRecord> {
        self.records.iter().copied().filter(|r| r.matters())
    }

    /// Campaigns in which the misstatement matters.
    pub fn matters(&self) -> Proportion {
        Proportion::count(&self.records, |r| r.matters())
    }

    /// Of these, campaigns whose answer is wrong and looks right.
    pub fn looks_right(&self) -> Proportion {
        Proportion::count(self.mattering(), |r| r.looks_right())
    }

    /// The campaigns whose readings show that something is wrong.
    #[must_use]
    pub fn shown_by_the_data(&self) -> Self {
        let shown = self.records.iter().copied().filter(|r| r.matters() && !r.looks_right());
        Self { name: self.name.clone(), records: shown.collect() }
    }

    /// Of those in which it matters, campaigns with a fate.
    pub fn share(&self, fate: MisreadFate) -> Proportion {
        Proportion::count(self.mattering(), |r| r.fate() == Some(fate))
    }

    /// What was said most often where it matters: the first finding about the file, else the verdict.
    pub fn said_most(&self) -> String {
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for r in self.mattering() {
            *counts.entry(r.about_file().next().unwrap_or(r.verdict_word())).or_default() += 1;
        }
        // The first of those that are equally frequent, by the alphabet.
        let most = counts.into_iter().rev().max_by_key(|(_, count)| *count);
        or_dash(most, |(word, count)| format!("{word} ({count})"))
    }
}
