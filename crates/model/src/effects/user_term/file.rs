//! `term/1`: the file in which a user describes a term.

use hexbench_core::parser_words::of_toml;
use serde::Deserialize;

use super::{Owner, UserTermError};
use crate::effects::formula::is_reserved;
use crate::effects::term::{ParameterInfo, Scale, Shape};
use crate::inference::explanation::Explanation;
use crate::{effects::intern, terms};

/// Units whose factor from SI is known.
pub(super) const UNITS: [(&str, f64); 28] = [
    ("1", 1.0),
    ("%", 1e2),
    ("m", 1.0),
    ("mm", 1e3),
    ("um", 1e6),
    ("nm", 1e9),
    ("rad", 1.0),
    ("mrad", 1e3),
    ("urad", 1e6),
    ("N", 1.0),
    ("N m", 1.0),
    ("Nm", 1.0),
    ("K", 1.0),
    ("s", 1.0),
    ("min", 1.0 / 60.0),
    ("nm/N", 1e9),
    ("um/N", 1e6),
    ("N/um", 1e-6),
    ("urad/N", 1e6),
    ("urad/(N m)", 1e6),
    ("N m/rad", 1.0),
    ("N/m", 1.0),
    ("m/N", 1.0),
    ("1/K", 1.0),
    ("um/m", 1e6),
    ("um/(m K)", 1e6),
    ("um/s", 1e6),
    ("um/K", 1e6),
];
/// Most values of a shape worth trying.
pub(crate) const MOST_SHAPES: usize = 600;
/// Longest name of a parameter.
const LONGEST_NAME: usize = 40;

/// The file as written.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct File {
    format: String,
    pub(super) id: String,
    pub(super) title: String,
    #[serde(default)]
    pub(super) physics: String,
    prior: Option<f64>,
    elongation: Option<String>,
    wrench: Option<[String; 6]>,
    base_motion: Option<[String; 6]>,
    platform_motion: Option<[String; 6]>,
    legs: Option<Vec<usize>>,
    #[serde(default)]
    laws: Vec<FileLaw>,
    #[serde(skip)]
    every_law: Vec<FileLaw>,
    #[serde(alias = "parameter")]
    parameters: Vec<FileParameter>,
    pub(super) shape: Option<FileShape>,
}

/// One law of a file: one of the first four keys.
#[derive(Debug, Default, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileLaw {
    pub(super) elongation: Option<String>,
    pub(super) wrench: Option<[String; 6]>,
    pub(super) base_motion: Option<[String; 6]>,
    pub(super) platform_motion: Option<[String; 6]>,
    /// Legs that an elongation belongs to, from 1; all when absent.
    legs: Option<Vec<usize>>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FileParameter {
    name: String,
    unit: String,
    per_si: Option<f64>,
    scale: f64,
    #[serde(default)]
    positive: bool,
    #[serde(default)]
    per_leg: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileShape {
    name: String,
    unit: String,
    per_si: Option<f64>,
    bounds: [f64; 2],
    grid: Vec<f64>,
}

impl File {
    pub(super) fn parse(text: &str) -> Result<Self, UserTermError> {
        let mut file: Self = toml::from_str(text).map_err(|e| UserTermError::Toml(of_toml(text, &e)))?;
        if file.format != "term/1" {
            return Err(UserTermError::rule("format", format!("`{}` must be \"term/1\"", file.format)));
        }
        check_id(&file.id)?;
        let own = FileLaw {
            elongation: file.elongation.take(),
            wrench: file.wrench.take(),
            base_motion: file.base_motion.take(),
            platform_motion: file.platform_motion.take(),
            legs: file.legs.take(),
        };
        file.every_law = std::iter::once(own).chain(std::mem::take(&mut file.laws)).collect();
        if file.title.trim().is_empty() {
            return Err(UserTermError::rule(
                "title",
                "must say in a few words what the effect is".to_owned(),
            ));
        }
        Ok(file)
    }

    /// Parameters with resolved units, SI scales.
    pub(super) fn parameters(&self) -> Result<Vec<ParameterInfo>, UserTermError> {
        if self.parameters.is_empty() {
            return Err(UserTermError::rule("parameters", "a term has at least one parameter".to_owned()));
        }
        let mut all: Vec<ParameterInfo> = Vec::new();
        for p in &self.parameters {
            if all.iter().any(|known| known.name == p.name) {
                return Err(UserTermError::rule("parameters", format!("`{}` is there twice", p.name)));
            }
            all.push(p.resolve()?);
        }
        Ok(all)
    }

    /// Logarithm of the prior odds against an effect of the catalogue.
    pub(super) fn log_prior(&self) -> Result<f64, UserTermError> {
        let prior = self.prior.unwrap_or(1.0);
        if !(prior > 0.0 && prior <= 1.0) {
            let why = "how probable the effect is before any reading, beside one of the catalogue: above 0, at most 1";
            return Err(UserTermError::rule("prior", why.to_owned()));
        }
        Ok(prior.ln())
    }

    /// Refuse formulas where a function stands in their place.
    pub(super) fn refuse_formulas(&self) -> Result<(), UserTermError> {
        let given = |law: &FileLaw| {
            let six = [&law.wrench, &law.base_motion, &law.platform_motion];
            law.elongation.is_some() || law.legs.is_some() || six.iter().any(|of| of.is_some())
        };
        if self.every_law.iter().any(given) {
            let why = "a term has formulas or a function, not both".to_owned();
            return Err(UserTermError::rule("laws", why));
        }
        Ok(())
    }

    /// Laws: those of the file itself, then those of `[[laws]]`.
    pub(super) fn every_law(&self) -> &[FileLaw] {
        &self.every_law
    }

    /// Parameters of the term: those of the file, one for each leg where they differ from leg to leg.
    pub(super) fn expanded(&self, parameters: &[ParameterInfo]) -> (Vec<ParameterInfo>, Vec<Owner>) {
        let mut all = (Vec::new(), Vec::new());
        for (k, (p, written)) in parameters.iter().zip(&self.parameters).enumerate() {
            let legs: Vec<Option<usize>> =
                if written.per_leg { (0..6).map(Some).collect() } else { vec![None] };
            for leg in legs {
                let name = leg.map_or(p.name, |leg| intern::text(&format!("{}-leg-{}", p.name, leg + 1)));
                all.0.push(ParameterInfo { name, ..*p });
                all.1.push(Owner { parameter: k, leg });
            }
        }
        all
    }

    /// Shape and its grid, SI.
    pub(super) fn shape(&self) -> Result<Option<(Shape, Vec<f64>)>, UserTermError> {
        self.shape.as_ref().map(FileShape::resolve).transpose()
    }
}

impl FileLaw {
    /// Which legs an elongation acts on.
    pub(super) fn legs(&self, is_elongation: bool) -> Result<[bool; 6], UserTermError> {
        let Some(listed) = &self.legs else { return Ok([true; 6]) };
        let refused = |why: &str| Err(UserTermError::rule("legs", why.to_owned()));
        if !is_elongation {
            return refused("only an elongation belongs to legs");
        }
        let mut legs = [false; 6];
        for &leg in listed {
            match leg.checked_sub(1).and_then(|k| legs.get_mut(k)) {
                Some(taken) if !*taken => *taken = true,
                _ => return refused("a list of different leg numbers from 1 to 6, such as [1, 4]"),
            }
        }
        if listed.is_empty() { refused("names at least one leg, such as [1, 4]") } else { Ok(legs) }
    }
}

impl FileParameter {
    fn resolve(&self) -> Result<ParameterInfo, UserTermError> {
        check_name(&self.name)?;
        let per_si = per_si(&self.unit, self.per_si)?;
        if !(self.scale.is_finite() && self.scale > 0.0) {
            let why = format!(
                "the scale of `{}` must be a positive number: its physically sensible size",
                self.name
            );
            return Err(UserTermError::rule("scale", why));
        }
        let (name, unit) = (intern::text(&self.name), intern::text(&self.unit));
        Ok(ParameterInfo::new(name, unit, per_si, Scale::Fixed(self.scale / per_si), self.positive))
    }
}

impl FileShape {
    fn resolve(&self) -> Result<(Shape, Vec<f64>), UserTermError> {
        check_name(&self.name)?;
        let per_si = per_si(&self.unit, self.per_si)?;
        let [low, high] = self.bounds;
        if !(low > 0.0 && high > low && high.is_finite()) {
            let why = "the bounds of a shape are two positive numbers, the smaller first".to_owned();
            return Err(UserTermError::rule("bounds", why));
        }
        let inside = |s: &f64| (low..=high).contains(s);
        if self.grid.is_empty() || self.grid.len() > MOST_SHAPES || !self.grid.iter().all(inside) {
            let why = format!("the grid of a shape holds 1 to {MOST_SHAPES} values within its bounds");
            return Err(UserTermError::rule("grid", why));
        }
        let bounds = [low / per_si, high / per_si];
        let shape = Shape { name: intern::text(&self.name), unit: intern::text(&self.unit), per_si, bounds };
        Ok((shape, self.grid.iter().map(|s| s / per_si).collect()))
    }
}

fn per_si(unit: &str, stated: Option<f64>) -> Result<f64, UserTermError> {
    let known = UNITS.iter().find(|u| u.0 == unit).map(|u| u.1);
    match stated.or(known) {
        Some(factor) if factor.is_finite() && factor > 0.0 => Ok(factor),
        Some(_) => Err(UserTermError::rule("per_si", "must be a positive number".to_owned())),
        None => {
            let why = format!("`{unit}` is not known here: state per_si, how many {unit} make one SI unit");
            Err(UserTermError::rule("unit", why))
        }
    }
}

fn check_id(id: &str) -> Result<(), UserTermError> {
    let letters = id.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-');
    let shape = id.starts_with(|c: char| c.is_ascii_lowercase()) && !id.ends_with('-') && !id.contains("--");
    if !(letters && shape && id.len() <= LONGEST_NAME) {
        let why =
            format!("`{id}` must be kebab-case: lower-case letters, digits and single hyphens, at most 40");
        return Err(UserTermError::rule("id", why));
    }
    let taken =
        terms::catalogue().iter().any(|t| t.info().id == id) || Explanation::from(id).term().is_none();
    if taken {
        let why = format!("`{id}` is a name of the catalogue; choose another");
        return Err(UserTermError::rule("id", why));
    }
    Ok(())
}

fn check_name(name: &str) -> Result<(), UserTermError> {
    let letters = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let first = name.starts_with(|c: char| c.is_ascii_alphabetic());
    if !(letters && first && name.len() <= LONGEST_NAME) {
        let why = format!("`{name}` must be letters, digits and underscores, a letter first, at most 40");
        return Err(UserTermError::rule("name", why));
    }
    let variable = super::variables::OF_LEG.contains(&name) || super::variables::OF_READING.contains(&name);
    let taken = if variable {
        let [unit, meaning] = super::variables::meaning(name);
        format!(
            "a variable of formulas: {meaning}{}",
            if unit.is_empty() { String::new() } else { format!(", {unit}") }
        )
    } else if is_reserved(name) {
        "a function or a number of formulas".to_owned()
    } else {
        return Ok(());
    };
    let why = format!("`{name}` is {taken}; call the parameter otherwise, for example `{name}_size`");
    Err(UserTermError::rule("name", why))
}
