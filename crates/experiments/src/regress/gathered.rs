//! Samples of all limits, from the trials of one run or of several.

use hexbench_core::files::text_hash;

use super::limit::RegressLimit;
use super::sample::CondensedValues;
use super::trials::SuiteTrials;

/// Hexadecimal digits of a fingerprint: enough to tell two runs apart, no protection against forgery.
const FINGERPRINT: usize = 12;

/// Sample of one limit with a fingerprint of the values behind it.
#[derive(Debug, Clone, PartialEq)]
pub struct LimitSample {
    /// The sample.
    pub sample: CondensedValues,
    /// The same for the same values, to the last bit.
    pub fingerprint: String,
    /// The sample of the first run behind it.
    pub first: CondensedValues,
}

/// Samples of every limit over runs together, in the order of the limits; the fingerprints are those of the first run.
pub fn pool(limits: &[RegressLimit], runs: &[SuiteTrials]) -> Vec<LimitSample> {
    let one = |limit: &RegressLimit| {
        let values: Vec<f64> = runs.iter().flat_map(|t| (limit.values)(t)).collect();
        let first = runs.first().map(|t| (limit.values)(t)).unwrap_or_default();
        let [sample, of_first] = [&values, &first].map(|values| CondensedValues::of(limit.test, values));
        LimitSample { sample, fingerprint: fingerprint(&first), first: of_first }
    };
    limits.iter().map(one).collect()
}

fn fingerprint(values: &[f64]) -> String {
    let bits: Vec<String> = values.iter().map(|v| format!("{:016x}", v.to_bits())).collect();
    text_hash(&bits.concat()).chars().take(FINGERPRINT).collect()
}
