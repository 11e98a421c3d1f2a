//! What stands behind a plus-minus: a standard uncertainty, or an interval that covers the value with a stated chance.

use statrs::distribution::{ContinuousCDF, Normal, StudentsT};

/// How wide a plus-minus is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum PlusMinus {
    /// One standard uncertainty.
    #[default]
    Standard,
    /// An interval that covers the value in so many of 100 such measurements.
    Percent(f64),
}

impl PlusMinus {
    /// Factor on a standard uncertainty: the normal quantile, that of Student where the noise is known from so many degrees of freedom.
    ///
    /// Source: JCGM 100:2008 (GUM), annex G.
    pub fn factor(self, dof: f64) -> f64 {
        let Self::Percent(percent) = self else { return 1.0 };
        let below = 0.5 + percent / 200.0;
        let normal = || Normal::standard().inverse_cdf(below);
        match StudentsT::new(0.0, 1.0, dof) {
            Ok(student) if dof.is_finite() => student.inverse_cdf(below),
            _ => normal(),
        }
    }

    /// The same where the noise is known from so many degrees of freedom.
    pub fn of(self, dof: f64) -> Wide {
        let factor = self.factor(dof);
        let words = match self {
            Self::Standard => "standard uncertainty (k = 1)".to_owned(),
            Self::Percent(percent) => format!("expanded uncertainty, {percent} % (k = {factor:.2})"),
        };
        Wide { factor, words }
    }
}

/// A plus-minus: its factor on a standard uncertainty, and what it is called.
#[derive(Debug, Clone, PartialEq)]
pub struct Wide {
    /// Factor on a standard uncertainty.
    pub factor: f64,
    /// `standard uncertainty (k = 1)`.
    pub words: String,
}

impl Wide {
    /// What a section says of its numbers.
    pub(super) fn remark(&self) -> String {
        format!("+- {}", self.words)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_those_of_the_tables() {
        let ninety_five = PlusMinus::Percent(95.0);
        for (dof, k) in [(f64::INFINITY, 1.96), (50.0, 2.01), (10.0, 2.23), (3.0, 3.18)] {
            assert!((ninety_five.factor(dof) - k).abs() < 0.005, "{dof}");
        }
        assert!((PlusMinus::Percent(68.27).factor(f64::INFINITY) - 1.0).abs() < 1e-3);
        assert!((PlusMinus::Standard.factor(3.0) - 1.0).abs() < f64::EPSILON);
    }
}
