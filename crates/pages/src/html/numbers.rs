//! Tables: effects, stiffnesses, correlation, proposals, limits, suspects, where it comes from.

use hexbench_core::Hexapod;
use hexbench_model::diagnose::{Diagnosis, NextReport};
use hexbench_model::estimate::{Estimate, parameter_names};
use hexbench_report::html::{Block, Cell, Section};
use hexbench_report::number::{significant, with_uncertainty};
use hexbench_report::plot::HeatMap;

use super::{Provenance, ReportError};
use crate::{Subject, notes};

/// Columns of a correlation map that can be read.
const MOST_COLUMNS: usize = 24;

/// Parameters of the added effects.
pub(crate) fn effects(d: &Diagnosis) -> Option<Section> {
    let of_effects = |p: &&Estimate| !p.name.starts_with("leg-") || !p.name.ends_with(".stiffness");
    let row = |p: &Estimate| {
        let [value, std] = with_uncertainty(p.value, p.std);
        vec![Cell::new(&p.name), Cell::new(value), Cell::new(format!("± {std}")), Cell::new(&p.unit)]
    };
    let rows: Vec<Vec<Cell>> = d.parameters.iter().filter(of_effects).map(row).collect();
    if rows.is_empty() {
        return None;
    }
    let remark = format!("Springs + {}; standard uncertainty (k = 1).", d.model.join(" + "));
    let section = Section::new("effects", "How large", remark)
        .with(Block::table(["parameter", "value", "uncertainty", "unit"], rows));
    Some(if d.not_determined.is_empty() {
        section
    } else {
        let open = d.not_determined.join(", ");
        section.with(Block::paragraph(format!("Not determined by these data: {open}.")))
    })
}

/// Leg stiffnesses, and the bias when an effect is left out.
pub(crate) fn stiffness(hexapod: &Hexapod, d: &Diagnosis) -> Section {
    let estimate = |leg: usize| d.parameters.iter().find(|p| p.name == format!("leg-{}.stiffness", leg + 1));
    let numbers: Vec<Option<[String; 2]>> =
        (0..6).map(|leg| estimate(leg).map(|p| with_uncertainty(p.value, p.std))).collect();
    let row = |name: &str, cell: &dyn Fn(usize) -> String| -> Vec<Cell> {
        std::iter::once(Cell::new(name)).chain((0..6).map(|leg| Cell::new(cell(leg)))).collect()
    };
    let part =
        |leg: usize, k: usize| numbers[leg].as_ref().map_or("not determined".to_owned(), |n| n[k].clone());
    let mut rows = vec![row("stiffness", &|leg| part(leg, 0)), row("±", &|leg| part(leg, 1))];
    if let Some(nominal) = hexapod.nominal_stiffness {
        rows.push(row("nominal", &|leg| format!("{:.3}", 1e-6 * nominal[leg])));
    }
    for report in &d.absorbed {
        let bias = |leg: usize| {
            report.bias_of_leg_stiffness_percent[leg].map_or("-".to_owned(), |b| format!("{b:+.1} %"))
        };
        rows.push(row(&format!("without {}", report.term), &bias));
    }
    let header = std::iter::once("leg".to_owned()).chain((1..=6).map(|leg| leg.to_string()));
    let remark = "N/um; standard uncertainty (k = 1), over all explanations that remain. Percentages: change when that effect \
                  is left out, which the springs absorb.";
    Section::new("stiffness", "Leg stiffness", remark).with(Block::table(header, rows))
}

/// Correlation of the estimates of the final model.
pub(crate) fn correlation(subject: &Subject<'_>) -> Result<Option<Section>, ReportError> {
    let Some(fit) = subject.study.fits.last() else { return Ok(None) };
    let mut columns: Vec<(String, usize)> = (0..6).map(|leg| (format!("leg {}", leg + 1), leg)).collect();
    for (active, &offset) in fit.point.active.iter().zip(&fit.offsets) {
        let names = parameter_names(active).into_iter().enumerate();
        columns.extend(names.map(|(k, (name, ..))| (format!("{}.{name}", active.id()), offset + k)));
    }
    columns.retain(|(_, k)| fit.is_determined(*k));
    if columns.len() < 2 || columns.len() > MOST_COLUMNS {
        return Ok(None);
    }
    let names: Vec<String> = columns.iter().map(|c| c.0.clone()).collect();
    let cell = |a: usize, b: usize| fit.covariance[(a, b)] / (fit.std(a) * fit.std(b)).max(f64::MIN_POSITIVE);
    let rows = columns.iter().map(|a| columns.iter().map(|b| cell(a.1, b.1).abs()).collect()).collect();
    let map = HeatMap::new("", names.clone(), names, rows).with_decimals(2).with_full_shade_at(1.0);
    let caption = "Absolute correlation of the estimates: near 1, only a combination of the two is known.";
    Ok(Some(Section::new("correlation", "Correlation", "").with(Block::figure(map.to_svg()?, caption))))
}

/// The readings that separate what remains.
pub(crate) fn next(d: &Diagnosis) -> Option<Section> {
    if d.next.is_empty() {
        return None;
    }
    let list = |all: &[f64]| all.iter().map(|x| significant(*x, 3)).collect::<Vec<_>>().join(", ");
    let row = |n: &NextReport| {
        let odds = n.gain.exp();
        vec![
            Cell::new(format!("({}) mm, ({}) deg", list(&n.pose[..3]), list(&n.pose[3..]))),
            Cell::new(format!("({}) N, ({}) N m", list(&n.wrench[..3]), list(&n.wrench[3..]))),
            Cell::new(format!("({}) N, ({}) N m", list(&n.reference[..3]), list(&n.reference[3..]))),
            Cell::new(format!("{:+}", n.approach)),
            Cell::new(significant(n.elapsed_s, 3)),
            Cell::new(significant(n.delta_t_k, 2)),
            Cell::new(n.repeats.to_string()),
            Cell::words(n.separates.join(" / ")),
            Cell::new(if odds > 1e4 { "more than 10000".to_owned() } else { significant(odds, 2) }),
        ]
    };
    let header = [
        "pose",
        "wrench",
        "reference wrench",
        "approach",
        "wait s",
        "warmer K",
        "times",
        "separates",
        "expected odds",
    ];
    let words = d.next.iter().filter(|n| !n.text.is_empty()).map(|n| n.text.clone());
    let remark = "Fixed axes, wrench on the platform at the mobile origin.";
    Some(
        Section::new("next", "What to measure next", remark)
            .with(Block::table(header, d.next.iter().map(row)))
            .with(Block::list(words)),
    )
}

/// What could not be tested, and the smallest sizes that would have shown.
pub(crate) fn limits(d: &Diagnosis) -> Section {
    let remark = "Seen in 9 of 10 such campaigns, false alarm in 1 of 100.";
    let rows = d.detectable.iter().map(|row| {
        let size = row.size_at_90_percent_power.map_or("none shows".to_owned(), |s| significant(s, 2));
        vec![Cell::new(format!("{}.{}", row.term, row.parameter)), Cell::new(size), Cell::new(&row.unit)]
    });
    let section = Section::new("limits", "What these data would show", remark);
    let section = section.with(Block::table(["parameter", "smallest size seen", "unit"], rows));
    if d.untestable.is_empty() {
        return section;
    }
    let items = d.untestable.iter().map(|u| format!("{}: {}", u.term, u.why));
    section.with(Block::paragraph("Could not be tested:")).with(Block::list(items))
}

/// Suspect readings and warnings.
pub(crate) fn look_at(d: &Diagnosis) -> Option<Section> {
    let suspects = (!d.suspects.is_empty()).then(|| notes::suspects(d));
    let items: Vec<String> = suspects.into_iter().chain(d.warnings.iter().cloned()).collect();
    (!items.is_empty()).then(|| Section::new("look-at", "Look at this", "").with(Block::list(items)))
}

/// Versions, files, command.
pub(crate) fn provenance(p: &Provenance, noise: &str) -> Section {
    let row = |name: &str, text: &str| vec![Cell::new(name), Cell::words(text)];
    let head =
        [row("program", hexbench_report::html::PROGRAM), row("command", &p.command), row("noise", noise)];
    let files = p.files.iter().map(|(file, digest)| row(file, &format!("SHA-256 {digest}")));
    let rows: Vec<Vec<Cell>> = head.into_iter().chain(files).collect();
    Section::new("provenance", "Where this comes from", notes::CONVENTIONS).with(Block::table(["", ""], rows))
}
