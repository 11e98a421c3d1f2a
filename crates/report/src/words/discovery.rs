//! A search for the law that no catalogue has, in words.

use std::ffi::OsStr;

use hexbench_core::words::{joined, upper_first};
use hexbench_core::{Dataset, Hexapod};
use hexbench_model::estimation::estimate::Estimate;
use hexbench_model::estimation::fit_named::effects;
use hexbench_model::results::discover::{Discovery, DiscoveryReason, DiscoveryStudy, LawReport};

use super::{as_option, as_word, command_line, conclusion, ladder, notes, size, subject};
use crate::number::{multiple, percent, significant, with_uncertainty};
use crate::page::{Block, Definition, Mood, Page, PageColumn, Section, Table};

/// The words of a search, as a shell takes them, for the commands that are proposed.
#[derive(Debug, Clone)]
pub struct LawFiles {
    /// Machine, readings and how they are read, each option with its value.
    pub asked: Vec<String>,
    /// Lines left out, which only a diagnosis takes.
    pub left_out: Vec<String>,
    /// The term file that the law was written to.
    pub law: Option<String>,
    /// The folder that the law and its look-alikes were written to.
    pub all: Option<String>,
}

/// Machine and readings of a search, for [`LawFiles::asked`].
pub fn files_asked<F: AsRef<OsStr>>(machine: F, data: F, holdout: Option<F>) -> Vec<String> {
    let held_out = holdout.map(|file| as_option("holdout", file));
    [as_word(machine), as_word(data)].into_iter().chain(held_out).collect()
}

impl Default for LawFiles {
    /// Files that nobody named.
    fn default() -> Self {
        let asked = vec!["hexapod.toml".to_owned(), "measurements.csv".to_owned()];
        Self { asked, left_out: Vec::new(), law: None, all: None }
    }
}

impl LawFiles {
    /// Diagnosis and fit with the law, each as it can be pasted.
    fn commands(&self, beside: &[String]) -> String {
        let term = format!("--term {}", self.law.as_deref().unwrap_or("term.toml"));
        let command = |name: &str, more: Vec<String>| {
            let words = std::iter::once(format!("hexbench {name}")).chain(self.asked.iter().cloned());
            command_line(words.chain(more).chain([term.clone()]))
        };
        // Terms of the user are among the files already.
        let listed = beside.iter().filter(|id| size::is_listed(id));
        let fit = listed.map(|id| format!("--add {id}")).chain(["-o model.toml".to_owned()]);
        format!("{}\n{}", command("diagnose", self.left_out.clone()), command("fit", fit.collect()))
    }
}

/// The page.
pub fn discovery(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    study: &DiscoveryStudy,
    files: &LawFiles,
) -> Page {
    let d = &study.discovery;
    let entries = subject::entries(data, holdout, &study.diagnosis.campaign);
    let searched =
        (d.searched > 0).then(|| Definition::new("searched", format!("{} laws", thousands(d.searched))));
    let page = Page {
        subject: entries.into_iter().chain(searched).collect(),
        ..Page::new(format!("Laws beyond the catalogue: {}", hexapod.name))
    };
    page.with(verdict(d))
        .with(laws(d, data.is_absolute()))
        .with(ladder::of_steps(&d.steps, &study.diagnosis.diagnosis, data.measurand))
        .with(notes::look_at(d.warnings.iter().cloned()))
        .with(look_for(d))
        .with(super::next::between_laws(d))
        .with(next(d, files))
        .with(notes::conventions())
}

fn verdict(d: &Discovery) -> Section {
    let (word, mood) = match d.reason {
        DiscoveryReason::Law => ("LAW FOUND", Mood::Good),
        DiscoveryReason::NothingMissing | DiscoveryReason::Catalogue => ("NO LAW NEEDED", Mood::Good),
        DiscoveryReason::Readings => ("NOTHING TO SEARCH", Mood::Doubt),
        DiscoveryReason::NoLawConvinces => ("NO LAW FOUND", Mood::Doubt),
    };
    Section::new("Verdict").with(Block::Verdict { word: word.to_owned(), mood, sentences: sentences(d) })
}

fn sentences(d: &Discovery) -> Vec<String> {
    let mut all = vec![format!("{}.", upper_first(&d.text))];
    if let (DiscoveryReason::Law, Some(best)) = (d.reason, d.laws.first()) {
        if !d.beside.is_empty() {
            all.push(format!("It acts in addition to {}.", effects(&d.beside)));
        }
        all.push(format!(
            "A law like this is present with a probability of {}, after a penalty for the search.",
            percent(d.probability)
        ));
        if !best.alike.is_empty() {
            let others: Vec<&str> =
                d.laws.iter().filter(|l| best.alike.contains(&l.id)).map(|l| l.text.as_str()).collect();
            all.push(format!(
                "These readings do not separate it from {}: {}. Within the measured range their predictions are the same.",
                if others.len() == 1 { "another law" } else { "other laws" },
                others.join("; or ")
            ));
        }
        all.push(conclusion::error_statement(&d.steps, d.steps.len().saturating_sub(1)));
    }
    all
}

/// Every law with its size and what held-out poses say.
fn laws(d: &Discovery, is_absolute: bool) -> Option<Section> {
    if d.laws.is_empty() {
        return None;
    }
    let (title, remark) = if d.found {
        let elongation =
            if is_absolute { "elongation of a leg" } else { "elongation of a leg, loaded minus reference" };
        ("The law", format!("e: {elongation}, m; the formula is in SI units"))
    } else {
        ("Ideas", "none is convincing: they suggest where to look first, not what is present".to_owned())
    };
    let columns = [
        PageColumn::words("law"),
        PageColumn::number("probability"),
        PageColumn::number("held-out error before"),
        PageColumn::number("after"),
    ];
    let row = |law: &LawReport| {
        let errors =
            law.held_out.map_or([String::new(), String::new()], |h| [multiple(h.before), multiple(h.after)]);
        [law.id.clone(), percent(law.probability), errors[0].clone(), errors[1].clone()]
    };
    let section = Section::new(title).id("law").remark(remark);
    let section = d.laws.iter().fold(section, |section, law| section.with(Block::entries(described(law))));
    Some(section.table(Table::new(columns).rows(d.laws.iter().map(row))))
}

fn described(law: &LawReport) -> Vec<Definition> {
    let legs = match &law.legs {
        hexbench_model::results::discover::LawLegs::All(_) => "all".to_owned(),
        hexbench_model::results::discover::LawLegs::Some(some) => {
            joined(&some.iter().map(usize::to_string).collect::<Vec<_>>())
        }
    };
    let size = |p: &Estimate| {
        let [value, std] = with_uncertainty(p.value, p.std);
        let name = p.name.split_once('.').map_or(p.name.as_str(), |(_, name)| name);
        format!("{name} {value} +- {std} {}", if p.unit == "1" { "" } else { &p.unit }).trim_end().to_owned()
    };
    let sizes: Vec<String> = law.parameters.iter().map(size).collect();
    let mut all = vec![
        Definition::new(law.id.as_str(), upper_first(&law.text)),
        Definition::new("formula", format!("e = {}", law.formula)),
        Definition::new("legs", legs),
    ];
    if !sizes.is_empty() {
        all.push(Definition::new("size", sizes.join(", ")));
    }
    all
}

fn look_for(d: &Discovery) -> Option<Section> {
    let best = d.laws.first()?;
    let items = best.look_at.iter().map(|text| (*text).to_owned()).collect();
    Some(Section::new("What to look for").id("look-for").with(Block::List { items }))
}

fn next(d: &Discovery, files: &LawFiles) -> Option<Section> {
    let section = Section::new("Next").id("next");
    match d.reason {
        DiscoveryReason::Law => {
            let written = if files.law.is_some() {
                "These commands compare the law like any effect, and save it for predictions and corrected commands:"
            } else {
                "Write the law with -o term.toml; these commands then compare it like any effect, and save it for predictions and \
                 corrected commands:"
            };
            let again = format!(
                "A law that appears again in a second campaign belongs to the machine; one that does not belongs to this campaign.{}",
                alike(d, files)
            );
            Some(section.paragraph(written).with(Block::code(files.commands(&d.beside))).paragraph(again))
        }
        DiscoveryReason::NoLawConvinces => Some(section.paragraph(
            "Vary one thing at a time: length, direction, load, temperature, time. The cause may depend on something that these \
             readings do not vary.",
        )),
        DiscoveryReason::NothingMissing | DiscoveryReason::Catalogue | DiscoveryReason::Readings => None,
    }
}

/// How laws that look alike are told apart.
fn alike(d: &Discovery, files: &LawFiles) -> String {
    let [first, second, ..] = d.laws.as_slice() else { return String::new() };
    let within = if d.next.is_empty() { " No reading within the measured range separates them." } else { "" };
    let written = if files.all.is_some() {
        String::new()
    } else {
        format!(" --all DIR also writes the look-alikes, as {}.toml, {}.toml, ...;", first.id, second.id)
    };
    let (machine, folder) =
        (files.asked.first().map_or("hexapod.toml", |m| m), files.all.as_deref().unwrap_or("DIR"));
    format!(
        "{within}{written} `hexbench discriminate {machine} space.toml --term {folder}/{}.toml --term {folder}/{}.toml --between {} \
         --between {}` chooses readings beyond that range that separate them.",
        first.id, second.id, first.term, second.term
    )
}

/// `850 000`, `1.7 million`: two digits, the size that matters.
pub(super) fn thousands(count: usize) -> String {
    let rounded: usize = significant(count as f64, 2).parse().unwrap_or(count);
    match count {
        0..10_000 => count.to_string(),
        10_000..1_000_000 => format!("{} 000", rounded / 1000),
        _ => format!("{} million", significant(count as f64 * 1e-6, 2)),
    }
}
