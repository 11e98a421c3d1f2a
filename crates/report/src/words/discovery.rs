//! A search for the law that no catalogue has, in words.

use hexbench_core::{Dataset, Hexapod};
use hexbench_model::estimation::estimate::Estimate;
use hexbench_model::results::discover::{Discovery, DiscoveryReason, DiscoveryStudy, LawReport};
use hexbench_model::results::words::{effects, joined};

use super::{conclusion, ladder, notes, size, subject};
use crate::number::{multiple, percent, significant, with_uncertainty};
use crate::page::{Block, Definition, Mood, Page, PageColumn, Section, Table};

/// Where the law was written, for the commands that are proposed.
const TERM_FILE: &str = "term.toml";

/// The page.
pub fn discovery(
    hexapod: &Hexapod,
    data: &Dataset,
    holdout: Option<&Dataset>,
    study: &DiscoveryStudy,
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
        .with(laws(d))
        .with(ladder::of_steps(&d.steps, &study.diagnosis.diagnosis, data.measurand))
        .with(look_for(d))
        .with(super::next::between_laws(d))
        .with(next(d))
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
    let mut all = vec![format!("{}.", capital(&d.text))];
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
        all.push(conclusion::error_statement(&d.steps));
    }
    all
}

/// Every law with its size and what held-out poses say.
fn laws(d: &Discovery) -> Option<Section> {
    if d.laws.is_empty() {
        return None;
    }
    let (title, remark) = if d.found {
        ("The law", "e: elongation of a leg, loaded minus reference, m; the formula is in SI units")
    } else {
        ("Ideas", "none is convincing: they suggest where to look first, not what is present")
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
        Definition::new(law.id.as_str(), capital(&law.text)),
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

fn next(d: &Discovery) -> Option<Section> {
    let text = match d.reason {
        DiscoveryReason::Law => format!(
            "Write the law with -o {TERM_FILE}; then `hexbench diagnose ... --term {TERM_FILE}` compares it like any effect, and \
             `hexbench fit ...{} --term {TERM_FILE} -o model.toml` saves it for predictions and corrected commands. A law that appears again in a second campaign belongs to the machine; one that does not belongs to this campaign.{}",
            size::asked(&d.beside),
            alike(d)
        ),
        DiscoveryReason::NoLawConvinces => {
            "Vary one thing at a time: length, direction, load, temperature, time. The cause may depend on \
             something that these readings do not vary."
                .to_owned()
        }
        DiscoveryReason::NothingMissing | DiscoveryReason::Catalogue | DiscoveryReason::Readings => {
            return None;
        }
    };
    Some(Section::new("Next").id("next").paragraph(text))
}

/// How laws that look alike are told apart.
fn alike(d: &Discovery) -> String {
    let [first, second, ..] = d.laws.as_slice() else { return String::new() };
    let within = if d.next.is_empty() { " No reading within the measured range separates them." } else { "" };
    format!(
        "{within} --all DIR also writes the look-alikes, as {0}.toml, {1}.toml, ...; `hexbench discriminate hexapod.toml space.toml \
         --term DIR/{0}.toml --term DIR/{1}.toml --between {2} --between {3}` chooses readings beyond that range that separate them.",
        first.id, second.id, first.term, second.term
    )
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|c| c.to_uppercase().chain(letters).collect()).unwrap_or_default()
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
