//! The power of a plain and of a rich plan as a document.

use hexbench_core::statistics::Proportion;
use hexbench_design::power::{EffectPower, Planned, Visibility};
use hexbench_report::number::significant;
use hexbench_report::words::written_by;
use hexbench_report::{Block, Page, Section, Table};
use hexbench_truth::Scene;
use hexbench_truth::scene::{PartName, VirtualBench};

use super::faint::{Faint, faint};
use super::page::{LOOK_ALIKE, look_alikes};
use super::tables::chance;
use super::{PlanReport, Power, PowerError, PowerPlan, Simulated};
use crate::recovery::correspondence::CORRESPONDENCES;

/// A plan of a scene and its power.
pub struct Studied {
    /// Name of the scene.
    pub name: String,
    /// The plan.
    pub plan: PowerPlan,
    /// Its power.
    pub power: Power,
    /// Condition number of the spring columns at unit length.
    pub condition: f64,
    /// Effects that hide in the springs.
    pub faint: Vec<Faint>,
}

impl Studied {
    /// Puts a studied plan together.
    ///
    /// # Errors
    /// [`PowerError`].
    pub fn new(name: &str, plan: PowerPlan, power: Power) -> Result<Self, PowerError> {
        let planned = Planned::new(&plan.hexapod, &plan.rows, plan.springs(), plan.noise)?;
        let (condition, faint) = (planned.condition(), faint(&plan)?);
        Ok(Self { name: name.to_owned(), plan, power, condition, faint })
    }

    fn report(&self) -> PlanReport<'_> {
        PlanReport { plan: &self.plan, power: &self.power, only: &[], verbose: false }
    }
}

/// The training part of a scene as a plan for its machine with its true stiffnesses.
///
/// # Errors
/// [`PowerError`].
pub fn plan_of(scene: &Scene) -> Result<PowerPlan, PowerError> {
    let bench = VirtualBench::new(scene, true);
    let rows = hexbench_core::Dataset { source: scene.name.clone(), ..bench.dataset(PartName::Training)? };
    PowerPlan::new(scene.hexapod.clone(), rows, scene.leg_stiffness).ok_or(PowerError::NoNoise)
}

/// The document; `again` is the command that writes it, `charts` the folder beside it.
pub fn document(plain: &Studied, rich: &Studied, charts: &str, again: &str) -> Page {
    let both = [plain, rich];
    let differing = CORRESPONDENCES.iter().filter(|c| !c.differs.is_empty());
    Page::new("What a plan can see")
        .with(introduction())
        .with(facts(plain, rich))
        .with(agreement(&both))
        .with_all(both.iter().flat_map(|studied| one_plan(studied, charts)))
        .with(Section::new("How it is computed").list(rich.report().notes()))
        .with(
            Section::new("Where the two worlds write an effect differently")
                .list(differing.map(|c| format!("{}: {}.", c.effect, c.differs))),
        )
        .with(Section::new("Again").paragraph(format!(
            "`{again}`. For a plan of your own: `hexbench power hexapod.toml plan.csv --simulate`. The same seed gives the same \
             bytes on any number of threads."
        )))
}

fn introduction() -> Section {
    Section::lead().paragraph(written_by("hexbench validate power --markdown FILE")).paragraph(
        "Before anything is measured, a plan (poses, loads, repeats) decides which effects it can show. Two plans for the \
         same machine and the same instrument: that of the paper, and one of many poses with tilts and loads along and about \
         all axes. Every chance is computed by the linear model and then counted in the simulated world, which shares no \
         physics with it.",
    )
}

fn facts(plain: &Studied, rich: &Studied) -> Section {
    Section::new("Three facts")
        .list([well_conditioned_yet_blind(plain), rich_sees(plain, rich), never(plain, rich)])
        .table(Table::named(FAINT).rows([plain, rich].into_iter().flat_map(faint_rows)))
        .paragraph(
            "absorbed: share of the signature (its sum of squares) that other leg stiffnesses explain. distance: length of the \
             rest in standard deviations. chance: of a test made for exactly this rest, at 1 % false alarm. bias: of the leg \
             stiffness that goes most astray.",
        )
}

fn one_plan(studied: &Studied, charts: &str) -> Vec<Section> {
    let report = studied.report();
    let figure = |file: &str| format!("{charts}/{}-{file}", studied.name);
    let head = Section::new(format!("The plan `{}`", studied.name))
        .paragraph(report.subject())
        .paragraph(report.summary())
        .with(report.tolerances().map(Block::paragraph))
        .figure(figure("power.svg"), "Chance to see each effect over its size, computed and simulated");
    let body = report.seen().into_iter().chain(report.blind()).map(Section::within);
    let mut all: Vec<Section> = std::iter::once(head).chain(body).collect();
    let last = all.pop();
    all.extend(last.map(|last| {
        last.figure(figure("taken-for.svg"), "Which effect explains best what another leaves").figure(
            figure("cosine.svg"),
            "Cosines of the signatures after the springs have taken their share",
        )
    }));
    all
}

fn shown(power: &Power) -> impl Iterator<Item = &EffectPower> {
    power.study.effects.iter().filter(|e| e.parameters_determined > 0)
}

/// `1 to 61 %` of the chances to see the usual size.
fn chances(power: &Power) -> String {
    let all = || shown(power).map(|e| e.power_at_usual_size.middle);
    let (low, high) = (all().fold(1.0, f64::min), all().fold(0.0, f64::max));
    format!("{} to {}", chance(low).trim_end_matches(" %"), chance(high))
}

fn count(power: &Power, verdict: Visibility) -> usize {
    power.study.effects.iter().filter(|e| e.verdict == verdict).count()
}

/// Largest cosine of every effect with another one.
fn nearest(power: &Power) -> Vec<f64> {
    let cosine = &power.study.alike.cosine;
    let others = |k: usize| (0..cosine.len()).filter(move |&j| j != k);
    let own = |k: usize| others(k).map(|j| cosine[k][j]).fold(0.0, f64::max);
    (0..cosine.len()).filter(|&k| cosine[k][k] > 0.0).map(own).collect()
}

/// Cosine from which effects of the paper's plan count as like others.
const LIKE: f64 = 0.86;

fn well_conditioned_yet_blind(plain: &Studied) -> String {
    let power = &plain.power;
    let likeness = nearest(power);
    let alike: Vec<f64> = likeness.iter().copied().filter(|c| *c >= LIKE).collect();
    let (low, high) = (alike.iter().copied().fold(1.0, f64::min), alike.iter().copied().fold(0.0, f64::max));
    format!(
        "The plan of the paper is well conditioned, and blind. The condition number of its springs is {}; yet an effect of \
         usual size is seen in {} of the campaigns, depending on the effect: {} of {} effects are seen in nine of ten, and {} \
         leave no trace at all. What does show looks alike: {} of {} signatures have another one of cosine {low:.2} to \
         {high:.2} after the springs; {} pairs reach {LOOK_ALIKE}.",
        significant(plain.condition, 2),
        chances(power),
        count(power, Visibility::Seen),
        power.study.effects.len(),
        count(power, Visibility::NoTrace) + count(power, Visibility::Absorbed),
        alike.len(),
        likeness.len(),
        look_alikes(power).len(),
    )
}

fn rich_sees(plain: &Studied, rich: &Studied) -> String {
    let power = &rich.power;
    let half = |p: &Power| shown(p).filter(|e| e.power_at_usual_size.middle >= 0.5).count();
    let pairs = look_alikes(power);
    format!(
        "The rich plan ({} readings instead of {}, condition number {}) sees {} of {} effects at their usual size in nine of \
         ten campaigns and {} in half of them (the plain plan: {} and {}); at twice that size {}. {} left of {}{}.",
        rich.plan.rows.observations.len(),
        plain.plan.rows.observations.len(),
        significant(rich.condition, 2),
        count(power, Visibility::Seen),
        power.study.effects.len(),
        half(power),
        count(&plain.power, Visibility::Seen),
        half(&plain.power),
        shown(power).filter(|e| e.seen_at.middle <= 2.0).count(),
        if pairs.len() == 1 {
            "One pair that looks alike is".to_owned()
        } else {
            format!("{} pairs that look alike are", pairs.len())
        },
        look_alikes(&plain.power).len(),
        if pairs.is_empty() { String::new() } else { format!(": {}", pairs.join("; ")) },
    )
}

fn never(plain: &Studied, rich: &Studied) -> String {
    let absolute = rich.power.study.untestable.len();
    let blind: Vec<&str> = plain.power.study.effects.iter().filter(|e| !e.shows()).map(|e| e.term).collect();
    let hides = |s: &Studied, k: usize| s.faint[k].chance < HIDDEN_CHANCE;
    let (mut always, mut here) = (Vec::new(), Vec::new());
    for (k, f) in plain.faint.iter().enumerate() {
        match (hides(plain, k), hides(rich, k)) {
            (true, true) => always.push(f.what),
            (true, false) => {
                here.push(format!("{} (the rich plan sees it in {})", f.what, chance(rich.faint[k].chance)));
            }
            _ => {}
        }
    }
    format!(
        "Some effects never show. {absolute} of the catalogue need absolute poses; {} no trace under the loads of the paper. \
         Others are the same as springs of other stiffness: the fit takes them for stiffness, no residual tells, and the \
         stiffness is wrong by the bias. In both plans: {}. In the plan of the paper: {}.",
        if blind.is_empty() {
            "no other leaves".to_owned()
        } else {
            format!("{} leave", blind.join(" and "))
        },
        always.join("; "),
        here.join("; "),
    )
}

/// An effect that is seen less often than this hides: hardly more often than noise alone would raise an alarm.
const HIDDEN_CHANCE: f64 = 0.05;

const FAINT: [&str; 6] = ["hidden in the world", "plan", "absorbed", "distance", "chance", "bias"];

fn faint_rows(studied: &Studied) -> Vec<Vec<String>> {
    let row = |f: &Faint| {
        vec![
            f.what.to_owned(),
            studied.name.clone(),
            format!("{:.2} %", 100.0 * f.absorbed),
            format!("{:.2}", f.distance),
            chance(f.chance),
            format!("{:.1} %", f.bias_percent),
        ]
    };
    studied.faint.iter().map(row).collect()
}

/// Chance that any of the comparisons below is called a disagreement although there is none.
const FALSE_DISAGREEMENT: f64 = 0.01;

/// One simulated share beside what was computed.
struct Checked<'a> {
    plan: &'a str,
    effect: &'a EffectPower,
    computed: f64,
    simulated: &'a Simulated,
}

impl Checked<'_> {
    fn sentence(&self) -> String {
        format!(
            "{}, {}, {} times the usual size: computed {}, with the world's own signature {}, simulated {}",
            self.plan,
            self.effect.term,
            significant(self.simulated.scale, 2),
            chance(self.computed),
            chance(self.simulated.chance_by_the_world),
            chance(self.simulated.seen.rate()),
        )
    }
}

fn checked(studied: &Studied) -> Vec<Checked<'_>> {
    let wanted = studied.power.study.settings.power;
    let effects = studied.power.study.effects.iter().zip(&studied.power.checks);
    let mut all = Vec::new();
    for (effect, check) in effects {
        let of = |computed, simulated| Checked { plan: &studied.name, effect, computed, simulated };
        all.extend(check.usual.iter().map(|s| of(effect.power_at_usual_size.middle, s)));
        all.extend(check.when_seen.iter().map(|s| of(wanted, s)));
    }
    all
}

/// How well computing and counting agree, and where they do not.
fn agreement(studied: &[&Studied]) -> Option<Section> {
    let all: Vec<Checked<'_>> = studied.iter().flat_map(|s| checked(s)).collect();
    let error = FALSE_DISAGREEMENT / all.len() as f64;
    let agrees = |c: &&Checked<'_>| c.simulated.seen.is_compatible_with(c.computed, error);
    let own = |c: &&Checked<'_>| c.simulated.seen.is_compatible_with(c.simulated.chance_by_the_world, error);
    let alarms = studied.iter().flat_map(|s| &s.power.checks).filter_map(|c| c.false_alarms);
    let section = Section::new("Computed and simulated").paragraph(format!(
        "{} of {} simulated shares agree with the computed chance; {} with the chance computed with what the effect leaves \
         in the simulated world without noise. (Exact binomial bounds that let one false disagreement among all of them pass \
         with a chance of {}.) The tests raise a false alarm in {:.2} % of the campaigns without effects.",
        all.iter().filter(agrees).count(),
        all.len(),
        all.iter().filter(own).count(),
        chance(FALSE_DISAGREEMENT),
        100.0 * alarms.sum::<Proportion>().rate(),
    ));
    let off: Vec<String> = all.iter().filter(|c| !agrees(c)).map(Checked::sentence).collect();
    let section = if off.is_empty() { section } else { section.paragraph(OFF).list(off) };
    section.when(!all.is_empty())
}

const OFF: &str = "Those that disagree with the computed chance are effects so large that their signature no longer grows in \
proportion to their size, or that the two worlds write differently (see below):";
