//! Which legs a law concerns, and with which sign or size.

/// Legs of a law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(crate) enum LegChoice {
    /// One size for some of them, `+1`, `-1` or `0` for each.
    Signed([i8; 6]),
    /// A size of its own in each of them.
    Each,
}

/// Even legs, and the opposite in odd ones.
const IN_TURN: LegChoice = LegChoice::Signed([-1, 1, -1, 1, -1, 1]);

impl LegChoice {
    /// All legs alike.
    pub(crate) const ALL: Self = Self::Signed([1; 6]);

    /// Sign of every leg; all `+1` where each has a size of its own.
    pub(crate) fn signs(self) -> [i8; 6] {
        match self {
            Self::Signed(signs) => signs,
            Self::Each => [1; 6],
        }
    }

    /// Numbers of the legs from 1; none when all are concerned.
    pub(crate) fn numbers(self) -> Option<Vec<usize>> {
        let signs = self.signs();
        let some = signs.contains(&0);
        some.then(|| numbers_with(signs, |s| s != 0))
    }

    /// True for even legs against odd ones.
    pub(crate) fn alternates(self) -> bool {
        self == IN_TURN
    }

    /// True when legs differ in sign or size.
    pub(crate) fn differs(self) -> bool {
        self == Self::Each || self.signs().contains(&-1)
    }

    /// Numbers of the legs that go with a size, and of those that go against it, where these are some only.
    pub(crate) fn groups(self) -> Vec<(i8, Option<Vec<usize>>)> {
        let signs = self.signs();
        if self.alternates() || !signs.contains(&-1) {
            return vec![(1, self.numbers())];
        }
        [1, -1].into_iter().map(|sign| (sign, Some(numbers_with(signs, |s| s == sign)))).collect()
    }

    /// As a sentence names them.
    pub(crate) fn words(self) -> String {
        if self.alternates() {
            return "the even legs (the odd ones oppositely)".to_owned();
        }
        if self == Self::Each {
            return "every leg (each to a degree of its own)".to_owned();
        }
        let groups = self.groups();
        let named = groups.iter().map(|(_, numbers)| numbers.as_deref().map_or("all legs".to_owned(), named));
        named.collect::<Vec<_>>().join(" (oppositely in ") + if groups.len() > 1 { ")" } else { "" }
    }

    /// For ids.
    pub(crate) fn slug(self) -> String {
        if self.alternates() {
            return "-in-turn".to_owned();
        }
        if self == Self::Each {
            return "-leg-by-leg".to_owned();
        }
        let joined = |some: &[usize]| some.iter().map(usize::to_string).collect::<String>();
        let groups = self.groups();
        let slugs = groups.iter().filter_map(|(_, numbers)| numbers.as_deref()).map(joined);
        slugs
            .enumerate()
            .map(|(k, legs)| if k == 0 { format!("-legs-{legs}") } else { format!("-{legs}") })
            .collect()
    }
}

fn numbers_with(signs: [i8; 6], of: impl Fn(i8) -> bool) -> Vec<usize> {
    (0..6).filter(|&leg| of(signs[leg])).map(|leg| leg + 1).collect()
}

fn named(numbers: &[usize]) -> String {
    let names: Vec<String> = numbers.iter().map(usize::to_string).collect();
    match names.split_last() {
        Some((last, [])) => format!("leg {last}"),
        Some((last, first)) => format!("legs {} and {last}", first.join(", ")),
        None => String::new(),
    }
}

/// All choices of legs with the logarithm of the prior probability of each.
///
/// All legs alike 0.40, one leg 0.24, legs in turn 0.08, each with its own size 0.06; of two legs 0.12 and oppositely 0.03, three 0.04,
/// four or five 0.03, shared evenly.
pub(crate) fn choices() -> Vec<(LegChoice, f64)> {
    let share = |legs: u32| match legs {
        1 => 0.24 / 6.0,
        2 => 0.12 / 15.0,
        3 => 0.04 / 20.0,
        6 => 0.40,
        _ => 0.03 / 21.0,
    };
    let subsets = (1_u32..64).map(|bits| {
        let legs = LegChoice::Signed(std::array::from_fn(|leg| i8::from(bits >> leg & 1 == 1)));
        (legs, f64::ln(share(bits.count_ones())))
    });
    let opposite = (0..6).flat_map(|i| {
        (i + 1..6).map(move |j| {
            let sign = |leg: usize| i8::from(leg == i) - i8::from(leg == j);
            (LegChoice::Signed(std::array::from_fn(sign)), f64::ln(0.03 / 15.0))
        })
    });
    subsets.chain(opposite).chain([(IN_TURN, 0.08_f64.ln()), (LegChoice::Each, 0.06_f64.ln())]).collect()
}

/// All axes with the logarithm of the prior probability of each.
pub(crate) fn axes() -> Vec<(LegChoice, f64)> {
    let one = |axis: usize| LegChoice::Signed(std::array::from_fn(|k| i8::from(k == axis)));
    (0..6).map(|axis| (one(axis), -f64::ln(6.0))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_prior_over_legs_sums_to_one() {
        let total: f64 = choices().iter().map(|c| c.1.exp()).sum();
        assert!((total - 1.0).abs() < 1e-12, "{total}");
    }

    #[test]
    fn legs_have_words() {
        assert_eq!(LegChoice::ALL.words(), "all legs");
        assert_eq!(LegChoice::Signed([0, 0, 0, 1, 0, 0]).words(), "leg 4");
        assert_eq!(LegChoice::Signed([1, 0, 1, 0, 0, 1]).words(), "legs 1, 3 and 6");
        assert_eq!(LegChoice::Signed([0, 1, 0, 0, -1, 0]).words(), "leg 2 (oppositely in leg 5)");
        assert_eq!(LegChoice::Signed([0, 0, 0, 1, 0, 1]).slug(), "-legs-46");
        assert_eq!(LegChoice::Signed([0, 1, 0, 0, -1, 0]).slug(), "-legs-2-5");
    }
}
