//! The words of an answer about plans.

use hexbench_report::number::counted;

use super::plans::{AskedPlan, AskedPlans, Meets, cell};
use crate::keys::HiddenEffect;
use crate::keys::sizes::FACTOR;
use crate::sized::SIZE_UNITS;
use crate::sweep::cells::{AxisLevels, GridCell};
use crate::sweep::cost::PlanCost;
use crate::sweep::question::Question;
use crate::sweep::results::Counted;
use crate::sweep::study::SweepStudy;

/// What the plans of a group come to.
pub(super) fn of(study: &SweepStudy, question: Question, group: &AskedPlans) -> String {
    let Some(first) = group.plans.first() else { return String::new() };
    let answer = Words { study, question }.answer(group);
    match given(study, &cell(study, first)) {
        Some(given) => format!("{given}: {answer}"),
        None => answer,
    }
}

struct Words<'a> {
    study: &'a SweepStudy,
    question: Question,
}

impl Words<'_> {
    fn answer(&self, group: &AskedPlans) -> String {
        let Some(cheapest) = group.cheapest() else { return self.none_does(group) };
        let mut said = format!(
            "{}: of {} plans the cheapest that is sure to {}{}.",
            self.does(cheapest),
            group.plans.len(),
            self.wanted(),
            cost(cheapest.cost),
        );
        // Plans are in the order of their cost.
        let mut cheaper = group.plans.iter().take_while(|plan| plan.cell != cheapest.cell);
        if let Some(open) = cheaper.find(|plan| plan.meets == Meets::Maybe) {
            said += &self.maybe(open);
        }
        said
    }

    fn none_does(&self, group: &AskedPlans) -> String {
        let sign = if matches!(self.question, Question::Share(..)) { 1.0 } else { -1.0 };
        let Some(best) = group.best(sign) else { return "no plan has an answer.".to_owned() };
        let none = format!("none of {} plans is sure to {}", group.plans.len(), self.wanted());
        let said = format!("{none}. The best: {}{}.", self.does(best), cost(best.cost));
        let open = group.open().filter(|open| open.cell != best.cell);
        said + &open.map(|open| self.maybe(open)).unwrap_or_default()
    }

    fn maybe(&self, open: &AskedPlan) -> String {
        format!(" {} may: {}{}.", choice(self.study, open), self.found(open), cost(open.cost))
    }

    /// What a plan does, with its bounds.
    fn does(&self, plan: &AskedPlan) -> String {
        let cell = cell(self.study, plan);
        let one = cell.poses().is_none() && cell.repeats().is_none();
        let verb = match (self.question, one) {
            (Question::Share(Counted::Seen, _), true) => "sees it with",
            (Question::Share(Counted::Seen, _), false) => "see it with",
            (Question::Share(..), true) => "names it with",
            (Question::Share(..), false) => "name it with",
            (_, true) => "leaves a stiffness error of",
            (_, false) => "leave a stiffness error of",
        };
        format!("{} {verb} {}", choice(self.study, plan), self.found(plan))
    }

    fn wanted(&self) -> String {
        match self.question {
            Question::Share(Counted::Seen, least) => format!("see it with {} % or more", percent(least)),
            Question::Share(_, least) => format!("name it with {} % or more", percent(least)),
            Question::Error(most) => format!("leave {most} % or less"),
            Question::Index => String::new(),
        }
    }

    fn found(&self, plan: &AskedPlan) -> String {
        let [value, low, high] = plan.found;
        match self.question {
            Question::Share(..) => format!("{} % ({} to {} %)", percent(value), percent(low), percent(high)),
            _ => format!("{value:.2} % ({low:.2} to {high:.2} %)"),
        }
    }
}

fn percent(share: f64) -> String {
    format!("{:.0}", 100.0 * share)
}

/// Readings and hours in brackets.
fn cost(cost: Option<PlanCost>) -> String {
    match cost {
        None => String::new(),
        Some(PlanCost { readings, hours: None }) => format!(" ({readings} readings)"),
        Some(PlanCost { readings, hours: Some(hours) }) => format!(" ({readings} readings, {hours:.1} h)"),
    }
}

/// What a plan is: poses and repeats, and what else is chosen.
pub(super) fn choice(study: &SweepStudy, plan: &AskedPlan) -> String {
    chosen(study, &cell(study, plan))
}

/// The same of a cell.
pub(super) fn chosen(study: &SweepStudy, cell: &GridCell<'_>) -> String {
    let [_, plans, _, _, estimators, ..] = study.axes.levels();
    let numbers: Vec<String> = [(cell.poses(), "pose"), (cell.repeats(), "repeat")]
        .into_iter()
        .filter_map(|(n, one)| n.map(|n| counted(n, one)))
        .collect();
    let plan = cell.plan().name.as_str();
    let of_plan = match (numbers.as_slice(), plans.varies()) {
        ([], _) => format!("plan {plan}"),
        (numbers, true) => format!("{} of plan {plan}", numbers.join(" x ")),
        (numbers, false) => numbers.join(" x "),
    };
    if estimators.varies() {
        return format!("{of_plan}, estimator {}", cell.estimator().name());
    }
    of_plan
}

/// What is given: effect, size, noise, and the machine where there are several; none of all that.
pub(super) fn given(study: &SweepStudy, cell: &GridCell<'_>) -> Option<String> {
    let levels = study.axes.levels();
    let value = |axis: usize| levels[axis].levels[cell.position[axis]].text();
    let said = |axis: &AxisLevels| axis.given && (axis.varies() || !axis.name.starts_with("noise_scale"));
    let mut parts = Vec::new();
    if !cell.effects().is_empty() {
        parts.push(effects(cell.effects(), &levels[6], &value(6)));
    }
    if said(&levels[7]) {
        let noise = value(7);
        parts.push(if levels[7].name == "noise_scale" {
            format!("{noise} times the noise")
        } else {
            format!("noise of {noise}")
        });
    }
    if levels[8].given {
        parts.push(format!("laboratory {}", value(8)));
    }
    if levels[9].given {
        parts.push(format!("{} times the tolerances", value(9)));
    }
    if levels[0].varies() {
        parts.push(value(0));
    }
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// The hidden effects with their sizes.
fn effects(hidden: &[HiddenEffect], axis: &AxisLevels, value: &str) -> String {
    let one = |effect: &HiddenEffect| match effect.size {
        Some(size) => format!("{} of {}", effect.id, size.text()),
        None if effect.has_size() => "a law of your own".to_owned(),
        None => effect.id.to_owned(),
    };
    let named = hidden.iter().map(one).collect::<Vec<_>>().join(" and ");
    let each = if hidden.len() > 1 { ", each" } else { "" };
    match (hidden.iter().any(HiddenEffect::has_size), axis.given) {
        (true, true) if axis.name == FACTOR => format!("{named}{each} times {value}"),
        (true, false) if hidden.iter().all(HiddenEffect::has_size) => named,
        (true, false) => format!("{named}, the others{}", size(axis, value)),
        _ => format!("{named}{each}{}", size(axis, value)),
    }
}

fn size(axis: &AxisLevels, value: &str) -> String {
    let unit = SIZE_UNITS.iter().find(|unit| unit.key == axis.name);
    match (axis.given, unit, axis.name) {
        (false, ..) => " of its usual size".to_owned(),
        (_, Some(unit), _) => format!(" of {value} {}", unit.unit),
        (.., "size_sigmas") => format!(" of {value} sigmas"),
        _ => format!(" of {value} times its usual size"),
    }
}
