//! What the readings leave open between physics without a name and a fault of the data.
//!
//! Both show from condition to condition while repeats agree. Where a statement about the data explains what is left nearly as well as a
//! law in the legs, either of them takes its share of the probability of the other.

use super::Look;
use super::finding::Finding;
use super::scatter::{Kind, Statement};
use crate::inference::evidence::log_sum;
use crate::inference::search::Sets;

/// A fault of the data that physics without a name may be behind, or the other way round.
#[derive(Debug, Clone)]
pub struct Doubt {
    /// The fault that explains most.
    pub(super) fault: Finding,
    /// Probability of physics, where it is one of the two.
    physics: f64,
    /// True when the readings are weighed as the fault says.
    is_believed: bool,
}

impl Doubt {
    /// Of statements about readings that are weighed as stated: a fault counts as far as it says more than that there is none.
    pub(super) fn open(look: &Look, faults: &[Statement], fault: Finding) -> Self {
        let all = log_sum(faults.iter().map(|fault| fault.evidence));
        let physics = 1.0 / (1.0 + (all - look.physics.max(look.stated)).exp());
        Self { fault, physics, is_believed: false }
    }

    /// Of readings that are weighed as the fault says, which is less sure for it.
    pub(super) fn believed(look: &Look, mut fault: Finding) -> Self {
        let faults = look.statements.iter().filter(|statement| statement.kind != Kind::Law);
        let all = log_sum(faults.map(|fault| fault.evidence));
        let physics = 1.0 / (1.0 + (all - look.physics).exp());
        fault.probability *= 1.0 - physics;
        Self { fault, physics, is_believed: true }
    }

    /// Probability of a fault that the readings are not weighed by; `outside`: what a search gives to something outside the catalogue.
    pub(super) fn of_fault(&self, outside: f64) -> f64 {
        let by_fault = outside * (1.0 - self.physics);
        if by_fault > 0.0 { by_fault / (self.physics + by_fault) } else { 0.0 }
    }

    /// Moves what is the share of the other: from sets with a discrepancy to those without, or back where the fault is believed. Where it
    /// is not, the fault, and how probable it is. Their order stays that of the search, which has fitted the first.
    pub(crate) fn weigh(mut self, sets: &mut Sets) -> Option<Finding> {
        let outside = sets.outside();
        let both = |one: f64, other: f64| log_sum([one, other].into_iter());
        if self.is_believed {
            for set in &mut sets.sets {
                let (plain, more) = (set.log_weight, set.log_weight_discrepant);
                *set = set.weighing(plain + (-self.physics).ln_1p(), both(more, plain + self.physics.ln()));
            }
            return None;
        }
        let probability = self.of_fault(outside);
        if probability <= 0.0 {
            return None;
        }
        let (moved, kept) = ((probability / outside).ln(), (-probability).ln_1p());
        for set in &mut sets.sets {
            let (plain, more) = (set.log_weight, set.log_weight_discrepant);
            *set = set.weighing(both(plain + kept, more + moved), more + kept);
        }
        self.fault.probability = probability;
        Some(self.fault)
    }
}

#[cfg(test)]
mod tests {
    use super::super::finding::FindingKind;
    use super::super::scatter::Statement;
    use super::*;
    use crate::inference::search::{PRIOR_OF_DISCREPANCY, Set};

    fn fault() -> Finding {
        Finding::of(FindingKind::LoadNoise)
    }

    /// Sets with so much probability in all that something is outside the catalogue.
    fn sets(outside: f64) -> Sets {
        let [plain, more] = [1.0 - outside, outside];
        let weighed = [(&[0][..], 0.8), (&[], 0.2)];
        let set = |(members, share): (&[usize], f64)| {
            Set::of_weights(members, (share * plain).ln(), (share * more).ln())
        };
        Sets { sets: weighed.map(set).to_vec(), log_total: 0.0 }
    }

    fn look(law: f64) -> Look {
        let statement = |kind, evidence| Statement { kind, level: 1.0, evidence };
        Look {
            statements: vec![statement(Kind::Level, 20.0), statement(Kind::Law, law)],
            wide_law: statement(Kind::Law, f64::NEG_INFINITY),
            stated: 0.0,
            physics: law + PRIOR_OF_DISCREPANCY.ln(),
            outside: 0.0,
            rows: Vec::new(),
            names: Default::default(),
            noise: "",
            inputs: Vec::new(),
            instead: None,
            dead_band: None,
            has_more: false,
            is_absolute: false,
            is_complete: true,
        }
    }

    /// Evidence of a law that is as probable as the fault, its rarity counted.
    fn even() -> f64 {
        20.0 - PRIOR_OF_DISCREPANCY.ln()
    }

    #[test]
    fn an_open_fault_takes_its_share_of_what_may_be_outside_and_of_nothing_else() {
        for (law, outside, left) in [(even(), 1.0, 0.5), (even() + 30.0, 1.0, 1.0), (even(), 0.0, 0.0)] {
            let look = look(law);
            let mut sets = sets(outside);
            let told = Doubt::open(&look, &look.statements[..1], fault()).weigh(&mut sets);
            assert!((sets.outside() - left).abs() < 1e-9, "{law} {outside}: {}", sets.outside());
            let probability = told.map_or(0.0, |fault| fault.probability);
            assert!((probability - (outside - left)).abs() < 1e-9, "{law} {outside}: {probability}");
            let plain: f64 = sets.sets.iter().map(|set| sets.probability(set)).sum();
            assert!((plain + sets.outside() - 1.0).abs() < 1e-9, "{plain}");
        }
    }

    #[test]
    fn a_fault_that_says_less_than_none_takes_nothing() {
        let mut look = look(-50.0);
        look.statements[0].evidence = -30.0;
        let mut sets = sets(0.4);
        Doubt::open(&look, &look.statements[..1], fault()).weigh(&mut sets);
        assert!((sets.outside() - 0.4).abs() < 1e-9, "{}", sets.outside());
    }

    #[test]
    fn physics_behind_a_fault_that_is_believed_makes_it_less_sure() {
        let doubt = Doubt::believed(&look(even()), fault());
        assert!((doubt.fault.probability - 0.5).abs() < 1e-9, "{}", doubt.fault.probability);
        let mut sets = sets(0.1);
        assert!(doubt.weigh(&mut sets).is_none());
        assert!((sets.outside() - 0.55).abs() < 1e-9, "{}", sets.outside());
    }
}
