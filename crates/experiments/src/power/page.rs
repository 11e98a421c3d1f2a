//! The power of one plan on a page.

use std::collections::{BTreeMap, BTreeSet};

use hexbench_core::statistics::median;
use hexbench_core::words::upper_first;
use hexbench_design::power::{EffectPower, NOTHING, Visibility};
use hexbench_model::effects::untestable::Reason;
use hexbench_model::estimation::noise::NoiseSource;
use hexbench_report::number::{counted, significant};
use hexbench_report::{Block, Page, Section, Table};

use super::tables::{self, chance};
use super::{Power, PowerPlan};

/// Cosine beyond which signatures count as alike.
pub(super) const LOOK_ALIKE: f64 = 0.95;

/// What is told.
pub struct PlanReport<'a> {
    /// The plan.
    pub plan: &'a PowerPlan,
    /// Its power.
    pub power: &'a Power,
    /// Ids of the effects to tell; all when empty.
    pub only: &'a [String],
    /// Every parameter.
    pub verbose: bool,
}

impl PlanReport<'_> {
    /// The page.
    pub fn document(&self) -> Page {
        Page::new("What this plan can detect")
            .with(self.lead())
            .with_all(self.seen())
            .with(self.blind())
            .with(Section::new("How it is computed").list(self.notes()))
    }

    fn lead(&self) -> Section {
        let tolerances = self.tolerances().map(Block::paragraph);
        Section::lead().paragraph(self.subject()).paragraph(self.summary()).with(tolerances)
    }

    /// How well inputs are assumed to be known, and what that costs; none where they count as exact.
    pub(super) fn tolerances(&self) -> Option<String> {
        let assumed = self.power.study.tolerances?;
        let mut growth = self.power.study.growth_by_tolerances();
        growth.retain(|(term, _)| self.is_shown(term));
        growth.sort_by(|a, b| a.1.total_cmp(&b.1));
        let times = |x: f64| format!("x{}", significant(x, 3));
        let cost = match growth[..] {
            [] => return Some(format!("Tolerances: {assumed}.")),
            [(_, only)] => times(only),
            _ => {
                let (term, most) = growth[growth.len() - 1];
                let usual = median(growth.iter().map(|g| g.1)).unwrap_or(most);
                format!("{} in the median, {} for {term},", times(usual), times(most))
            }
        };
        Some(format!(
            "Tolerances: {assumed}; the smallest detectable size is {cost} of what exact inputs would give."
        ))
    }

    /// Tables of the effects that leave something beside the springs.
    pub(super) fn seen(&self) -> Vec<Section> {
        if !self.shown().any(|(_, e)| leaves_something(e)) {
            return Vec::new();
        }
        let sizes = Table::named(tables::SIZES).rows(self.each(tables::sizes));
        let tested = "all numbers of an effect together, beside springs (`hexbench check`: each by itself)";
        let smallest = Section::new("Smallest detectable size").remark(tested).table(sizes);
        let mut all = vec![smallest, self.springs(), self.taken_for()];
        all.extend(self.checks());
        if self.verbose {
            let rows = self.shown().flat_map(|(_, e)| tables::parameters(e));
            all.push(
                Section::new("Every parameter alone").table(Table::named(tables::PARAMETERS).rows(rows)),
            );
        }
        all
    }

    /// What "seen" means, and of what noise.
    pub fn assumptions(&self) -> String {
        let settings = &self.power.study.settings;
        format!(
            "\"Detectable\" means with {} power at a false-alarm rate of {}; `hexbench power` says more.",
            chance(settings.power),
            chance(settings.alarm),
        )
    }

    fn springs(&self) -> Section {
        Section::new("What the springs absorb")
            .paragraph(
                "absorbed: share of the signature (its sum of squares) that other leg stiffnesses explain. bias: largest error of a \
                 leg stiffness when the effect is omitted, at the usual size and at the smallest detectable size.",
            )
            .table(Table::named(tables::SPRINGS).rows(self.each(tables::springs)))
    }

    fn shown(&self) -> impl Iterator<Item = (usize, &EffectPower)> {
        self.power.study.effects.iter().enumerate().filter(|(_, e)| self.is_shown(e.term))
    }

    fn is_shown(&self, term: &str) -> bool {
        self.only.is_empty() || self.only.iter().any(|id| id == term)
    }

    fn each(&self, row: fn(&EffectPower) -> Vec<String>) -> Vec<Vec<String>> {
        self.shown().filter(|(_, e)| leaves_something(e)).map(|(_, e)| row(e)).collect()
    }

    /// What is read, how well, of what machine.
    pub(super) fn subject(&self) -> String {
        let rows: BTreeSet<(i64, i64, u64)> =
            self.plan.rows.observations.iter().map(|o| (o.pose_id, o.repeat, o.line)).collect();
        let several = self.plan.rows.blocks.len() > 1;
        let readings = if several { rows.len() } else { self.plan.rows.observations.len() };
        let poses = rows.iter().map(|o| o.0).collect::<BTreeSet<_>>().len();
        let stiffness = self.plan.stiffness.iter().sum::<f64>() / 6.0 * 1e-6;
        let settings = &self.power.study.settings;
        format!(
            "{readings} readings of {} at {} for {}; {}; legs of {} N/um. \"Detectable\" means with {} power at a \
             false-alarm rate of {}.",
            self.plan.rows.measurand.readings(),
            counted(poses, "pose"),
            self.plan.hexapod.name,
            self.noise(),
            significant(stiffness, 2),
            chance(settings.power),
            chance(settings.alarm),
        )
    }

    /// How well is read.
    fn noise(&self) -> String {
        let noise = &self.plan.noise;
        if noise.source == NoiseSource::Sensors {
            let names: Vec<&str> = self.plan.hexapod.sensors.iter().map(|s| s.name.as_str()).collect();
            return format!("each number is as accurate as its sensor states ({})", names.join(", "));
        }
        format!(
            "one reading has a standard deviation of {} um and {} urad ({})",
            significant(noise.translation * 1e6, 2),
            significant(noise.rotation * 1e6, 2),
            source(noise.source),
        )
    }

    /// The answer in some sentences.
    pub(super) fn summary(&self) -> String {
        let all: Vec<&EffectPower> = self.shown().map(|(_, e)| e).collect();
        let mut sentences = vec![match all[..] {
            [] => "This plan cannot test any of these effects.".to_owned(),
            [one] => self.sentence(one),
            _ => counts(&all),
        }];
        let wrong = self.wrongly_taken();
        if !wrong.is_empty() {
            sentences.push(wrong.join("; ") + ".");
        }
        sentences.extend(self.most_absorbed().map(|worst| {
            format!(
                "The springs absorb {} of {}: omitting it at its usual size biases a leg stiffness by {} %.",
                chance(worst.absorbed),
                worst.term,
                significant(tables::largest(&worst.bias_at_usual_size_percent).abs(), 2)
            )
        }));
        sentences.join(" ")
    }

    fn sentence(&self, e: &EffectPower) -> String {
        let Some(size) = e.size_seen() else {
            return format!("This plan never detects {}.", e.term);
        };
        format!(
            "This plan detects {} of usual size ({} {}) in {} of campaigns, and of {} {} or more in {}.",
            e.term,
            significant(e.usual_size, 2),
            e.unit,
            chance(e.power_at_usual_size.middle),
            significant(size, 2),
            e.unit,
            chance(self.power.study.settings.power),
        )
    }

    /// Effects whose best explanation is mostly another effect.
    fn wrongly_taken(&self) -> Vec<String> {
        let alike = &self.power.study.alike;
        let sentence = |(k, e): (usize, &EffectPower)| {
            let own = *alike.taken_for[k].get(k)?;
            let (other, share) = alike.mistaken(k).into_iter().find(|(name, _)| *name != NOTHING)?;
            (share > own).then(|| format!("{} would be mistaken for {other} ({})", e.term, chance(share)))
        };
        self.shown().filter_map(sentence).collect()
    }

    fn most_absorbed(&self) -> Option<&EffectPower> {
        let bias = |e: &EffectPower| tables::largest(&e.bias_at_usual_size_percent).abs();
        self.shown().map(|(_, e)| e).filter(|e| bias(e) > 0.5).max_by(|a, b| bias(a).total_cmp(&bias(b)))
    }

    fn taken_for(&self) -> Section {
        let alike = &self.power.study.alike;
        let rows = self.shown().filter(|(_, e)| e.shows()).map(|(k, e)| tables::taken_for(alike, k, e));
        let pairs = look_alikes(self.power);
        Section::new("What it would be mistaken for")
.paragraph("Of 100 campaigns with the effect at its smallest detectable size, how often the best explanation is the \
             effect itself, springs alone, or another effect, by the evidence of the diagnosis with at most one effect.")
.table(Table::named(tables::TAKEN_FOR).rows(rows))
.paragraph(if pairs.is_empty() {
            format!("No two signatures look alike once the springs are fitted (cosine of {LOOK_ALIKE} or more).")
        } else {
            format!("Look-alikes once the springs are fitted (cosine of {LOOK_ALIKE} or more): {}.", pairs.join("; "))
        })
    }

    fn checks(&self) -> Vec<Section> {
        let n = self.power.simulation.campaigns;
        if n == 0 {
            return Vec::new();
        }
        let wanted = self.power.study.settings.power;
        let both = |(k, e)| tables::check(e, &self.power.checks[k], wanted);
        let mut all = vec![
            Section::new("The same in the simulated world")
                .paragraph(format!(
                    "{n} campaigns for every effect and size, at finite deflection, with the effects as the simulated world has them. \
                     Computed and simulated chance, percent, with exact 95 % bounds; \"world\" is the chance computed with what \
                     the effect leaves in the simulated world without noise; false alarms come from campaigns without effects."
                ))
                .table(Table::named(tables::CHECK).rows(self.shown().flat_map(both))),
        ];
        all.extend(self.answers());
        let lost = |(k, e): (usize, &EffectPower)| {
            Some(format!("{}: {}", e.term, self.power.checks[k].why_not.as_ref()?))
        };
        let lost: Vec<String> = self.shown().filter_map(lost).collect();
        if !lost.is_empty() {
            let last = all.pop();
            all.extend(last.map(|last| last.paragraph("Not simulated:").list(lost)));
        }
        all
    }

    fn answers(&self) -> Option<Section> {
        let answers = |(k, e): (usize, &EffectPower)| tables::answers(e, &self.power.checks[k]);
        let rows: Vec<Vec<String>> = self.shown().filter_map(answers).collect();
        let asked = !rows.is_empty();
        Section::new("What the whole diagnosis says")
            .paragraph(
                "The same campaigns with the effect at its smallest detectable size, percent. right: it alone is named. among: \
                 ambiguous, with it among the candidates kept. adequate: springs alone. wrong: another name, or \"outside\". \
                 The diagnosis names an effect only from 95 % probability on, which takes more than a test does.",
            )
            .table(Table::named(tables::ANSWERS).rows(rows))
            .when(asked)
    }

    /// Effects that are never seen, by the reason.
    pub fn blind(&self) -> Option<Section> {
        let mut reasons: BTreeMap<String, Vec<&str>> = BTreeMap::new();
        for (_, e) in self.shown() {
            if let Some(why) = why_never(e) {
                reasons.entry(why).or_default().push(e.term);
            }
        }
        for u in self.power.study.untestable.iter().filter(|u| self.is_shown(u.term)) {
            reasons.entry(untestable(&u.why)).or_default().push(u.term);
        }
        let lines = reasons.iter().map(|(why, terms)| format!("{why}: {}.", terms.join(", ")));
        Section::new("Not detectable with this plan").list(lines).unless_empty()
    }

    /// What a reader should know about the figures.
    pub(super) fn notes(&self) -> Vec<String> {
        let mut notes = vec![
            "The test statistic of an effect is the drop of chi-square when its determined parameters join the six springs: \
             chi-square with as many degrees of freedom, noncentral when the effect is present."
                .to_owned(),
            "Usual sizes are those of the simulated world: the median over 33 directions and shapes, with the range over all. \
             For your own terms: their natural size, at every shape."
                .to_owned(),
            "The size is the root mean square of the parameters in the unit shown. Sizes above twice the natural size for \
             machine and plan are not plausible and count as not detectable."
                .to_owned(),
            "A shape (exponent, time constant, friction force) is not known beforehand: the best of a grid counts, and a \
             simulation raises the threshold until noise alone passes it only at the false-alarm rate."
                .to_owned(),
        ];
        if self.power.study.tolerances.is_some() {
            notes.push(
                "Joints, loads and axes are known only to their [tolerances]: as in the diagnosis, a change that such an error could \
                 cause does not count as detected; simulated campaigns have inputs with errors of that size."
                    .to_owned(),
            );
        }
        if self.plan.noise.source == NoiseSource::Repeats {
            notes.push(format!(
                "The noise is estimated from the repeats ({:.0} degrees of freedom): F instead of chi-square.",
                self.plan.noise.dof
            ));
        }
        notes.push(format!("Seed {}.", self.power.study.settings.seed));
        notes
    }
}

fn counts(all: &[&EffectPower]) -> String {
    let count = |wanted: Visibility| all.iter().filter(|e| e.verdict == wanted).count();
    let (seen, larger) = (count(Visibility::Seen), count(Visibility::SeenWhenLarger));
    format!(
        "This plan detects {seen} of {} effects at their usual size, {larger} only if larger than usual, {} never.",
        all.len(),
        all.len() - seen - larger
    )
}

/// True for effects of which springs leave something at all.
fn leaves_something(e: &EffectPower) -> bool {
    !matches!(e.verdict, Visibility::NoTrace | Visibility::Absorbed)
}

/// Pairs of effects whose signatures are alike.
pub(super) fn look_alikes(power: &Power) -> Vec<String> {
    let alike = &power.study.alike;
    let n = alike.terms.len();
    let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| (i, j)));
    let like = pairs.filter(|&(i, j)| alike.cosine[i][j] >= LOOK_ALIKE);
    like.map(|(i, j)| format!("{} and {}", alike.terms[i], alike.terms[j])).collect()
}

fn why_never(e: &EffectPower) -> Option<String> {
    match e.verdict {
        Visibility::Seen | Visibility::SeenWhenLarger => None,
        Visibility::TooFaint => Some("No plausible size is detectable".to_owned()),
        Visibility::Absorbed => Some("The springs absorb it completely".to_owned()),
        Visibility::NoTrace => Some("It leaves no trace at these poses and loads".to_owned()),
    }
}

fn untestable(why: &Reason) -> String {
    if *why == Reason::OnlyAbsolutePoses {
        return "It needs absolute poses, not deflections".to_owned();
    }
    upper_first(&why.to_string())
}

fn source(source: NoiseSource) -> &'static str {
    match source {
        NoiseSource::Columns => "sigma columns of the plan",
        NoiseSource::Metrology | NoiseSource::Sensors => "as stated",
        NoiseSource::Repeats => "to be estimated from repeats",
        NoiseSource::Residuals => "unknown",
    }
}
