//! The power of one plan on a page.

use hexbench_design::power::{Effect, Range, Reference, Verdict};
use hexbench_model::noise::NoiseSource;
use hexbench_report::Document;

use super::{PowerPlan, Power};

/// What is told.
pub struct Page<'a> {
    /// The plan.
    pub plan: &'a PowerPlan,
    /// Its power.
    pub power: &'a Power,
    /// Ids of the effects to tell; all when empty.
    pub only: &'a [String],
    /// Every parameter.
    pub verbose: bool,
}

impl Page<'_> {
    /// The page.
    pub fn document(&self) -> Document {
        let mut page = Document::default();
        let mut rows = Vec::new();
        for (k, e) in self.power.study.effects.iter().enumerate() {
            rows.push(vec![
                e.term.to_owned(), format!("{:?}", e.verdict), format!("{:.3} {}", e.usual_size, e.unit),
                format!("{:.2} ({:.2}..{:.2})", e.seen_at.middle, e.seen_at.least, e.seen_at.most),
                format!("{:.0} ({:.0}..{:.0})", 100.*e.power_at_usual_size.middle, 100.*e.power_at_usual_size.least, 100.*e.power_at_usual_size.most),
                format!("{:.3}", e.absorbed), format!("{} {} {:.2}", e.parameters_determined, e.shapes, e.threshold),
                format!("{:.1}", e.sensible),
                format!("{:.1}", e.bias_at_usual_size_percent.iter().fold(0.0f64, |m, b| m.max(b.abs()))),
                format!("{:?}", e.bias_when_seen_percent.map(|b| b.iter().fold(0.0f64, |m, b| m.max(b.abs())))),
                format!("{:?}", self.power.study.alike.taken_for[k].get(k)),
                format!("{:?}", self.power.study.alike.taken_for[k].is_empty().then(Vec::new).unwrap_or_else(|| self.power.study.alike.mistaken(k))),
                format!("{:?}", self.power.checks[k]),
            ]);
        }
        page.table(["a","b","c","d","e","f","g","h","i","j","k", "l", "m"], rows);
        for row in &self.power.study.alike.cosine { page.paragraph(row.iter().map(|c| format!("{c:.2}")).collect::<Vec<_>>().join(" ")); }
        for row in &self.power.study.alike.cosine_with_springs { page.paragraph(row.iter().map(|c| format!("{c:.2}")).collect::<Vec<_>>().join(" ")); }
        page
    }
}
