//! A law: a product of building blocks in some legs.

use super::block::{
    Block, CARRIERS, COMPLIANCE, COVARIATES, Constant, Family, LOADED, LOADS, MODULATIONS, PRESENCE,
};
use super::legs::LegChoice;
use crate::effects::user_term::PartKind;

/// Prior probability that a law is a change of compliance, a change of length, an elongation with another carrier, moves or loads
/// base or platform, or is a constant wrench that is applied with every load.
const OF_KIND: [f64; 5] = [0.36, 0.27, 0.27, 0.07, 0.03];
/// Prior probability that a compliance is changed by one thing, by two.
const OF_COMPLIANCE: [f64; 2] = [0.75, 0.25];
/// Prior probability that a covariate acts alone, through one thing more.
const OF_COVARIATE: [f64; 2] = [0.7, 0.3];
/// The same for the other carriers.
const OF_CARRIER: [f64; 2] = [0.7, 0.3];

/// Prior probability that a law of absolute poses is one of the length of a leg as it is measured.
const OF_POSES: f64 = 0.5;
/// Prior probability that such a length follows one thing, two.
const OF_POSE: [f64; 2] = [0.7, 0.3];

/// What a law multiplies, before legs are chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) struct Product {
    /// The first factor.
    pub(crate) head: Head,
    /// Indices of [`MODULATIONS`], ascending.
    pub(crate) with: [Option<usize>; 2],
}

/// The factor without which a law would act where nothing is different from the reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum Head {
    /// Index of [`CARRIERS`].
    Carrier(usize),
    /// Index of [`COVARIATES`]: elongation without a load.
    Length(usize),
    /// Index of [`MODULATIONS`]: how long a leg is where it stands, whatever it carries; a difference of two states at one pose does not show it.
    Pose(usize),
    /// Index of [`COVARIATES`], times the force change: a compliance that was the same in the reference state.
    Compliance(usize),
    /// The same times the force under the load: a compliance that changed after the reference state.
    Loaded(usize),
    /// Base or platform moved or loaded along one axis; index of [`COVARIATES`], then of [`LOADS`].
    Body(PartKind, usize),
}

impl Head {
    /// Blocks of the head.
    pub(crate) fn blocks(self) -> impl Iterator<Item = &'static Block> {
        let (first, second) = match self {
            Self::Carrier(k) => (&CARRIERS[k], None),
            Self::Length(k) => (&COVARIATES[k], None),
            Self::Pose(k) => (&MODULATIONS[k], None),
            Self::Compliance(k) => (&CARRIERS[COMPLIANCE], Some(&COVARIATES[k])),
            Self::Loaded(k) => (&CARRIERS[LOADED], Some(&COVARIATES[k])),
            Self::Body(_, k) => (COVARIATES.get(k).unwrap_or_else(|| &LOADS[k - COVARIATES.len()]), None),
        };
        std::iter::once(first).chain(second)
    }
}

impl Product {
    fn new(head: Head, with: [Option<usize>; 2]) -> Self {
        Self { head, with }
    }

    /// Its factors.
    pub(crate) fn blocks(&self) -> impl Iterator<Item = &'static Block> {
        self.head.blocks().chain(self.with.into_iter().flatten().map(|k| &MODULATIONS[k]))
    }

    /// What it acts on.
    pub(crate) fn kind(&self) -> PartKind {
        if let Head::Body(kind, _) = self.head { kind } else { PartKind::Elongation }
    }

    /// The constant inside, when there is one.
    pub(crate) fn constant(&self) -> Option<Constant> {
        self.blocks().find_map(|b| b.constant)
    }

    /// True for two sizes.
    pub(crate) fn is_wave(&self) -> bool {
        self.blocks().any(|b| b.twin.is_some())
    }

    /// True when no two factors vary with the same thing, at most one has a constant, and a wave, which costs as much as all other
    /// products together, is one of the compliance; so is a step in leg length, unless it is one of the length itself.
    fn is_sound(&self) -> bool {
        let families: Vec<_> = self.blocks().map(|b| b.family).collect();
        let distinct = (1..families.len()).all(|k| !families[..k].contains(&families[k]));
        let constants = self.blocks().filter(|b| b.constant.is_some()).count();
        let is_over_length = self.is_wave() || self.constant() == Some(Constant::Length);
        let is_alone = self.changes_compliance_by_one() || self.is_length_of_pose();
        distinct && constants <= 1 && (!is_over_length || is_alone)
    }

    /// True for the length of a leg that goes with one thing, whatever the leg carries.
    pub(crate) fn is_length_of_pose(&self) -> bool {
        matches!((self.head, self.with), (Head::Pose(_), [None, None]))
    }

    /// True for a compliance that one thing changes.
    fn changes_compliance_by_one(&self) -> bool {
        self.head == Head::Carrier(COMPLIANCE) && matches!(self.with, [Some(_), None])
    }

    /// Formulas of its sizes without the sizes: one, or two for a wave.
    pub(crate) fn formulas(&self) -> Vec<String> {
        let from_home = self.changes_compliance_by_one();
        let joined = |twin: bool| {
            let text = |b: &'static Block| match b.family {
                // A leg never turns far: without its direction at home its spring would have to take most of this back.
                Family::Direction if from_home => format!("({} - {})", b.text, at_home(b.text)),
                _ => b.twin.filter(|_| twin).unwrap_or(b.text).to_owned(),
            };
            self.blocks().map(text).collect::<Vec<_>>().join("*")
        };
        if self.is_wave() { vec![joined(false), joined(true)] } else { vec![joined(false)] }
    }

    /// Powers of N, m, K and s.
    pub(crate) fn powers(&self) -> [f64; 4] {
        self.blocks().fold([0.0; 4], |sum, b| std::array::from_fn(|k| sum[k] + b.powers[k]))
    }

    /// All products of deflections, or of absolute poses, with the logarithm of the prior probability of each.
    pub(crate) fn all(is_absolute: bool) -> Vec<(Self, f64)> {
        let mut all = compliances();
        all.extend(lengths());
        all.extend(carriers());
        all.extend(bodies());
        if is_absolute {
            for (_, log_prior) in &mut all {
                *log_prior += (1.0 - OF_POSES).ln();
            }
            all.extend(poses());
        }
        all
    }
}

/// A formula of the direction of a leg, at the zero pose.
fn at_home(direction: &str) -> String {
    ["nx", "ny", "nz"].iter().fold(direction.to_owned(), |text, n| text.replace(n, &format!("{n}_home")))
}

fn shared(products: Vec<Product>, probability: f64) -> impl Iterator<Item = (Product, f64)> {
    let sound: Vec<Product> = products.into_iter().filter(Product::is_sound).collect();
    let each = (probability / sound.len().max(1) as f64).ln();
    sound.into_iter().map(move |p| (p, each))
}

fn compliances() -> Vec<(Product, f64)> {
    let carrier = Head::Carrier(COMPLIANCE);
    let heads = || (0..COVARIATES.len()).flat_map(|k| [Head::Compliance(k), Head::Loaded(k)]);
    let by_covariate = heads().map(|head| Product::new(head, [None; 2]));
    let by_one = (0..MODULATIONS.len()).map(|k| Product::new(carrier, [Some(k), None]));
    let pairs = (0..MODULATIONS.len())
        .flat_map(|j| (j + 1..MODULATIONS.len()).map(move |k| Product::new(carrier, [Some(j), Some(k)])));
    let with_covariate =
        heads().flat_map(|head| (0..MODULATIONS.len()).map(move |k| Product::new(head, [Some(k), None])));
    let one = shared(by_covariate.chain(by_one).collect(), OF_KIND[0] * OF_COMPLIANCE[0]);
    let two = shared(pairs.chain(with_covariate).collect(), OF_KIND[0] * OF_COMPLIANCE[1]);
    one.chain(two).collect()
}

fn lengths() -> Vec<(Product, f64)> {
    let alone = (0..COVARIATES.len()).map(|k| Product::new(Head::Length(k), [None; 2]));
    let with = (0..COVARIATES.len())
        .flat_map(|c| (0..MODULATIONS.len()).map(move |k| Product::new(Head::Length(c), [Some(k), None])));
    let one = shared(alone.collect(), OF_KIND[1] * OF_COVARIATE[0]);
    one.chain(shared(with.collect(), OF_KIND[1] * OF_COVARIATE[1])).collect()
}

/// A wave of the length is an effect of the catalogue.
fn poses() -> Vec<(Product, f64)> {
    let is_of_pose =
        |b: &Block| b.twin.is_none() && matches!(b.family, Family::Length | Family::Direction | Family::Pose);
    let of_pose: Vec<usize> = (0..MODULATIONS.len()).filter(|&k| is_of_pose(&MODULATIONS[k])).collect();
    let alone = of_pose.iter().map(|&k| Product::new(Head::Pose(k), [None; 2]));
    let pairs = of_pose.iter().enumerate().flat_map(|(i, &j)| {
        of_pose[i + 1..].iter().map(move |&k| Product::new(Head::Pose(j), [Some(k), None]))
    });
    let one = shared(alone.collect(), OF_POSES * OF_POSE[0]);
    one.chain(shared(pairs.collect(), OF_POSES * OF_POSE[1])).collect()
}

fn carriers() -> Vec<(Product, f64)> {
    let others = || (0..CARRIERS.len()).filter(|&k| k != COMPLIANCE && k != LOADED);
    let alone = others().map(|k| Product::new(Head::Carrier(k), [None; 2]));
    let with = others()
        .flat_map(|c| (0..MODULATIONS.len()).map(move |k| Product::new(Head::Carrier(c), [Some(k), None])));
    let one = shared(alone.collect(), OF_KIND[2] * OF_CARRIER[0]);
    one.chain(shared(with.collect(), OF_KIND[2] * OF_CARRIER[1])).collect()
}

fn bodies() -> Vec<(Product, f64)> {
    let causes = 0..COVARIATES.len() + LOADS.len();
    let of = |kind| {
        causes.clone().filter(|k| *k != PRESENCE).map(move |k| Product::new(Head::Body(kind, k), [None; 2]))
    };
    // A motion that is applied with every load is what readings with one reference reading share: no law of the machine.
    let constant = Product::new(Head::Body(PartKind::Wrench, PRESENCE), [None; 2]);
    let varying = shared(PartKind::BODIES.into_iter().flat_map(of).collect(), OF_KIND[3]);
    varying.chain(shared(vec![constant], OF_KIND[4])).collect()
}

/// A product in some legs, with the value of its constant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Law {
    /// What it multiplies.
    pub(crate) product: Product,
    /// In which legs; along or about which axis for base and platform.
    pub(crate) legs: LegChoice,
    /// Value of the constant inside, SI; 1 where there is none.
    pub(crate) constant: f64,
}

impl Law {
    /// Axis from zero of a law for base or platform.
    pub(crate) fn axis(&self) -> Option<usize> {
        let is_body = self.product.kind() != PartKind::Elongation;
        is_body.then(|| self.legs.signs().iter().position(|s| *s != 0)).flatten()
    }

    /// Numbers of its legs from 1; none for all, or for base and platform.
    pub(crate) fn leg_numbers(&self) -> Option<Vec<usize>> {
        if self.axis().is_some() { None } else { self.legs.numbers() }
    }

    /// Number of factors, of constants inside and of choices of legs: one for each word of the sentence.
    pub(crate) fn complexity(&self) -> usize {
        let factors = self.product.blocks().count();
        1 + factors
            + usize::from(self.product.constant().is_some())
            + usize::from(self.product.is_wave())
            + usize::from(self.legs != LegChoice::ALL)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_prior_over_products_sums_to_one() {
        for is_absolute in [false, true] {
            let total: f64 = Product::all(is_absolute).iter().map(|p| p.1.exp()).sum();
            assert!((total - 1.0).abs() < 1e-9, "{is_absolute}: {total}");
        }
    }

    #[test]
    fn a_compliance_that_goes_with_the_direction_alone_counts_from_the_direction_at_home() {
        let by = |slug| MODULATIONS.iter().position(|b| b.slug == slug);
        let of = |head, with| Product::new(head, with).formulas().join(" ");
        let compliance = Head::Carrier(COMPLIANCE);
        assert_eq!(of(compliance, [by("nx-nz"), None]), "df*(nx*nz - nx_home*nz_home)");
        assert_eq!(of(compliance, [by("nx"), by("alpha")]), "df*nx*alpha");
        assert_eq!(of(Head::Length(0), [by("nz"), None]), "delta_T*nz");
    }

    #[test]
    fn no_product_is_there_twice() {
        let mut all: Vec<Product> = Product::all(true).into_iter().map(|p| p.0).collect();
        let count = all.len();
        all.sort();
        all.dedup();
        assert_eq!(all.len(), count);
    }
}
