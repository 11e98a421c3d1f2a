//! The panels that carry the story, and where effects act, on cases with a known answer.

use std::collections::BTreeSet;

use hexbench_core::Vector3;
use hexbench_model::estimation::fit_named::{fit_named, term_named};
use hexbench_model::results::compare::acts::EffectMotion;
use hexbench_model::results::compare::association::associations;
use hexbench_model::results::compare::story::{STORY_PANELS, StoryPanel, story};
use hexbench_model::results::compare::{JudgedModel, compare};
use hexbench_model::results::diagnose::prepare;
use hexbench_model::terms::catalogue;

use crate::cases;

/// The story of the springs alone.
fn of(case: &str) -> Vec<StoryPanel> {
    let (hexapod, data, _) = cases::case(case);
    let compared = compare(&hexapod, &data, None, None).unwrap();
    let judged = JudgedModel::of(&compared.campaign, &data, &compared.point, true).unwrap();
    let panels = story(&judged, &associations(&judged));
    for panel in &panels {
        for p in &panel.points {
            let [x, per] = panel.place(&judged.lin.conditions[p.condition], p.leg).unwrap();
            let off = (x - p.x).abs().max((per - p.per).abs());
            assert!(off < 1e-12, "a point stands where its panel places it");
            let y = judged.space.elongation[p.condition][p.leg] * 1e6 / per;
            assert!((p.y - y).abs() <= 1e-12 * y.abs());
        }
    }
    panels
}

/// What the effect of a case does to base and legs under each condition.
fn acts(case: &str, term: &str) -> Vec<Option<EffectMotion>> {
    let (hexapod, data, _) = cases::case(case);
    let campaign = prepare(&hexapod, &data).unwrap();
    let added = [term_named(term, &catalogue()).unwrap()];
    let fit = fit_named(&campaign, &added).unwrap();
    let judged = JudgedModel::of(&campaign, &data, &fit.point, true).unwrap();
    (0..judged.lin.conditions.len()).map(|i| EffectMotion::of(&judged, i)).collect()
}

#[test]
fn friction_leads_with_the_approach_and_every_panel_follows_something_else() {
    let panels = of("friction");
    assert!((1..=STORY_PANELS).contains(&panels.len()), "{}", panels.len());
    assert_eq!(panels[0].association.variable, "approach");
    let variables: BTreeSet<_> = panels.iter().map(|p| p.association.variable).collect();
    assert_eq!(variables.len(), panels.len());
    assert!(panels.is_sorted_by(|a, b| a.association.p <= b.association.p));
    let [low, high] = [&panels[0].bins[0], &panels[0].bins[1]];
    let apart = (high.mean - low.mean).abs() / low.std.hypot(high.std);
    assert!(apart > 5.0, "the two directions differ by {apart} standard uncertainties");
}

#[test]
fn a_clean_machine_has_no_story() {
    assert!(of("mujoco-clean").is_empty());
}

#[test]
fn a_foundation_moves_the_base_and_friction_stretches_the_legs() {
    let foundation = acts("mujoco-foundation", "base-compliance");
    let moved = |a: &EffectMotion| a.base.iter().map(Vector3::norm).fold(0.0, f64::max);
    let largest = foundation.iter().flatten().map(moved).fold(0.0, f64::max);
    assert!((1e-7..1e-4).contains(&largest), "the base moves by {largest} m");
    assert!(foundation.iter().flatten().all(|a| a.elongation.amax() < 1e-12), "its legs stay as they are");
    let friction = acts("friction", "joint-friction");
    assert!(friction.iter().flatten().any(|a| a.elongation.amax() > 1e-7));
    assert!(friction.iter().flatten().all(|a| moved(a) < 1e-15), "its base stands still");
}
