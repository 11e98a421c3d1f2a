//! One law, or the sum of several, as a proposal: formula, sentence, term file.

use std::fmt::Write as _;

use super::law::Law;
use super::text::LawLine;
use super::{LawTerm, prior_text};
use crate::effects::user_term::PartKind;
use crate::estimation::linearization::{Active, Linearization};

/// Longest id of a term.
const LONGEST_ID: usize = 40;

/// Laws that stand together, the leading one first, with the values they were fitted with.
pub struct LawSum<'a> {
    laws: Vec<(&'a LawTerm, Law)>,
    /// Sizes of each, SI.
    sizes: Vec<Vec<f64>>,
}

impl<'a> LawSum<'a> {
    /// These laws as a fit has them; those the fit does not have are left out.
    pub fn fitted(laws: impl IntoIterator<Item = &'a LawTerm>, active: &[Active]) -> Self {
        let mut sum = Self { laws: Vec::new(), sizes: Vec::new() };
        for law in laws {
            if let Some(own) = active.iter().find(|a| a.id() == law.term.info().id) {
                sum.laws.push((law, Law { constant: own.shape, ..law.law }));
                sum.sizes.push(own.values.clone());
            }
        }
        sum
    }

    /// Id of the term its file describes.
    pub fn id(&self) -> String {
        let ids: Vec<&str> = self.laws.iter().map(|(law, _)| law.term.info().id).collect();
        let mut id = ids.join("-and-");
        id.truncate(LONGEST_ID);
        id.trim_end_matches('-').to_owned()
    }

    /// Its formulas with where they act, where that is not one elongation of all legs or of those of [`Self::legs`].
    pub fn formula(&self) -> String {
        let one = self.lines().count() == 1;
        let written = |line: LawLine| match line.place() {
            Some(place) if !one || line.kind != PartKind::Elongation => {
                format!("{} in {place}", line.formula)
            }
            _ => line.formula,
        };
        self.lines().map(written).collect::<Vec<_>>().join(" + ")
    }

    /// What it gives: `elongation`, `wrench`, `base-motion` or `platform-motion`; of a sum that of the leading law.
    pub fn kind(&self) -> String {
        self.laws.first().map_or("elongation", |(_, law)| law.product.kind().key()).replace('_', "-")
    }

    /// Numbers of the legs it concerns, from 1; none for all.
    pub fn legs(&self) -> Option<Vec<usize>> {
        let mut all: Vec<usize> = Vec::new();
        for (_, law) in &self.laws {
            all.extend(law.leg_numbers()?);
        }
        all.sort_unstable();
        all.dedup();
        (all.len() < 6).then_some(all)
    }

    /// Words in its description.
    pub fn complexity(&self) -> usize {
        self.laws.iter().map(|(_, law)| law.complexity()).sum()
    }

    /// One sentence without its end.
    pub fn sentence(&self) -> String {
        let one = |((_, law), sizes): (&(&LawTerm, Law), &Vec<f64>)| law.sentence(rises(law, sizes));
        self.laws.iter().zip(&self.sizes).map(one).collect::<Vec<_>>().join(", and ")
    }

    /// What an engineer would look at.
    pub fn look_at(&self) -> [&'static str; 3] {
        self.laws.first().map_or([""; 3], |(_, law)| law.look_at())
    }

    /// The term file, with what is known of its origin as comments; `lin`: of the readings. Of several constants inside the first is
    /// fitted again elsewhere.
    pub fn file(&self, lin: &Linearization, source: &[String]) -> String {
        let sentence = capital(&self.sentence());
        let mut text = String::new();
        for line in source {
            let _ = writeln!(text, "# {line}");
        }
        let _ = write!(
            text,
            "format = \"term/1\"\nid = \"{}\"\ntitle = \"{sentence}\"\nphysics = \"{sentence}.\"\n",
            self.id()
        );
        text += &prior_text(self.laws.iter().map(|(law, _)| law.term.log_prior()).sum());
        let one = self.lines().count() == 1;
        for line in self.lines() {
            text += if one { "" } else { "\n[[laws]]\n" };
            text += &line.toml();
        }
        for (k, (law, fitted)) in self.laws.iter().enumerate() {
            text += &fitted.parameters_text(law.scale, &mark(k));
        }
        let shape = self.with_shape().map(|k| self.laws[k].1.shape_text(lin));
        text + &shape.unwrap_or_default()
    }

    fn lines(&self) -> impl Iterator<Item = LawLine> {
        let fitted = self.with_shape();
        self.laws.iter().enumerate().flat_map(move |(k, (_, law))| law.lines(&mark(k), fitted == Some(k)))
    }

    /// The law whose constant is fitted.
    fn with_shape(&self) -> Option<usize> {
        self.laws.iter().position(|(_, law)| law.product.constant().is_some())
    }
}

/// Whether what a law describes grows.
fn rises(law: &Law, sizes: &[f64]) -> Option<bool> {
    sizes.first().filter(|_| law.has_direction()).map(|size| *size > 0.0)
}

fn mark(k: usize) -> String {
    if k == 0 { String::new() } else { format!("_{}", k + 1) }
}

fn capital(sentence: &str) -> String {
    let mut letters = sentence.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
