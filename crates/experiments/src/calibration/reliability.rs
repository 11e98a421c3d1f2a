//! Stated against observed: reliability bins and scores of probabilities.

use hexbench_core::statistics::Proportion;

use super::Claim;

/// Borders of the bins: finer towards certainty, where a mistake costs most.
pub const BORDERS: [f64; 13] = [0.0, 0.01, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95, 0.99, 1.0];

/// Claims of about the same stated probability.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClaimBin {
    /// Borders of the stated probability.
    pub range: [f64; 2],
    /// Mean of what was stated, by weight of the claims.
    pub stated: f64,
    /// Share that was true, by weight of the claims.
    pub observed: f64,
    /// How often it was true, every claim counted once.
    pub came_true: Proportion,
}

/// The bins that hold any claim.
pub fn bins(claims: &[Claim]) -> Vec<ClaimBin> {
    BORDERS.windows(2).filter_map(|b| bin(claims, [b[0], b[1]])).collect()
}

fn bin(claims: &[Claim], range: [f64; 2]) -> Option<ClaimBin> {
    let inside: Vec<&Claim> = claims.iter().filter(|c| is_inside(c.stated, range)).collect();
    let total: f64 = inside.iter().map(|c| c.weight).sum();
    let mean = |f: &dyn Fn(&Claim) -> f64| inside.iter().map(|c| c.weight * f(c)).sum::<f64>() / total;
    let (stated, observed) = (mean(&|c| c.stated), mean(&truth));
    let came_true = Proportion::count(inside, |c| c.is_true);
    (came_true.of > 0).then_some(ClaimBin { range, stated, observed, came_true })
}

fn is_inside(p: f64, [low, high]: [f64; 2]) -> bool {
    p >= low && (p < high || high >= 1.0)
}

/// Scores of stated probabilities, by weight of the claims.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClaimScores {
    /// Number of claims.
    pub claims: usize,
    /// Mean of what was stated.
    pub stated: f64,
    /// Share that was true.
    pub observed: f64,
    /// Brier score: mean of (stated - truth)^2; 0 is perfect.
    pub brier: f64,
    /// Logarithmic score: mean of -ln of the probability given to what was the case, nats; 0 is perfect.
    pub log: f64,
    /// Expected calibration error: mean over the bins of |stated - observed|.
    pub calibration_error: f64,
}

/// Least probability that is taken at its word in the logarithmic score: a search does not weigh what is this improbable.
const FLOOR: f64 = 1e-6;

/// Scores of claims; `None` of nothing.
pub fn scores(claims: &[Claim]) -> Option<ClaimScores> {
    let total: f64 = claims.iter().map(|c| c.weight).sum();
    let mean = |f: &dyn Fn(&Claim) -> f64| claims.iter().map(|c| c.weight * f(c)).sum::<f64>() / total;
    (total > 0.0).then(|| ClaimScores {
        claims: claims.len(),
        stated: mean(&|c| c.stated),
        observed: mean(&truth),
        brier: mean(&|c| (c.stated - truth(c)).powi(2)),
        log: mean(&|c| -(if c.is_true { c.stated } else { 1.0 - c.stated }).max(FLOOR).ln()),
        calibration_error: calibration_error(claims, total),
    })
}

fn truth(claim: &Claim) -> f64 {
    f64::from(u8::from(claim.is_true))
}

fn calibration_error(claims: &[Claim], total: f64) -> f64 {
    let gap = |b: &[f64]| {
        let inside = claims.iter().filter(|c| is_inside(c.stated, [b[0], b[1]]));
        inside.map(|c| c.weight * (c.stated - truth(c))).sum::<f64>().abs()
    };
    BORDERS.windows(2).map(gap).sum::<f64>() / total
}

#[cfg(test)]
mod tests {
    use super::*;

    fn claims(stated: f64, hits: usize, of: usize) -> Vec<Claim> {
        (0..of).map(|k| Claim { stated, is_true: k < hits, weight: 1.0 }).collect()
    }

    #[test]
    fn claims_that_come_true_as_often_as_stated_have_no_calibration_error() {
        let mut all = claims(0.7, 70, 100);
        all.extend(claims(0.25, 25, 100));
        let s = scores(&all).unwrap();
        assert!(s.calibration_error < 1e-12, "{}", s.calibration_error);
        assert!((s.brier - f64::midpoint(0.7 * 0.3, 0.25 * 0.75)).abs() < 1e-12, "{}", s.brier);
    }

    #[test]
    fn overconfidence_shows_in_its_bin_and_in_every_score() {
        let all = claims(0.97, 60, 100);
        let s = scores(&all).unwrap();
        assert!((s.calibration_error - 0.37).abs() < 1e-12, "{}", s.calibration_error);
        let expected = -(0.6 * 0.97_f64.ln() + 0.4 * 0.03_f64.ln());
        assert!((s.log - expected).abs() < 1e-12, "{}", s.log);
        let only = bins(&all);
        assert_eq!((only.len(), only[0].came_true.hits, only[0].came_true.of), (1, 60, 100));
        assert!(only[0].came_true.interval()[1] < only[0].stated);
    }

    #[test]
    fn certainty_has_a_bin() {
        assert_eq!(bins(&claims(1.0, 3, 3)).len(), 1);
        assert!(scores(&[]).is_none());
    }

    #[test]
    fn weights_shift_the_shares() {
        let mut all = claims(0.5, 1, 1);
        all.push(Claim { stated: 0.5, is_true: false, weight: 3.0 });
        assert!((scores(&all).unwrap().observed - 0.25).abs() < 1e-12);
    }
}
