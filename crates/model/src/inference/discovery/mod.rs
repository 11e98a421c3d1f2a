//! Laws that no catalogue lists: extra elongations of legs as products of physical building blocks, weighed like everything else.
//!
//! A law is `size * carrier * what changes it` in some of the legs, with at most one constant inside that is fitted (a period, a
//! force, a time constant, an exponent). The grammar has a prior: every choice costs the logarithm of its alternatives, so that a long
//! law has to earn its length and all laws together weigh no more than one effect of the catalogue. The scan computes the normal
//! equations of every product leg by leg, once; every choice of legs is a sum of them. What survives becomes a term like any other and
//! is weighed beside the catalogue by [`TermSearch`](crate::inference::search::TermSearch).
//!
//! Source: description lengths over a grammar of formulas, Bartlett, Desmond and Ferreira (2023), IEEE Transactions on Evolutionary
//! Computation 28 ("exhaustive symbolic regression"); evidence as in [`evidence`](crate::inference::evidence).

mod block;
mod law;
mod legs;
mod scan;
mod space;
mod tables;
mod text;

use std::sync::Arc;

use self::law::{Law, Product};
pub use self::legs::LegSigns;
use self::scan::{LawScan, ScoredLaw};
use self::space::ElongationSpace;
use self::tables::Tables;
use crate::effects::term::{Natural, Term};
use crate::effects::user_term;
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::linearization::{Linearization, ModelPoint};

/// Conditions looked at by the scan; the weighing itself uses all of them.
const SCANNED_CONDITIONS: usize = 400;
/// Laws of one scan whose constants are refined.
const REFINED: usize = 48;

/// A law as a term that competes.
#[derive(Clone)]
pub struct LawTerm {
    law: Law,
    /// The term its file describes.
    pub term: Arc<dyn Term>,
    /// Logarithm of the prior probability of the law, given that there is one.
    pub log_prior: f64,
    /// Log-evidence plus log-prior when it was found.
    pub score: f64,
    scale: f64,
}

impl LawTerm {
    fn of(
        found: &ScoredLaw,
        space: &ElongationSpace,
        tables: &Tables,
        lin: &Linearization,
    ) -> Result<Self, ModelError> {
        let scale = tables.scale(&found.law, space.elongation)?;
        let text = found.law.term_file(scale, lin, None, &[]);
        let term =
            user_term::parse(&text).map_err(|e| ModelError::Selection(format!("a law is no term: {e}")))?;
        Ok(Self { law: found.law, term, log_prior: found.log_prior, score: found.score, scale })
    }

    /// Which legs it concerns.
    pub fn legs(&self) -> LegSigns {
        self.law.legs
    }

    /// Formula of the elongation of a leg, m.
    pub fn formula(&self) -> String {
        self.law.formula()
    }

    /// Words in its sentence.
    pub fn complexity(&self) -> usize {
        self.law.complexity()
    }

    /// One sentence; `sizes` as fitted, `constant` the value of the constant inside, SI.
    pub fn sentence(&self, sizes: &[f64], constant: f64) -> String {
        Law { constant, ..self.law }.sentence(self.rises(sizes))
    }

    /// What an engineer would look at.
    pub fn look_at(&self) -> [&'static str; 3] {
        self.law.look_at()
    }

    /// The term file, with what is known of its origin as comments.
    pub fn file(&self, lin: &Linearization, sizes: &[f64], constant: f64, source: &[String]) -> String {
        Law { constant, ..self.law }.term_file(self.scale, lin, self.rises(sizes), source)
    }

    fn rises(&self, sizes: &[f64]) -> Option<bool> {
        let size = sizes.first().copied().filter(|_| self.law.has_direction())?;
        Some(size > 0.0)
    }
}

/// The grammar and its values at the conditions of a campaign.
pub struct LawSearch {
    tables: Tables,
    products: Vec<(Product, f64)>,
    scanned: Linearization,
    natural: Natural,
}

/// Laws that one scan found.
pub struct FoundLaws {
    /// Best first.
    pub laws: Vec<LawTerm>,
    /// Laws weighed, every choice of legs and every value of a constant counted.
    pub tried: usize,
}

impl LawSearch {
    /// Laws that these readings can show.
    ///
    /// # Errors
    /// [`ModelError::NotFinite`] for a building block without value.
    pub fn new(campaign: &Campaign, lin: &Linearization, natural: Natural) -> Result<Self, ModelError> {
        let scanned = lin.thinned(SCANNED_CONDITIONS);
        let tables = Tables::new(&scanned)?;
        let has = campaign.columns;
        let shown =
            |p: &Product| Tables::has(p.head, has.elapsed, has.delta_t, has.approach) && tables.shows(p);
        let products = Product::all().into_iter().filter(|(p, _)| shown(p)).collect();
        Ok(Self { tables, products, scanned, natural })
    }

    /// The best laws beside what a model has already, at most `most`; `lin`: linearised at `point`.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn beside(
        &self,
        campaign: &Campaign,
        lin: &Linearization,
        point: &ModelPoint,
        most: usize,
    ) -> Result<FoundLaws, ModelError> {
        let thin = lin.thinned(SCANNED_CONDITIONS);
        let space = ElongationSpace::new(&thin, point, campaign.noise_level(), &self.natural);
        let scan = LawScan { space: &space, tables: &self.tables, products: &self.products };
        let found = scan.run(REFINED)?;
        let term = |s: &ScoredLaw| LawTerm::of(s, &space, &self.tables, &self.scanned);
        let laws = found.laws.iter().take(most).map(term).collect::<Result<_, _>>()?;
        Ok(FoundLaws { laws, tried: found.tried })
    }
}
