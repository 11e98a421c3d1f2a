//! Values of building blocks at every condition and leg, computed from their formulas once.

use std::collections::BTreeMap;

use super::block::{Block, CARRIERS, COVARIATES, Constant, Family, LOADS, MODULATIONS};
use hexbench_core::Columns;
use hexbench_core::parallel;
use hexbench_core::statistics::mean;

use super::law::{Head, Law, Product};
use crate::effects::formula::Formula;
use crate::effects::period::period_grid;
use crate::effects::user_term::LegVariables;
use crate::error::ModelError;
use crate::estimation::campaign::Condition;
use crate::estimation::linearization::Linearization;
use crate::inference::leg_sums::{LawColumns, Values};

/// Thresholds looked at in the scan; the one found is refined among all that the readings tell apart.
const THRESHOLDS: usize = 16;

/// Blocks evaluated at the conditions of a linearized model.
pub(crate) struct Tables {
    variables: LegVariables,
    plain: BTreeMap<&'static str, Values>,
    constants: BTreeMap<Constant, Vec<f64>>,
    /// All that the readings tell apart.
    thresholds: BTreeMap<Constant, Vec<f64>>,
    /// Of formulas with a constant: values for each of its grid.
    gridded: BTreeMap<&'static str, Vec<Values>>,
}

impl Tables {
    /// # Errors
    /// [`ModelError::NotFinite`] for a block whose formula is none, which is a mistake of this program.
    pub(crate) fn new(lin: &Linearization) -> Result<Self, ModelError> {
        let variables = LegVariables::at(&lin.machine, &lin.conditions);
        let of = |c: Constant| Some((c, thresholds(c, &lin.conditions)?));
        let thresholds = Constant::ALL.into_iter().filter_map(of).collect();
        let constants = Constant::ALL.into_iter().map(|c| (c, grid(c, lin))).collect();
        let (plain, gridded) = (BTreeMap::new(), BTreeMap::new());
        let mut tables = Self { variables, plain, constants, thresholds, gridded };
        for block in CARRIERS.iter().chain(&COVARIATES).chain(&MODULATIONS).chain(&LOADS) {
            for text in std::iter::once(block.text).chain(block.twin) {
                tables.evaluate(text, block.constant)?;
            }
        }
        Ok(tables)
    }

    fn evaluate(&mut self, text: &'static str, constant: Option<Constant>) -> Result<(), ModelError> {
        match constant {
            None => {
                let values = self.evaluated(text, None, 1.0)?;
                self.plain.insert(text, values);
            }
            Some(c) => {
                let of = |&value: &f64| self.evaluated(text, constant, value);
                let values = parallel::try_map(&self.constants[&c], of)?;
                self.gridded.insert(text, values);
            }
        }
        Ok(())
    }

    /// Values of a formula known already.
    fn known(&self, text: &str, constant: Option<Constant>, value: f64) -> Option<&Values> {
        let Some(c) = constant else { return self.plain.get(text) };
        let at = self.constants[&c].binary_search_by(|known| known.total_cmp(&value)).ok()?;
        self.gridded.get(text)?.get(at)
    }

    /// Values worth trying of the constant of a product; one that means nothing where it has none.
    pub(crate) fn grid(&self, product: &Product) -> &[f64] {
        product.constant().map_or(&[1.0], |c| &self.constants[&c])
    }

    /// All values of a constant between two that make a difference, where these are separate values.
    pub(crate) fn separate(&self, product: &Product, [low, high]: [f64; 2]) -> Option<Vec<f64>> {
        let all = self.thresholds.get(&product.constant()?)?;
        Some(all.iter().copied().filter(|t| (low..=high).contains(t)).collect())
    }

    /// Columns of a product.
    pub(crate) fn columns(&self, product: &Product, constant: f64) -> Result<LawColumns, ModelError> {
        let width = if product.is_wave() { 2 } else { 1 };
        let mut columns = vec![vec![[1.0; 6]; self.variables.conditions()]; width];
        for (twin, column) in columns.iter_mut().enumerate() {
            for block in product.blocks() {
                self.multiply(block, twin == 1, constant, column)?;
            }
        }
        Ok(columns)
    }

    /// Size (SI) at which a law elongates the legs as much as their springs do, `elongation` meters.
    pub(crate) fn scale(&self, law: &Law, elongation: f64) -> Result<f64, ModelError> {
        let columns = self.columns(&law.product, law.constant)?;
        let square = mean(columns.iter().flatten().flatten().map(|x| x * x)).unwrap_or(0.0);
        Ok(if square > 0.0 { elongation / square.sqrt() } else { 1.0 })
    }

    fn multiply(&self, block: &Block, twin: bool, constant: f64, out: &mut Values) -> Result<(), ModelError> {
        let text = block.twin.filter(|_| twin).unwrap_or(block.text);
        let own;
        let values = if let Some(known) = self.known(text, block.constant, constant) {
            known
        } else {
            own = self.evaluated(text, block.constant, constant)?;
            &own
        };
        for (row, factor) in out.iter_mut().zip(values) {
            (0..6).for_each(|leg| row[leg] *= factor[leg]);
        }
        Ok(())
    }

    fn evaluated(&self, text: &str, constant: Option<Constant>, value: f64) -> Result<Values, ModelError> {
        let mut names = LegVariables::names();
        names.extend(constant.map(Constant::name));
        let formula =
            Formula::parse(text, &names).map_err(|_| ModelError::NotFinite { what: "a building block" })?;
        Ok(self.variables.values(&formula, value))
    }

    /// True when a product has a finite value everywhere and one that is not zero somewhere.
    pub(crate) fn shows(&self, product: &Product) -> bool {
        let varies = |b: &Block| {
            self.plain.get(b.text).is_none_or(|values| {
                let all = || values.iter().flatten();
                all().all(|x| x.is_finite()) && all().any(|x| x.abs() > 0.0)
            })
        };
        !self.grid(product).is_empty() && product.blocks().all(varies)
    }

    /// True when the readings have the columns of a head.
    pub(crate) fn has(head: Head, columns: Columns) -> bool {
        let of = |family: Family| match family {
            Family::Temperature => columns.delta_t,
            Family::Time => columns.elapsed,
            Family::Approach => columns.approach,
            _ => true,
        };
        head.blocks().all(|block| of(block.family))
    }
}

/// Values of a constant worth trying in these conditions, ascending.
fn grid(constant: Constant, lin: &Linearization) -> Vec<f64> {
    match constant {
        Constant::Period => {
            let mut periods = period_grid(&lin.conditions);
            periods.reverse();
            periods
        }
        Constant::Force => {
            quantiles(lin.conditions.iter().flat_map(|c| c.force.iter().map(|f| f.abs()).collect::<Vec<_>>()))
        }
        Constant::Time => {
            let longest = lin.conditions.iter().map(|c| c.elapsed).fold(0.0, f64::max);
            if longest <= 0.0 {
                return Vec::new();
            }
            (0..9).map(|k| longest / 30.0 * 90_f64.powf(f64::from(k) / 8.0)).collect()
        }
        Constant::Instant | Constant::Length => {
            coarse(&thresholds(constant, &lin.conditions).unwrap_or_default())
        }
        Constant::Exponent => vec![0.3, 0.5, 0.7, 1.25, 1.5, 1.75, 2.5, 3.5, 4.5],
    }
}

/// Values of a threshold that the readings tell apart, SI: in the middle between two times, or leg lengths, at which something was read.
/// None for another constant.
pub(crate) fn thresholds(constant: Constant, conditions: &[Condition]) -> Option<Vec<f64>> {
    let mut read: Vec<f64> = match constant {
        Constant::Instant => conditions.iter().map(|c| c.elapsed).filter(|t| *t >= 0.0).collect(),
        Constant::Length => conditions.iter().flat_map(|c| c.commanded_lengths.iter().copied()).collect(),
        _ => return None,
    };
    read.sort_unstable_by(f64::total_cmp);
    read.dedup();
    Some(read.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])).collect())
}

/// At most [`THRESHOLDS`] of them, evenly chosen.
fn coarse(all: &[f64]) -> Vec<f64> {
    let count = all.len().min(THRESHOLDS);
    (0..count).map(|k| all[(2 * k + 1) * all.len() / (2 * count)]).collect()
}

/// Nine values between which tenths of all lie.
fn quantiles(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.filter(|x| *x > 0.0).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    if sorted.len() < 10 {
        return Vec::new();
    }
    let mut cuts: Vec<f64> = (1..10).map(|k| sorted[k * sorted.len() / 10]).collect();
    cuts.dedup();
    cuts
}

#[cfg(test)]
mod tests {
    use super::coarse;

    #[test]
    fn thresholds_looked_at_first_are_spread_over_all_and_never_more_than_there_are() {
        assert_eq!(coarse(&[]), Vec::<f64>::new());
        assert_eq!(coarse(&[5.0, 15.0]), [5.0, 15.0]);
        let all: Vec<f64> = (0..160).map(f64::from).collect();
        let few = coarse(&all);
        assert_eq!(few.len(), super::THRESHOLDS);
        assert!(few.windows(2).all(|w| (w[1] - w[0] - 10.0).abs() < f64::EPSILON), "{few:?}");
    }
}
