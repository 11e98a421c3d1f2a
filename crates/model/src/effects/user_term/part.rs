//! What the formulas of a term file give: an elongation of legs, a change of the wrench, a rigid motion.

use hexbench_core::{Vector3, Vector6};

use super::UserTermError;
use super::file::{File, FileLaw};
use super::variables::{self, OF_LEG, OF_READING};
use crate::effects::chain::Action;
use crate::effects::formula::{Formula, UnitPowers, dimension_of};
use crate::estimation::campaign::Condition;
use crate::machine::geometry::Machine;

/// What six numbers, or one of each leg, stand for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum PartKind {
    /// Extra elongation of each leg, m.
    Elongation,
    /// Change of the wrench on the platform, N and N m, mobile origin, fixed axes.
    Wrench,
    /// Small motion of the base, m and rad, fixed origin and axes.
    BaseMotion,
    /// Small motion of what is measured against the platform joints, m and rad, mobile origin and axes.
    PlatformMotion,
}

impl PartKind {
    /// Those that have six numbers of their own.
    pub(crate) const BODIES: [Self; 3] = [Self::Wrench, Self::BaseMotion, Self::PlatformMotion];

    /// The key of files.
    pub(crate) fn key(self) -> &'static str {
        match self {
            Self::Elongation => "elongation",
            Self::Wrench => "wrench",
            Self::BaseMotion => "base_motion",
            Self::PlatformMotion => "platform_motion",
        }
    }

    /// The kind with this key.
    pub(super) fn named(key: &str) -> Option<Self> {
        [Self::Elongation].into_iter().chain(Self::BODIES).find(|kind| kind.key() == key)
    }

    /// The variables its formulas may mention.
    pub(super) fn variables(self) -> Vec<&'static str> {
        match self {
            Self::Elongation => OF_LEG.into_iter().chain(OF_READING).collect(),
            Self::Wrench | Self::BaseMotion | Self::PlatformMotion => OF_READING.to_vec(),
        }
    }

    /// The action of six numbers.
    pub(crate) fn action(self, at: &Condition, v: &Vector6) -> Action {
        let halves = || (Vector3::new(v[0], v[1], v[2]), Vector3::new(v[3], v[4], v[5]));
        let twist = |v: Vector3, w: Vector3| Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z);
        match self {
            Self::Elongation => Action::Elongation(*v),
            Self::Wrench => Action::Wrench(*v),
            Self::BaseMotion => {
                let (shift, turn) = halves();
                Action::Base(twist(shift + turn.cross(&at.place.translation), turn))
            }
            Self::PlatformMotion => {
                let (shift, turn) = halves();
                let axes = at.place.rotation;
                Action::Plate(twist(axes * shift, axes * turn))
            }
        }
    }
}

/// Formulas of one kind.
pub(super) struct Part {
    pub(super) kind: PartKind,
    /// One for an elongation, else six; none for zero.
    formulas: Vec<Option<Formula>>,
    /// Legs on which an elongation acts.
    legs: [bool; 6],
}

impl Part {
    /// The parts of a file; `own`: names of its parameters, then of its shape, with units where these are known.
    pub(super) fn all(file: &File, own: &[(&str, Option<UnitPowers>)]) -> Result<Vec<Self>, UserTermError> {
        let mut parts = Vec::new();
        for law in file.every_law() {
            parts.extend(Self::of(law, own)?);
        }
        if parts.is_empty() {
            let why = "one of elongation, wrench, base_motion and platform_motion is needed, or [[laws]] with one of them each";
            return Err(UserTermError::rule("elongation", why.to_owned()));
        }
        Ok(parts)
    }

    fn of(law: &FileLaw, own: &[(&str, Option<UnitPowers>)]) -> Result<Option<Self>, UserTermError> {
        let elongation = law.elongation.iter().map(|text| (PartKind::Elongation, std::slice::from_ref(text)));
        let six = [
            (PartKind::Wrench, &law.wrench),
            (PartKind::BaseMotion, &law.base_motion),
            (PartKind::PlatformMotion, &law.platform_motion),
        ];
        let six = six.into_iter().filter_map(|(kind, texts)| Some((kind, &texts.as_ref()?[..])));
        let mut given = elongation.chain(six);
        let Some((kind, texts)) = given.next() else { return Ok(None) };
        if let Some((other, _)) = given.next() {
            let why = format!(
                "{} and {} cannot stand together; give each its own [[laws]]",
                kind.key(),
                other.key()
            );
            return Err(UserTermError::rule(kind.key(), why));
        }
        let of_kind =
            kind.variables().into_iter().map(|name| (name, dimension_of(variables::meaning(name)[0])));
        let (names, units): (Vec<&str>, Vec<_>) = of_kind.chain(own.iter().copied()).unzip();
        let parse = |text: &String| {
            let is_zero = kind != PartKind::Elongation && text.trim().is_empty();
            (!is_zero).then(|| formula(kind.key(), text, &names, &units)).transpose()
        };
        let formulas = texts.iter().map(parse).collect::<Result<_, _>>()?;
        Ok(Some(Self { kind, formulas, legs: law.legs(kind == PartKind::Elongation)? }))
    }

    /// Its formulas.
    pub(super) fn formulas(&self) -> impl Iterator<Item = &Formula> {
        self.formulas.iter().flatten()
    }

    /// True when a formula mentions a variable.
    pub(super) fn uses(&self, name: &str) -> bool {
        let index = self.kind.variables().iter().position(|v| *v == name);
        index.is_some_and(|k| self.formulas().any(|f| f.uses(k)))
    }

    /// True when a formula mentions the `k`-th name that the file adds.
    pub(super) fn uses_own(&self, k: usize) -> bool {
        let first = self.kind.variables().len();
        self.formulas().any(|f| f.uses(first + k))
    }

    /// Its six numbers for these values of what the file adds; `values`: memory to use.
    pub(super) fn vector(
        &self,
        machine: &Machine,
        at: &Condition,
        own: &[f64],
        values: &mut Vec<f64>,
    ) -> Vector6 {
        if self.kind == PartKind::Elongation {
            let Some(Some(formula)) = self.formulas.first() else { return Vector6::zeros() };
            self.fill(machine, at, 0, values);
            values.extend_from_slice(own);
            return Vector6::from_fn(|leg, _| {
                if self.legs[leg] {
                    // Only these differ from leg to leg.
                    values[..OF_LEG.len()].copy_from_slice(&variables::of_leg(machine, at, leg));
                    formula.value(values)
                } else {
                    0.0
                }
            });
        }
        self.fill(machine, at, 0, values);
        values.extend_from_slice(own);
        Vector6::from_fn(|axis, _| {
            self.formulas.get(axis).and_then(Option::as_ref).map_or(0.0, |f| f.value(values))
        })
    }

    fn fill(&self, machine: &Machine, at: &Condition, leg: usize, values: &mut Vec<f64>) {
        values.clear();
        if self.kind == PartKind::Elongation {
            values.extend(variables::of_leg(machine, at, leg));
        }
        variables::push_of_reading(at, values);
    }

    /// The variables at one condition, for component `index` (leg or axis, from zero).
    pub(super) fn story(&self, machine: &Machine, at: &Condition, index: usize) -> String {
        let mut values = Vec::new();
        self.fill(machine, at, index, &mut values);
        variables::describe(&self.kind.variables(), &values, |k| self.formulas().any(|f| f.uses(k)))
    }
}

fn formula(
    key: &'static str,
    text: &str,
    names: &[&str],
    units: &[Option<UnitPowers>],
) -> Result<Formula, UserTermError> {
    let shown = || text.chars().take(60).collect();
    let failed = |error| UserTermError::Formula { key, formula: shown(), error };
    let formula = Formula::parse(text, names).map_err(failed)?;
    formula.check_units(units).map_err(failed)?;
    Ok(formula)
}
