//! Deflections that no spring gives.
//!
//! Deflections are nearly linear in the compliances of the legs. Their fit by least absolute deviations, each condition by the size of what
//! its load does, follows the mass of the readings: neither a number a thousand times too large nor a load a hundred times too large
//! moves it. Effects beside the springs change deflections by a share of them; a gross reading is off by several times what is usual.
//!
//! Source: iteratively reweighted least squares (Weiszfeld 1937; Green 1984, J. R. Statist. Soc. B 46).

use std::ops::Range;

use hexbench_core::statistics::{median, quantile};
use hexbench_core::{Dataset, Hexapod, Matrix6, Vector6};

use super::{Finding, TIMES_MEDIAN, blunder};
use crate::error::ModelError;
use crate::estimation::campaign::Campaign;
use crate::estimation::linearization::{Linearization, ModelPoint};
use crate::estimation::residuals::{Residual, residuals};

/// Rounds at most in which weights follow what is left.
const ROUNDS: usize = 40;
/// Beyond so many standard deviations their number says nothing more.
const COUNTED: f64 = 1000.0;
/// Relative change of the compliances in a round from which they stay: a gross reading is off by far more.
const SETTLED: f64 = 1e-4;
/// What is left of a condition, as a share of what is usual, below which it weighs no more.
const LEAST_SHARE: f64 = 1e-3;
/// A gross reading is off by so many times what nine of ten readings are at most ...
const TIMES_USUAL: f64 = 5.0;
const USUAL: f64 = 0.9;
/// ... and by more than this share of itself, or of what springs let expect: physics changes a share of a deflection.
const OF_ITSELF: f64 = 0.5;
/// Share of the error of the worst repeat from which another one agrees with it.
const AGREES: f64 = 0.5;

/// Deflections beside springs that the mass of them has.
pub(super) struct BesideSprings {
    pub(super) campaign: Campaign,
    /// Compliances of the legs, m/N.
    pub(super) compliances: Vector6,
    /// Per condition, what was read and what springs lead to, over the noise.
    pub(super) conditions: Vec<[Vector6; 2]>,
}

impl BesideSprings {
    /// Of a file; none where its deflections do not tell springs.
    ///
    /// # Errors
    /// As [`Linearization::at`].
    pub(super) fn of(hexapod: &Hexapod, data: &Dataset) -> Result<Option<Self>, ModelError> {
        let campaign = Campaign::new(hexapod, data)?;
        let mut read: Vec<(Matrix6, Vector6)> = Vec::with_capacity(campaign.groups.len());
        let part = |lin: &Linearization, range: Range<usize>| -> Vec<(Matrix6, Vector6)> {
            let columns = lin.own_common_block();
            let at = |i: usize| columns.fixed_view::<6, 6>(6 * i, 0).into_owned();
            (0..range.len()).map(|i| (at(i), lin.residual(i))).collect()
        };
        Linearization::in_parts(&campaign, &ModelPoint::start(&campaign), part, |some| read.extend(some))?;
        let Some(compliances) = robust(&read) else { return Ok(None) };
        let conditions = read.into_iter().map(|(columns, read)| [read, columns * compliances]).collect();
        Ok(Some(Self { campaign, compliances, conditions }))
    }
}

/// Lines that are far from robust springs.
pub(super) fn far_from_springs(
    data: &Dataset,
    BesideSprings { campaign, conditions, .. }: &BesideSprings,
) -> Vec<Finding> {
    let whole = residuals(campaign, &data.observations, |i| conditions[i][0]);
    let left = residuals(campaign, &data.observations, |i| conditions[i][0] - conditions[i][1]);
    let size = |r: &Residual| r.whitened.norm();
    let usual = quantile(whole.iter().map(size), USUAL).unwrap_or(f64::INFINITY);
    let typical = median(left.iter().map(size)).unwrap_or(f64::INFINITY);
    let limit = (TIMES_USUAL * usual).max(TIMES_MEDIAN * typical);
    let is_gross = |left: &Residual, whole: &Residual| {
        let itself = size(whole).max((whole.whitened - left.whitened).norm());
        size(left) > limit.max(OF_ITSELF * itself)
    };
    let gross: Vec<&Residual> =
        left.iter().zip(&whole).filter(|(left, whole)| is_gross(left, whole)).map(|(left, _)| left).collect();
    // Repeats that agree are no slip of one line: what is wrong with their condition is for the evidence to say. A slip of meters bends
    // what is expected of the other repeats too, by a share of it.
    let mut worst = vec![0.0_f64; campaign.groups.len()];
    for r in &gross {
        worst[r.condition] = worst[r.condition].max(size(r));
    }
    let is_alike = |r: &Residual| size(r) > AGREES * worst[r.condition];
    let mut alike = vec![0; campaign.groups.len()];
    for r in gross.iter().filter(|r| is_alike(r)) {
        alike[r.condition] += 1;
    }
    let agree = |i: usize| campaign.groups[i].rows.len() > 1 && alike[i] == campaign.groups[i].rows.len();
    let alone = gross.iter().filter(|r| is_alike(r) && !agree(r.condition));
    alone.map(|r| finding(campaign, data, r, usual)).collect()
}

/// Compliances that the mass of the conditions has; none where they do not tell them. Of a condition: the columns of the springs, and what
/// was read.
fn robust(conditions: &[(Matrix6, Vector6)]) -> Option<Vector6> {
    // A condition over the size of what its load does: large loads count no more than small ones.
    let over_size = |(column, read): &(Matrix6, Vector6)| {
        let size = column.norm();
        (size > 0.0).then(|| (column / size, read / size))
    };
    let all: Vec<(Matrix6, Vector6)> = conditions.iter().filter_map(over_size).collect();
    let usual = median(all.iter().map(|(_, read)| read.norm()))?;
    let mut compliances: Option<Vector6> = None;
    for _ in 0..ROUNDS {
        let (mut normal, mut right) = (Matrix6::zeros(), Vector6::zeros());
        for (column, read) in &all {
            let weight = match compliances {
                Some(all) => (read - column * all).norm().max(LEAST_SHARE * usual).recip(),
                // No reading counts more than others for being large.
                None => read.norm().max(usual).powi(2).recip(),
            };
            normal += weight * column.tr_mul(column);
            right += weight * column.tr_mul(read);
        }
        let before = compliances.replace(normal.cholesky()?.solve(&right));
        let moved = compliances.zip(before).map(|(now, before)| (now - before).norm() / now.norm());
        if moved.is_some_and(|moved| moved < SETTLED) {
            break;
        }
    }
    compliances.filter(|all| all.iter().all(|c| c.is_finite()))
}

fn finding(campaign: &Campaign, data: &Dataset, left: &Residual, usual: f64) -> Finding {
    let line = data.observations[left.row].line;
    let farthest = left.whitened.iamax();
    let name = campaign.name_of(left.condition, farthest);
    let times = left.whitened.norm() / usual;
    let sigmas = left.farthest().abs();
    let size =
        if sigmas < COUNTED { format!("{sigmas:.0} sigma") } else { format!("more than {COUNTED} sigma") };
    let text = format!(
        "line {line} is {size} away from what the springs lead to at its pose and load, mostly in {name}; nine out of ten deflections in \
         this file are over {times:.0} times smaller"
    );
    blunder(line, size, text, "check the numbers, the load and the pose of this line against the record")
}

#[cfg(test)]
mod tests {
    use hexbench_core::Observation;

    use super::super::gross_readings;
    use super::super::test_cases::{CASES, read};

    /// What happens to a reading.
    type Slip = fn(&mut Observation);

    /// The reading that slips.
    const ROW: usize = 7;

    /// Gross lines of a bundled case with something done to its readings, and the line of the reading that slips.
    fn lines(case: &str, slip: impl Fn(&mut [Observation])) -> (Vec<u64>, u64) {
        let (hexapod, mut data) = read(case);
        slip(&mut data.observations);
        let found = gross_readings(&hexapod, &data).into_iter().flat_map(|f| f.rows).collect();
        (found, data.observations[ROW].line)
    }

    #[test]
    fn slips_of_a_decimal_point_are_found_and_effects_are_not_taken_for_them() {
        let slips: [(&str, Slip); 4] = [
            ("a number", |o| o.measured[0] += 1.0),
            ("an angle", |o| o.measured[4] += 1.0),
            ("a load", |o| o.wrench.force.x += 5e4),
            ("a moment", |o| o.wrench.moment.y += 5e3),
        ];
        for case in CASES {
            assert_eq!(lines(case, |_| ()).0, Vec::<u64>::new(), "{case}");
            for (name, slip) in slips {
                let (found, line) = lines(case, |rows| slip(&mut rows[ROW]));
                assert_eq!(found, [line], "{case}, {name}");
            }
        }
    }

    #[test]
    fn a_part_of_the_file_with_the_other_sign_is_left_to_what_reads_files_otherwise() {
        let turned = |rows: &mut [Observation]| rows.iter_mut().take(12).for_each(|o| o.measured[0] *= -1.0);
        for case in CASES {
            assert_eq!(lines(case, turned).0, Vec::<u64>::new(), "{case}");
        }
    }
}
