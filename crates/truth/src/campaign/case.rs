//! One case: a hidden truth and the measurements made of it.

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Hexapod, Vector6};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64;
use serde_json::{Map, Value, json};

use super::fault::Work;
use super::{MeasurementPlan, PlanKind, PlanRow, SimulatedCampaign, Yardstick, machines, pick, rms};
use crate::{
    Mechanism, TruthError, World, laboratory,
    mechanisms::{self, REGISTRY, Shows},
    metrology::{InstrumentFrames, InstrumentNoise},
};

/// Kinds of cases, named as in the truth files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum CaseKind {
    /// One effect of the catalogue.
    Single,
    /// Two effects of the catalogue.
    Pair,
    /// One effect outside the catalogue.
    Outside,
    /// No effect.
    Clean,
    /// One effect, measured by the paper's protocol.
    SeedProtocol,
    /// Absolute poses: joint geometry, alone or with one effect more.
    Absolute,
    /// A base or plate that yields as a full 6x6 compliance: in the catalogue, of a form richer than its own.
    RichForm,
    /// Three effects of the catalogue.
    Triple,
}

hexbench_core::worded! {
    /// Name in the truth file.
    CaseKind::name {
        Single => "single",
        Pair => "pair",
        Outside => "outside",
        Clean => "clean",
        SeedProtocol => "seed-protocol",
        Absolute => "absolute",
        RichForm => "rich-form",
        Triple => "triple",
    }
}

impl CaseKind {
    /// Usual distance of each effect.
    pub fn usual_distance(self) -> f64 {
        match self {
            Self::Outside => 45.0,
            Self::SeedProtocol => 12.0,
            _ => 22.0,
        }
    }
}

/// Everything that decides a case.
#[derive(Debug, Clone, PartialEq)]
pub struct CaseSpec {
    /// Name of its folder.
    pub id: String,
    /// Its kind.
    pub kind: CaseKind,
    /// Family of the machine, one of [`machines::FAMILIES`].
    pub family: &'static str,
    /// Make of the plan.
    pub plan: PlanKind,
    /// Ids of the effects in [`REGISTRY`].
    pub effects: Vec<&'static str>,
    /// Distance to which each effect is scaled; none: usual size.
    pub distance: Option<f64>,
    /// Noise of the instrument.
    pub noise: InstrumentNoise,
    /// Decides all that is drawn: machine, plan, shape of the effects, noise.
    pub seed: u64,
}

/// A case ready to be written.
#[derive(Debug)]
pub struct SimulatedCase {
    /// What was asked for.
    pub spec: CaseSpec,
    /// The world with its effects, and the instrument.
    pub campaign: SimulatedCampaign,
    /// Nominal machine as the file describes it.
    pub hexapod: Hexapod,
    /// Measurements to learn from.
    pub measurements: Dataset,
    /// Measurements to judge by.
    pub holdout: Dataset,
    /// The sealed truth.
    pub truth: Value,
}

impl SimulatedCase {
    /// The held-out readings as an ideal instrument reads them.
    ///
    /// # Errors
    /// As [`SimulatedCampaign::ideal`].
    pub fn ideal_holdout(&self) -> Result<Dataset, TruthError> {
        let mut exact = self.holdout.clone();
        let rows: Vec<PlanRow> = exact.observations.iter().map(PlanRow::from).collect();
        let ideal = self.campaign.ideal(&rows, exact.measurand)?;
        exact.observations.iter_mut().zip(ideal).for_each(|(o, reading)| o.measured = reading.into());
        Ok(exact)
    }
}

impl CaseSpec {
    /// The `index`-th case of a kind, drawn from a seed; another `attempt` keeps the effect and changes the rest.
    pub fn draw(kind: CaseKind, index: usize, seed: u64, attempt: u64, distance: Option<[f64; 2]>) -> Self {
        const PATIENCE: u64 = 4;
        let mut fixed = stream(seed, Purpose::CaseEffects, [kind as u64, index as u64]);
        let easy = attempt >= PATIENCE;
        // Legs neither pull nor reverse under the paper's loads: what needs that gives way to the next effect.
        let hopeless = usize::from(kind == CaseKind::SeedProtocol && easy) * 2;
        let effects = draw_effects(kind, index + hopeless, &mut fixed);
        let mut rng = stream(seed, Purpose::CaseSpec, [kind as u64, index as u64, attempt]);
        Self {
            id: format!("{}-{index:04}", kind.name()),
            kind,
            family: draw_family(kind, easy, &mut rng),
            plan: draw_plan(kind, easy, &mut rng),
            effects,
            distance: (kind != CaseKind::Absolute && kind != CaseKind::Clean).then(|| match distance {
                Some([low, high]) if low < high => rng.random_range(low.ln()..high.ln()).exp(),
                Some([low, _]) => low,
                None => kind.usual_distance(),
            }),
            noise: InstrumentNoise::default(),
            seed: u64::from(rng.random::<u32>()),
        }
    }

    /// Builds and measures the case.
    ///
    /// # Errors
    /// [`TruthError::NotVisible`] when an effect does not show in this plan; else as [`World::reading`].
    pub fn build(&self) -> Result<SimulatedCase, TruthError> {
        self.build_in(&laboratory::CAREFUL)
    }

    /// Builds the case and has it measured by a laboratory.
    ///
    /// # Errors
    /// As [`CaseSpec::build`].
    pub fn build_in(&self, laboratory: &laboratory::FaultEntry) -> Result<SimulatedCase, TruthError> {
        self.build_with(laboratory, &|place, hexapod, rng| {
            Ok(((mechanisms::effect(self.effects[place])?.draw)(hexapod, rng), None))
        })
    }

    /// The same with effects that somebody else makes.
    ///
    /// # Errors
    /// As [`CaseSpec::build`]; [`TruthError::TooLarge`].
    pub fn build_with(
        &self,
        laboratory: &laboratory::FaultEntry,
        effects: &EffectOf<'_>,
    ) -> Result<SimulatedCase, TruthError> {
        let of = |purpose| stream(self.seed, purpose, []);
        let (mut of_machine, mut of_plan) = (of(Purpose::CaseMachine), of(Purpose::CasePlan));
        let (mut of_effects, mut of_frames) = (of(Purpose::CaseEffectShapes), of(Purpose::CaseFrames));
        let mut hexapod = machines::draw(self.family, &mut of_machine);
        hexapod.metrology = Some(self.noise.metrology());
        let stiffness = machines::leg_stiffness(self.family, &mut of_machine);
        let plan = self.plan.draw(&hexapod, &mut of_plan);
        let frames = if self.plan == PlanKind::Absolute {
            InstrumentFrames::aligned(&mut of_frames)
        } else {
            InstrumentFrames::default()
        };
        let bare =
            SimulatedCampaign { world: World::new(hexapod.clone(), &stiffness), frames, noise: self.noise };
        let sized = self.sized_effects((&bare, &plan), effects, &mut of_effects)?;
        let truth = self.truth(&bare, &plan, &sized)?;
        let mut world = bare.world.without_effects();
        world.mechanisms = sized.mechanisms;
        let mut case = Work { laboratory, seed: self.seed, campaign: SimulatedCampaign { world, ..bare } };
        case.alter();
        let [measurements, holdout] = case.measure(&plan)?;
        hexapod.metrology = Some(case.stated());
        Ok(SimulatedCase {
            spec: self.clone(),
            campaign: case.campaign,
            hexapod,
            measurements,
            holdout,
            truth,
        })
    }

    fn sized_effects(
        &self,
        (bare, plan): (&SimulatedCampaign, &MeasurementPlan),
        effects: &EffectOf<'_>,
        rng: &mut Pcg64,
    ) -> Result<SizedEffects, TruthError> {
        const SPREAD_OF_SIZE: f64 = 0.4;
        let yardstick = Yardstick::new(bare, &plan.training, plan.measurand)?;
        let mut sized = SizedEffects { mechanisms: Vec::new(), scales: Vec::new(), distance: 0.0 };
        for place in 0..self.effects.len() {
            let (made, factor) = effects(place, &bare.world.hexapod, rng)?;
            let scale = match (factor, self.distance) {
                (Some(factor), _) => factor,
                (None, Some(wanted)) => yardstick.scale_to(&*made, wanted)?.0,
                (None, None) if place == 0 => 1.0,
                (None, None) => (SPREAD_OF_SIZE * normal(rng)).exp(),
            };
            sized.scales.push(scale);
            sized.mechanisms.push(resized(&*made, Some(scale))?);
        }
        if !sized.mechanisms.is_empty() {
            sized.distance = yardstick.distance(sized.mechanisms.iter().map(|m| m.scaled(1.0)).collect())?;
        }
        Ok(sized)
    }

    fn truth(
        &self,
        bare: &SimulatedCampaign,
        plan: &MeasurementPlan,
        sized: &SizedEffects,
    ) -> Result<Value, TruthError> {
        let mut parameters = Map::new();
        for mechanism in &sized.mechanisms {
            parameters.extend(mechanism.parameters());
        }
        let added = |rows: &[PlanRow]| -> Result<[f64; 2], TruthError> {
            let yardstick = Yardstick::of_signatures(bare, rows, plan.measurand)?;
            let all = sized.mechanisms.iter().map(|m| m.scaled(1.0)).collect();
            let signature: Vec<Vector6> = yardstick.signature(all)?;
            let (translation, rotation) = rms(&signature);
            Ok([translation * 1e6, rotation * 1e6])
        };
        Ok(json!({
            "id": self.id,
            "kind": self.kind.name(),
            "effects": self.hidden_effects(),
            "scale": sized.scales,
            "parameters": parameters,
            "distance": sized.distance,
            "geometry": self.family,
            "plan": self.plan.name(),
            "seed": self.seed,
            "leg_stiffness_N_per_um": bare.world.leg_stiffness_n_per_um(),
            "noise": [self.noise.sigma_translation * 1e6, self.noise.sigma_rotation * 1e6],
            "repeats": plan.training.iter().map(|r| r.repeat).max(),
            "raw_effect_rms": added(&plan.training)?,
            "holdout_effect_rms": added(&plan.holdout)?,
            "metrology_frame": bare.frames.metrology.to_array(),
            "target_frame": bare.frames.target.to_array(),
        }))
    }

    /// Ids of the effects as the catalogue calls them; those it lacks begin with `out:`.
    pub fn hidden_effects(&self) -> Vec<&'static str> {
        self.effects.iter().map(|id| self.catalogue_id(id)).collect()
    }

    fn catalogue_id(&self, id: &'static str) -> &'static str {
        match (self.kind, id) {
            (CaseKind::RichForm, "out:base-bending") => "base-compliance",
            (CaseKind::RichForm, "out:plate-bending") => "platform-compliance",
            _ => id,
        }
    }
}

/// Makes the effect at a place of the list on a machine, and says by how much it is scaled; none: to the distance of the case.
pub type EffectOf<'a> =
    dyn Fn(usize, &Hexapod, &mut Pcg64) -> Result<(Box<dyn Mechanism>, Option<f64>), TruthError> + 'a;

/// An effect so many times as large; none for a size that it cannot have.
///
/// # Errors
/// [`TruthError::TooLarge`].
pub fn resized(effect: &dyn Mechanism, factor: Option<f64>) -> Result<Box<dyn Mechanism>, TruthError> {
    let factor = factor.filter(|factor| *factor <= effect.largest_factor());
    let factor = factor.ok_or_else(|| TruthError::TooLarge { id: effect.id().to_owned() })?;
    Ok(effect.scaled(factor))
}

struct SizedEffects {
    mechanisms: Vec<Box<dyn Mechanism>>,
    scales: Vec<f64>,
    distance: f64,
}

fn normal(rng: &mut Pcg64) -> f64 {
    StandardNormal.sample(rng)
}

/// Ids that show in a mode, in the order of the catalogue.
fn showing(shows: Shows) -> Vec<&'static str> {
    REGISTRY.iter().filter(|e| e.shows == shows).map(|e| e.id).collect()
}

const BENDING: [&str; 2] = ["out:base-bending", "out:plate-bending"];

fn draw_effects(kind: CaseKind, index: usize, rng: &mut Pcg64) -> Vec<&'static str> {
    let deflection = showing(Shows::Deflection);
    match kind {
        CaseKind::Clean => Vec::new(),
        CaseKind::Single | CaseKind::SeedProtocol => vec![deflection[index % deflection.len()]],
        CaseKind::Pair => {
            let first = rng.random_range(0..deflection.len());
            let second = (first + rng.random_range(1..deflection.len())) % deflection.len();
            vec![deflection[first.min(second)], deflection[first.max(second)]]
        }
        CaseKind::Triple => {
            let chosen = rand::seq::index::sample(rng, deflection.len(), 3);
            let mut places = chosen.into_vec();
            places.sort_unstable();
            places.into_iter().map(|k| deflection[k]).collect()
        }
        CaseKind::Outside => {
            let outside: Vec<_> =
                showing(Shows::Outside).into_iter().filter(|id| !BENDING.contains(id)).collect();
            vec![outside[index % outside.len()]]
        }
        CaseKind::RichForm => vec![BENDING[index % 2]],
        CaseKind::Absolute => absolute_effects(index),
    }
}

fn absolute_effects(index: usize) -> Vec<&'static str> {
    let second = [
        None,
        Some("leg-offset"),
        Some("actuator-scale"),
        Some("actuator-pitch"),
        Some("leg-weight"),
        Some("base-compliance"),
    ];
    std::iter::once("joint-geometry").chain(second[index % second.len()]).collect()
}

fn draw_family(kind: CaseKind, easy: bool, rng: &mut Pcg64) -> &'static str {
    let (rings, others) = machines::FAMILIES.split_at(3);
    match kind {
        _ if easy => "ring_a",
        CaseKind::SeedProtocol => pick(rng, rings),
        _ if rng.random_bool(0.5) => pick(rng, rings),
        _ => pick(rng, others),
    }
}

fn draw_plan(kind: CaseKind, easy: bool, rng: &mut Pcg64) -> PlanKind {
    const VARIANTS: [PlanKind; 4] =
        [PlanKind::OtherLoads, PlanKind::FewPoses, PlanKind::VerticalOnly, PlanKind::NoReference];
    match kind {
        CaseKind::Absolute => PlanKind::Absolute,
        CaseKind::SeedProtocol => PlanKind::Paper,
        _ if easy || rng.random_bool(0.6) => PlanKind::Rich,
        _ => pick(rng, &VARIANTS),
    }
}
