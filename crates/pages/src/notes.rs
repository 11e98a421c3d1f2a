//! Suspect readings and warnings.

use hexbench_model::diagnose::Diagnosis;
use hexbench_report::number::significant;

use crate::text::Paper;

/// Most readings listed.
const MOST_SUSPECTS: usize = 5;

/// What to look at before trusting the numbers.
pub fn section(paper: &mut Paper, d: &Diagnosis) {
    if d.suspects.is_empty() && d.warnings.is_empty() {
        return;
    }
    paper.heading("Look at this", "");
    if !d.suspects.is_empty() {
        paper.hanging("  -", 4, &suspects(d));
    }
    for warning in &d.warnings {
        paper.hanging("  -", 4, warning);
    }
}

/// Frames and signs.
pub const CONVENTIONS: &str = "Fixed axes of the base unless a term says mobile; wrenches act on the platform at the mobile \
                                      origin; deflection = loaded minus reference; tension is positive.";

/// Frames and signs, the same on every page.
pub fn conventions(paper: &mut Paper) {
    paper.heading("Conventions", "");
    paper.paragraph(2, CONVENTIONS);
}

/// Readings far from every prediction, in a sentence.
pub fn suspects(d: &Diagnosis) -> String {
    let mut worst: Vec<_> = d.suspects.iter().collect();
    worst.sort_by(|a, b| b.z.total_cmp(&a.z));
    let listed: Vec<String> = worst
        .iter()
        .take(MOST_SUSPECTS)
        .map(|s| format!("line {} ({} sigma)", s.row, significant(s.z, 2)))
        .collect();
    let more = if worst.len() > MOST_SUSPECTS { ", ..." } else { "" };
    let count = worst.len();
    let noun = if count == 1 { "reading is" } else { "readings are" };
    format!("{count} {noun} far from every prediction; nothing was left out: {}{more}", listed.join(", "))
}
