//! Which legs a law concerns, and with which sign.

/// Legs of a law, `+1`, `-1` or `0` for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LegSigns(pub [i8; 6]);

/// Even legs, and the opposite in odd ones.
const IN_TURN: LegSigns = LegSigns([-1, 1, -1, 1, -1, 1]);

impl LegSigns {
    /// All legs alike.
    pub const ALL: Self = Self([1; 6]);

    /// Numbers of the legs from 1; none when all are concerned.
    pub fn numbers(&self) -> Option<Vec<usize>> {
        let some = self.0.contains(&0);
        some.then(|| (0..6).filter(|&leg| self.0[leg] != 0).map(|leg| leg + 1).collect())
    }

    /// True when the sign differs from leg to leg.
    pub fn alternates(&self) -> bool {
        *self == IN_TURN
    }

    /// As a sentence names them.
    pub fn words(&self) -> String {
        if self.alternates() {
            return "the even legs (the odd ones oppositely)".to_owned();
        }
        match self.numbers() {
            None => "all legs".to_owned(),
            Some(one) if one.len() == 1 => format!("leg {}", one[0]),
            Some(some) => {
                let names: Vec<String> = some.iter().map(usize::to_string).collect();
                let (last, first) =
                    names.split_last().map_or((String::new(), &[][..]), |(l, f)| (l.clone(), f));
                format!("legs {} and {last}", first.join(", "))
            }
        }
    }

    /// For ids.
    pub fn slug(&self) -> String {
        if self.alternates() {
            return "-in-turn".to_owned();
        }
        let joined = |some: Vec<usize>| some.iter().map(usize::to_string).collect::<String>();
        self.numbers().map_or_else(String::new, |some| format!("-legs-{}", joined(some)))
    }
}

/// All choices of legs with the logarithm of the prior probability of each.
///
/// All legs alike 0.45, one leg 0.25, legs in turn 0.08; of two legs 0.12, three 0.06, four or five 0.04, shared evenly.
pub(crate) fn choices() -> Vec<(LegSigns, f64)> {
    let share = |legs: u32| match legs {
        1 => 0.25 / 6.0,
        2 => 0.12 / 15.0,
        3 => 0.06 / 20.0,
        6 => 0.45,
        _ => 0.04 / 21.0,
    };
    let subsets = (1_u32..64).map(|bits| {
        let legs = LegSigns(std::array::from_fn(|leg| i8::from(bits >> leg & 1 == 1)));
        (legs, f64::ln(share(bits.count_ones())))
    });
    subsets.chain([(IN_TURN, 0.08_f64.ln())]).collect()
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
        assert_eq!(LegSigns::ALL.words(), "all legs");
        assert_eq!(LegSigns([0, 0, 0, 1, 0, 0]).words(), "leg 4");
        assert_eq!(LegSigns([1, 0, 1, 0, 0, 1]).words(), "legs 1, 3 and 6");
        assert_eq!(LegSigns([0, 0, 0, 1, 0, 1]).slug(), "-legs-46");
    }
}
