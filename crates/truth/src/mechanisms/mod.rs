//! Effects of real machines beyond six leg springs: one file each.
//!
//! Adding one: a file with its physics, a struct and `Registered` for it, and its line in `mechanisms!`.

use std::fmt::Debug;

use hexbench_core::parser_words::of_json;
use hexbench_core::{Hexapod, Matrix6, Pose, Vector6};
use rand::RngExt;
use rand_distr::{Distribution, Normal};
use rand_pcg::Pcg64;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use crate::own_law::{OWN_LAW, OwnLaw};
use crate::{Instant, Setup, TruthError, equilibrium::Body};

/// Largest factor of an effect that sets no limit of its own.
const LARGEST_FACTOR: f64 = 1e2;

/// One physical effect of a given size. It may act on the structure, on what is seen of it, or on what is read.
pub trait Mechanism: Debug + Send + Sync {
    /// Its id in the catalogue (kebab-case; `out:` in front of those outside it).
    fn id(&self) -> &'static str;

    /// Changes the structure at a moment.
    fn act(&self, _moment: &Instant<'_>, _setup: &mut Setup) {}

    /// Changes which body the instrument sees.
    fn see(&self, _moment: &Instant<'_>, _body: &mut Body) {}

    /// Changes the numbers the instrument gives.
    fn read(&self, _moment: &Instant<'_>, _pose: &mut Pose) {}

    /// The same effect `factor` times as large; 0 makes it vanish.
    fn scaled(&self, factor: f64) -> Box<dyn Mechanism>;

    /// Largest factor by which it may still be scaled and be called by its name.
    fn largest_factor(&self) -> f64 {
        LARGEST_FACTOR
    }

    /// Parameters under the names of the truth file, SI units.
    fn parameters(&self) -> Map<String, Value>;
}

/// Where an effect can be seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shows {
    /// In deflections, and it is in the catalogue.
    Deflection,
    /// In absolute poses only, and it is in the catalogue.
    Absolute,
    /// In deflections, but no term of the catalogue describes it.
    Outside,
}

/// Entry of the registry.
#[derive(Debug, Clone, Copy)]
pub struct MechanismEntry {
    /// Id in the catalogue.
    pub id: &'static str,
    /// One line in plain words.
    pub title: &'static str,
    /// Equation or rule.
    pub physics: &'static str,
    /// Where it can be seen.
    pub shows: Shows,
    /// An example of usual size for a machine, its shape drawn at random.
    pub draw: fn(&Hexapod, &mut Pcg64) -> Box<dyn Mechanism>,
    /// The effect with given parameters (SI units).
    pub parse: fn(Value) -> Result<Box<dyn Mechanism>, String>,
}

/// A mechanism of the registry, as its file says it; its [`Mechanism`] and its entry follow.
trait Registered: Debug + Send + Sync + DeserializeOwned + 'static {
    /// Id in the catalogue.
    const ID: &'static str;
    /// One line in plain words.
    const TITLE: &'static str;
    /// Equation or rule.
    const PHYSICS: &'static str;
    /// Where it can be seen.
    const SHOWS: Shows;

    /// An example of usual size for a machine.
    fn draw(hexapod: &Hexapod, rng: &mut Pcg64) -> Self;

    /// Refuses parameters that break a rule which their types do not tell.
    fn check(&self) -> Result<(), &'static str> {
        Ok(())
    }

    fn act(&self, _moment: &Instant<'_>, _setup: &mut Setup) {}

    fn see(&self, _moment: &Instant<'_>, _body: &mut Body) {}

    fn read(&self, _moment: &Instant<'_>, _pose: &mut Pose) {}

    fn scaled(&self, factor: f64) -> Self;

    fn largest_factor(&self) -> f64 {
        LARGEST_FACTOR
    }

    fn parameters(&self) -> Vec<(&'static str, Value)>;
}

impl<M: Registered> Mechanism for M {
    fn id(&self) -> &'static str {
        M::ID
    }

    fn act(&self, moment: &Instant<'_>, setup: &mut Setup) {
        Registered::act(self, moment, setup);
    }

    fn see(&self, moment: &Instant<'_>, body: &mut Body) {
        Registered::see(self, moment, body);
    }

    fn read(&self, moment: &Instant<'_>, pose: &mut Pose) {
        Registered::read(self, moment, pose);
    }

    fn scaled(&self, factor: f64) -> Box<dyn Mechanism> {
        Box::new(Registered::scaled(self, factor))
    }

    fn largest_factor(&self) -> f64 {
        Registered::largest_factor(self)
    }

    fn parameters(&self) -> Map<String, Value> {
        Registered::parameters(self).into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }
}

impl MechanismEntry {
    const fn of<M: Registered>() -> Self {
        let (id, title, physics, shows) = (M::ID, M::TITLE, M::PHYSICS, M::SHOWS);
        Self { id, title, physics, shows, draw: drawn::<M>, parse: parsed::<M> }
    }
}

fn drawn<M: Registered>(hexapod: &Hexapod, rng: &mut Pcg64) -> Box<dyn Mechanism> {
    Box::new(M::draw(hexapod, rng))
}

fn parsed<M: Registered>(value: Value) -> Result<Box<dyn Mechanism>, String> {
    let mechanism: M = serde_json::from_value(value).map_err(|e| of_json(&e))?;
    mechanism.check()?;
    Ok(Box::new(mechanism))
}

/// True for the id of an effect that no term of the catalogue describes.
pub fn is_outside(id: &str) -> bool {
    id == OWN_LAW || REGISTRY.iter().any(|effect| effect.id == id && effect.shows == Shows::Outside)
}

/// Declares the module of every effect, makes its mechanism public and registers it.
macro_rules! mechanisms {
    ($($module:ident::$mechanism:ident),+ $(,)?) => {
        $(mod $module;)+
        $(pub use $module::$mechanism;)+

        /// All effects, in the order of the catalogue; those outside it at the end.
        pub const REGISTRY: &[MechanismEntry] = &[$(MechanismEntry::of::<$mechanism>()),+];
    };
}

mechanisms! {
    leg_length_compliance::LegLengthCompliance,
    leg_nonlinearity::LegNonlinearity,
    leg_asymmetry::LegAsymmetry,
    leg_backlash::LegBacklash,
    joint_friction::JointFriction,
    joint_rotation_stiffness::JointRotationStiffness,
    bracket_compliance::BracketCompliance,
    leg_coupling::LegCoupling,
    base_compliance::BaseCompliance,
    platform_compliance::PlatformCompliance,
    load_offset::LoadOffset,
    load_tilt::LoadTilt,
    thermal_expansion::ThermalExpansion,
    metrology_drift::MetrologyDrift,
    target_offset::TargetOffset,
    creep::Creep,
    joint_geometry::JointGeometry,
    leg_offset::LegOffset,
    actuator_scale::ActuatorScale,
    actuator_pitch::ActuatorPitch,
    leg_weight::LegWeight,
    periodic_compliance::PeriodicCompliance,
    leg_drift::LegDrift,
    leg_step::LegStep,
    cable::CablePull,
    plate_bending::PlateBending,
    base_bending::BaseBending,
    load_mass_error::LoadMassError,
    thermal_compliance::ThermalCompliance,
    cubic_compliance::CubicCompliance,
}

/// Entry of an id.
///
/// # Errors
/// [`TruthError::UnknownMechanism`].
pub fn effect(id: &str) -> Result<&'static MechanismEntry, TruthError> {
    REGISTRY.iter().find(|e| e.id == id).ok_or_else(|| TruthError::UnknownMechanism { id: id.to_owned() })
}

/// The mechanism of an id with given parameters (SI units, fields of its struct).
///
/// # Errors
/// [`TruthError::UnknownMechanism`], [`TruthError::BadParameters`].
pub fn build(id: &str, parameters: Value) -> Result<Box<dyn Mechanism>, TruthError> {
    let parse: fn(Value) -> Result<Box<dyn Mechanism>, String> =
        if id == OWN_LAW { OwnLaw::parse } else { effect(id)?.parse };
    parse(parameters).map_err(|why| TruthError::BadParameters { id: id.to_owned(), why })
}

pub use creep::CreepLaw;

fn vector(values: &[f64; 6]) -> Vector6 {
    Vector6::from_column_slice(values)
}

fn uniform(rng: &mut Pcg64, low: f64, high: f64) -> f64 {
    rng.random_range(low..high)
}

/// Of springs of about this stiffness (N/m) at this radius (m), along and about axes askew to those of the frame.
fn full_compliance(stiffness: f64, radius: f64, rng: &mut Pcg64) -> [[f64; 6]; 6] {
    let mix = Matrix6::from_fn(|i, j| if i == j { 1.0 } else { uniform(rng, -0.45, 0.45) });
    let full = mix * mix.transpose() / stiffness;
    let per = |k: usize| if k < 3 { 1.0 } else { 1.0 / radius };
    std::array::from_fn(|i| std::array::from_fn(|j| full[(i, j)] * per(i) * per(j)))
}

fn one_of<T: Copy>(rng: &mut Pcg64, choices: &[T]) -> T {
    choices[rng.random_range(0..choices.len())]
}

/// Three independent normal values of the given standard deviation.
fn normal3(rng: &mut Pcg64, sigma: f64) -> [f64; 3] {
    // A standard normal distribution always exists; only a NaN sigma would not.
    Normal::new(0.0, sigma).map_or([0.0; 3], |n| std::array::from_fn(|_| n.sample(rng)))
}

/// Six of them: three of each standard deviation.
fn normal6(rng: &mut Pcg64, sigma: [f64; 2]) -> [f64; 6] {
    let ([a, b, c], [d, e, f]) = (normal3(rng, sigma[0]), normal3(rng, sigma[1]));
    [a, b, c, d, e, f]
}

/// Springs along (N/m) and about (N m/rad) three axes, twice as stiff along the third; some machines are uneven.
fn six_springs(along: f64, about: f64, rng: &mut Pcg64) -> [f64; 6] {
    let uneven = one_of(rng, &[0.0, 0.3]);
    let usual = [along, along, 2.0 * along, about, about, about];
    usual.map(|k| k * (1.0 + uneven * uniform(rng, -1.0, 1.0)))
}
