//! What the page says of loads that were chosen between bounds.

use hexbench_design::space::{ChosenPart, LoadRange};
use hexbench_report::{Block, number};

use super::Designed;
use super::page::wrench;

/// A sentence for each chosen load that is read.
pub(super) fn chosen_loads(plan: &Designed) -> Vec<Block> {
    let mut sentences: Vec<String> = Vec::new();
    for range in plan.space.choosing_of(&plan.visits).load_ranges {
        let sentence = sentence(&range, plan);
        if !sentences.contains(&sentence) {
            sentences.push(sentence);
        }
    }
    sentences.into_iter().map(Block::paragraph).collect()
}

fn sentence(range: &LoadRange, plan: &Designed) -> String {
    let load = &plan.space.loads[range.load].load;
    let parts: Vec<String> = range.parts.iter().zip(range.amounts(load)).map(part).collect();
    format!("The load {} is chosen: {}.", wrench(load), parts.join("; "))
}

fn part((part, amount): (&ChosenPart, f64)) -> String {
    /// Of the range: amounts come back from a wrench with its rounding.
    const SAME: f64 = 1e-9;
    let [least, largest] = part.bounds;
    let at = |bound: f64| (amount - bound).abs() <= SAME * (largest - least);
    let which = match (at(least), at(largest)) {
        (true, _) => "the least",
        (_, true) => "the largest",
        _ => "inside",
    };
    let [amount, least, largest] = [amount, least, largest].map(round);
    format!("{} {amount} {}, {which} of {least} to {largest}", part.name, part.unit)
}

/// Five digits without zeros at the end.
fn round(x: f64) -> String {
    let text = number::significant(x, 5);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
