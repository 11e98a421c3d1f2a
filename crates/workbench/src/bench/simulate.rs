//! Machines simulated on request, with effects that the user chooses or that a game hides.

use hexbench_core::files::{hexapod_to_toml, measurements_to_csv};
use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{AngleConvention, Hexapod};
use hexbench_truth::TruthError;
use hexbench_truth::campaign::{CaseKind, CaseSpec, PlanKind, SimulatedCase, machines::FAMILIES};
use hexbench_truth::mechanisms::{REGISTRY, is_outside};
use hexbench_truth::metrology::InstrumentNoise;
use rand::RngExt;
use rand_pcg::Pcg64;

use super::files::{Files, USUAL_NAMES};
use super::refusal::Refusal;
use crate::wire::{Choice, GameLevel, Hidden};

/// Largest distance that can be asked for, units of the noise: beyond it the effect is larger than the machine.
const FURTHEST: f64 = 1e4;
/// Most effects in one machine.
const MOST_EFFECTS: usize = 4;
/// Draws until one gives a campaign in which its effects show.
const ATTEMPTS: u64 = 8;
/// From this attempt on machine and plan are easy.
const EASY_ATTEMPT: u64 = 4;

/// What is in a simulated machine.
#[derive(Debug, Clone)]
pub(super) struct Truth {
    pub(super) seed: u64,
    pub(super) hidden: Vec<Hidden>,
    /// N/um.
    pub(super) leg_stiffness: [f64; 6],
    /// True in a game.
    pub(super) sealed: bool,
}

/// A machine with what was asked for.
pub(super) struct Request<'a> {
    pub(super) machine: &'a str,
    pub(super) plan: &'a str,
    pub(super) effects: &'a [String],
    pub(super) distance: Option<f64>,
    pub(super) seed: Option<u64>,
}

/// Families of machines.
pub(super) fn machines() -> Vec<Choice> {
    let title = |family: &str| match family {
        "ring_a" => "Ring, wide platform",
        "ring_b" => "Ring, small platform",
        "ring_c" => "Ring, flat",
        "random_ring" => "Ring of random size",
        "cubic" => "Cubic",
        "three_three" => "Three and three (octahedron)",
        "irregular" => "Irregular",
        _ => "",
    };
    FAMILIES.iter().map(|f| choice(f, title(f), "")).collect()
}

/// Plans.
pub(super) fn plans() -> Vec<Choice> {
    let words = |plan: PlanKind| match plan {
        PlanKind::Rich => ["Rich", "18 poses with tilts, six loads along and about all axes"],
        PlanKind::OtherLoads => ["Other loads", "As rich, with six random loads"],
        PlanKind::FewPoses => ["Few poses", "As rich, with ten poses"],
        PlanKind::VerticalOnly => ["Vertical loads", "As rich, with four loads along z"],
        PlanKind::NoReference => ["No preload", "As rich, with an unloaded reference state"],
        PlanKind::Paper => ["The paper's", "Three poses under one vertical load, three readings each"],
        PlanKind::Absolute => ["Absolute poses", "40 poses under two loads; poses instead of deflections"],
    };
    PlanKind::ALL.into_iter().map(|p| choice(p.name(), words(p)[0], words(p)[1])).collect()
}

/// Effects, in the order of the catalogue.
pub(super) fn effects() -> Vec<Choice> {
    REGISTRY.iter().map(|e| choice(e.id, e.title, e.physics)).collect()
}

fn choice(id: &str, title: &str, text: &str) -> Choice {
    Choice { id: id.to_owned(), title: title.to_owned(), text: text.to_owned() }
}

/// Measures a machine made to order.
pub(super) fn simulate(request: &Request<'_>) -> Result<(Files, Truth), Refusal> {
    let family = FAMILIES.iter().find(|f| **f == request.machine);
    let plan = PlanKind::named(request.plan);
    let effects = request.effects.iter().map(|id| effect(id)).collect::<Result<Vec<_>, _>>()?;
    check_size(request, effects.len())?;
    let seed = request.seed.unwrap_or_else(|| rand::rng().random_range(..1_000_000));
    let plan = plan.ok_or_else(|| Refusal::unknown("plan", request.plan))?;
    let spec = CaseSpec {
        id: "simulation".to_owned(),
        kind: kind(plan, &effects),
        family: family.ok_or_else(|| Refusal::unknown("machine", request.machine))?,
        plan,
        effects,
        distance: request.distance,
        noise: InstrumentNoise::default(),
        seed,
    };
    told(&spec.build()?, seed, false)
}

fn effect(id: &str) -> Result<&'static str, Refusal> {
    let known = REGISTRY.iter().find(|e| e.id == id).map(|e| e.id);
    known.ok_or_else(|| Refusal::unknown("effect", id))
}

fn check_size(request: &Request<'_>, count: usize) -> Result<(), Refusal> {
    let twice = (1..count).any(|k| request.effects[..k].contains(&request.effects[k]));
    if count > MOST_EFFECTS || twice {
        let rule = format!("a machine can have at most {MOST_EFFECTS} different effects");
        return Err(Refusal::bad_input(rule, "Choose fewer."));
    }
    match request.distance {
        Some(d) if !(d > 0.0 && d <= FURTHEST) => Err(Refusal::bad_input(
            format!("the distance {d} is not between 0 and {FURTHEST}"),
            "Choose about 10 for a clearly visible effect, 3 for a barely visible one.",
        )),
        _ => Ok(()),
    }
}

fn kind(plan: PlanKind, effects: &[&'static str]) -> CaseKind {
    match (plan, effects) {
        (PlanKind::Absolute, _) => CaseKind::Absolute,
        (_, []) => CaseKind::Clean,
        (_, all) if all.iter().any(|id| is_outside(id)) => CaseKind::Outside,
        (_, [_]) => CaseKind::Single,
        (_, [_, _]) => CaseKind::Pair,
        _ => CaseKind::Triple,
    }
}

/// Measures a machine in which something is hidden, or nothing.
pub(super) fn game(level: GameLevel, seed: Option<u64>) -> Result<(Files, Truth), Refusal> {
    let seed = seed.unwrap_or_else(|| rand::rng().random_range(..1_000_000));
    let mut rng = stream(seed, Purpose::WorkbenchGame, []);
    let kind = *choose(kinds(level), &mut rng);
    let index = rng.random_range(0..1000);
    let first = if level == GameLevel::Easy { EASY_ATTEMPT } else { 0 };
    let attempt = |n: u64| CaseSpec::draw(kind, index, seed, n, None).build();
    let made: Result<SimulatedCase, TruthError> =
        (first + 1..first + ATTEMPTS).fold(attempt(first), |made, n| made.or_else(|_| attempt(n)));
    told(&made?, seed, true)
}

fn kinds(level: GameLevel) -> &'static [CaseKind] {
    match level {
        GameLevel::Easy => &[CaseKind::Single],
        GameLevel::Hard => &[CaseKind::Single, CaseKind::Pair, CaseKind::Pair],
        GameLevel::Honest => {
            &[CaseKind::Clean, CaseKind::Single, CaseKind::Single, CaseKind::Pair, CaseKind::Outside]
        }
    }
}

fn choose<'a, T>(all: &'a [T], rng: &mut Pcg64) -> &'a T {
    &all[rng.random_range(0..all.len())]
}

/// Files and truth of a case; what a game is called does not tell what is in it.
fn told(case: &SimulatedCase, seed: u64, sealed: bool) -> Result<(Files, Truth), Refusal> {
    let title = |id: &str| {
        let known = REGISTRY.iter().find(|e| e.id == id);
        known.map_or_else(|| id.to_owned(), |e| e.title.to_owned())
    };
    let ids = case.spec.hidden_effects();
    let hidden = ids.iter().map(|id| Hidden { id: (*id).to_owned(), title: title(id) }).collect();
    let leg_stiffness = case.campaign.world.leg_stiffness_n_per_um();
    // Tables are written as poses are inside.
    let mut hexapod = Hexapod { angles: AngleConvention::default(), ..case.hexapod.clone() };
    hexapod.name = if sealed { format!("game {seed}") } else { format!("simulation {seed}") };
    let csv = |rows| {
        let mut text = Vec::new();
        let unwritten = |e: std::io::Error| Refusal::bad_input(e.to_string(), "Try another seed.");
        measurements_to_csv(&mut text, rows).map_err(unwritten)?;
        Ok::<_, Refusal>(String::from_utf8_lossy(&text).into_owned())
    };
    let files = Files {
        hexapod: hexapod_to_toml(&hexapod),
        data: csv(&case.measurements)?,
        holdout: Some(csv(&case.holdout)?),
        names: USUAL_NAMES.map(str::to_owned),
        changes: Vec::new(),
    };
    Ok((files, Truth { seed, hidden, leg_stiffness, sealed }))
}
