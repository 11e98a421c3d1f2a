//! Is a law of the program linear in its parameters, and does it treat every condition by itself? Checked at made-up conditions.

use super::{LawOfProgram, LawQuestion, is_of_leg};
use crate::effects::term::{ParameterInfo, Scale};
use crate::effects::user_term::linearity::{ENOUGH, TRIALS, sample};
use crate::effects::user_term::variables::describe;
use crate::effects::user_term::{PartKind, UserTermError};

/// Largest relative departure put down to rounding.
const TOLERANCE: f64 = 1e-9;

/// Six numbers of every trial.
type Answers = Vec<[f64; 6]>;

/// A law on trial.
struct Trials<'a> {
    given: &'a LawOfProgram,
    kind: PartKind,
    places: &'a [usize],
    shape: Option<f64>,
}

/// Refuse a law that is not proportional to each parameter and additive in them, or that mixes conditions.
pub(super) fn check(
    given: &LawOfProgram,
    kind: PartKind,
    places: &[usize],
    parameters: &[ParameterInfo],
    grid: &[f64],
) -> Result<(), UserTermError> {
    let trials = Trials { given, kind, places, shape: grid.get(grid.len() / 2).copied() };
    let sizes: Vec<f64> = parameters.iter().map(size_of).collect();
    let alone =
        |k: usize, size: f64| (0..sizes.len()).map(|j| if j == k { size } else { 0.0 }).collect::<Vec<_>>();
    let units: Vec<Answers> = (0..sizes.len()).map(|k| trials.asked(TRIALS, &alone(k, 1.0))).collect();
    let finite = |trial: &usize| units.iter().all(|of| of[*trial].iter().all(|x| x.is_finite()));
    let rows: Vec<usize> = (0..TRIALS).filter(finite).collect();
    if rows.len() < ENOUGH {
        return Err(trials.no_value());
    }
    for (k, parameter) in parameters.iter().enumerate() {
        let tries = [0.0, -0.37, 2.9].map(|factor| alone(k, factor * sizes[k]));
        // The first parameter answers for what is not additive.
        let together = (k == 0).then(|| sizes.clone());
        if tries.into_iter().chain(together).any(|of| differs(&trials.asked(TRIALS, &of), &of, &units, &rows))
        {
            let (formula, parameter) = (given.name.clone(), parameter.name.to_owned());
            return Err(UserTermError::NotLinear { formula, parameter });
        }
    }
    let fewer = TRIALS / 3;
    let rows: Vec<usize> = rows.into_iter().filter(|row| *row < fewer).collect();
    if differs(&trials.asked(fewer, &sizes), &sizes, &units, &rows) {
        let why =
            format!("`{}` gives a condition another value where it is asked for fewer of them", given.name);
        return Err(UserTermError::rule("function", why));
    }
    Ok(())
}

fn size_of(parameter: &ParameterInfo) -> f64 {
    if let Scale::Fixed(size) = parameter.scale { size } else { 1.0 }
}

/// True when answers are not what parameters of these sizes come to by what each does alone.
fn differs(found: &Answers, sizes: &[f64], units: &[Answers], rows: &[usize]) -> bool {
    let wrong = |row: usize, k: usize| {
        let parts = sizes.iter().zip(units).map(|(size, unit)| size * unit[row][k]);
        let [sum, most] = parts.fold([0.0, 0.0], |[sum, most], x| [sum + x, most + x.abs()]);
        let value = found[row][k];
        let off = (value - sum).abs();
        off.is_nan() || off > TOLERANCE * value.abs().max(most)
    };
    rows.iter().any(|&row| (0..6).any(|k| wrong(row, k)))
}

impl Trials<'_> {
    fn asked(&self, trials: usize, sizes: &[f64]) -> Answers {
        let column = |&place: &usize| (0..trials).flat_map(|trial| self.values(trial, place)).collect();
        let variables = self.places.iter().map(column).collect();
        let sizes = sizes.iter().copied().chain(self.shape).collect();
        (self.given.law)(&LawQuestion { conditions: trials, variables, sizes })
    }

    /// Values of a variable at a made-up condition.
    fn values(&self, trial: usize, place: usize) -> Vec<f64> {
        let name = self.kind.variables()[place];
        let of_leg = |leg: usize| {
            if name == "leg" { (leg + 1) as f64 } else { sample(name, trial, place + 50 * leg) }
        };
        let count = if is_of_leg(self.kind, place) { 6 } else { 1 };
        (0..count).map(of_leg).collect()
    }

    fn no_value(&self) -> UserTermError {
        let names = self.kind.variables();
        let (shown, values): (Vec<&str>, Vec<f64>) =
            self.places.iter().map(|&place| (names[place], self.values(0, place)[0])).unzip();
        UserTermError::NoValue { formula: self.given.name.clone(), at: describe(&shown, &values, |_| true) }
    }
}
