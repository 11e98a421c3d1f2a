//! Laws outside the catalogue: extra elongations of legs as products of physical building blocks, compared by evidence like all
//! terms.
//!
//! A law is `size * carrier * what changes it` in some of the legs, with at most one constant inside that is fitted (a period, a
//! force, a time constant, an exponent). The grammar has a prior: every choice costs the logarithm of its alternatives, so a long law
//! must fit better to win, and all laws together have the prior of one effect of the catalogue. The scan computes the normal equations
//! of every product leg by leg, once; every choice of legs is a sum of them. The best laws become terms like any other and compete
//! with the catalogue in [`TermSearch`](crate::inference::search::TermSearch).
//!
//! Source: description lengths over a grammar of formulas, Bartlett, Desmond and Ferreira (2023), IEEE Transactions on Evolutionary
//! Computation 28 ("exhaustive symbolic regression"); evidence as in [`evidence`](crate::inference::evidence).

mod block;
mod law;
mod legs;
mod scan;
mod space;
mod sum;
mod tables;
mod text;

use std::sync::Arc;

use self::law::{Law, Product};
use self::scan::{LawScan, ScoredLaw};
use self::space::{Spaces, natural_unit};
pub use self::sum::LawSum;
use self::tables::Tables;
use crate::effects::term::{Natural, Term};
use crate::effects::user_term;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::linearization::{Linearization, ModelPoint};
use crate::inference::scan::SCANNED_CONDITIONS;

/// Two periods that differ by less, in logarithm, are one.
const SAME_PERIOD: f64 = 0.05;
/// Laws of one scan whose constants are refined.
const REFINED: usize = 48;

/// A law as a term that competes.
#[derive(Clone)]
pub struct LawTerm {
    law: Law,
    /// The term its file describes.
    pub term: Arc<dyn Term>,
    /// Log-evidence plus log-prior when it was found.
    pub score: f64,
    scale: f64,
}

impl LawTerm {
    /// `rank`: how many of this name there are already.
    fn of(found: &ScoredLaw, rank: usize, scale: f64, lin: &Linearization) -> Result<Self, ModelError> {
        let id = if rank == 0 { found.law.id() } else { format!("{}-{}", found.law.id(), rank + 1) };
        let law = &found.law;
        let mut text = format!("format = \"term/1\"\nid = \"{id}\"\ntitle = \"{}\"\n", law.sentence(None));
        text += &prior_text(found.log_prior);
        for line in law.lines("", true) {
            text += "[[laws]]\n";
            text += &line.toml();
        }
        text += &law.parameters_text(scale, "");
        text += &law.shape_text(lin);
        let term =
            user_term::parse(&text).map_err(|e| ModelError::Selection(format!("a law is no term: {e}")))?;
        Ok(Self { law: found.law, term, score: found.score, scale })
    }

    /// Period of a wave, m: that of the model where the law is in it, else as found.
    pub(crate) fn period(&self, point: &ModelPoint) -> Option<f64> {
        let active = point.active.iter().find(|a| a.id() == self.term.info().id);
        self.law.product.is_wave().then(|| active.map_or(self.law.constant, |a| a.shape))
    }

    /// True for the same law; waves of two periods are two laws, any other constant is found again by the fit.
    fn resembles(&self, found: &ScoredLaw) -> bool {
        let (a, b) = (&self.law, &found.law);
        let differ = a.product.is_wave() && (a.constant / b.constant).ln().abs() > SAME_PERIOD;
        a.product == b.product && a.legs == b.legs && !differ
    }
}

/// The prior of a law, given that there is one, as a key of a term file.
fn prior_text(log_prior: f64) -> String {
    format!("prior = {:e}\n", log_prior.exp())
}

/// The grammar and its values at the conditions of a campaign.
pub struct LawSearch {
    tables: Tables,
    products: Vec<(Product, f64)>,
    scanned: Linearization,
    natural: Natural,
}

impl LawSearch {
    /// Laws that these readings can show.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`] for a building block without value.
    pub fn new(campaign: &Campaign, lin: &Linearization, natural: Natural) -> Result<Self, ModelError> {
        let scanned = lin.thinned(SCANNED_CONDITIONS);
        let tables = Tables::new(&scanned)?;
        let shown = |p: &Product| Tables::has(p.head, campaign.columns) && tables.shows(p);
        let products = Product::all(campaign.is_absolute()).into_iter().filter(|(p, _)| shown(p)).collect();
        Ok(Self { tables, products, scanned, natural })
    }

    /// Adds the best laws beside what a model has already to those known, at most `most`; `lin`: linearized at `point`. The number of
    /// laws weighed, every choice of legs and every value of a constant counted.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn scan(
        &self,
        campaign: &Campaign,
        lin: &Linearization,
        point: &ModelPoint,
        most: usize,
        known: &mut Vec<LawTerm>,
    ) -> Result<usize, ModelError> {
        let thin = lin.thinned(SCANNED_CONDITIONS);
        let spaces = Spaces::new(&thin, point, campaign.noise_level(), &self.natural);
        let scan = LawScan { spaces: &spaces, tables: &self.tables, products: &self.products };
        let found = scan.run(REFINED)?;
        for law in found.laws.iter().take(most) {
            if known.iter().any(|k| k.resembles(law)) {
                continue;
            }
            let rank = known.iter().filter(|k| k.law.id() == law.law.id()).count();
            let elongation = self.natural.compliance * self.natural.force;
            let unit =
                law.law.axis().map_or(1.0, |axis| natural_unit(law.law.product.kind(), axis, &self.natural));
            let scale = unit * self.tables.scale(&law.law, elongation)?;
            known.push(LawTerm::of(law, rank, scale, &self.scanned)?);
        }
        Ok(found.tried)
    }
}
