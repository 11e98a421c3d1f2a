//! How the load of a reading is reached.

/// Way from the reference state to the load; in files +1 and -1, see [`Approach::sign`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Approach {
    /// Loaded from below.
    #[default]
    Direct,
    /// The load is first exceeded and reached coming back.
    Overloaded,
}

impl serde::Serialize for Approach {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.sign().serialize(serializer)
    }
}

impl Approach {
    /// Both ways.
    pub const ALL: [Self; 2] = [Self::Direct, Self::Overloaded];
    /// Factor by which an overloaded approach exceeds the change of load where nobody says: `W0 + 1.4 (W - W0)`.
    pub const OVERLOAD: f64 = 1.4;

    /// +1 or -1, as in the files.
    pub fn sign(self) -> f64 {
        match self {
            Self::Direct => 1.0,
            Self::Overloaded => -1.0,
        }
    }

    /// The way with a sign; none for any other number.
    pub fn of_sign(sign: f64) -> Option<Self> {
        Self::ALL.into_iter().find(|way| way.sign().total_cmp(&sign).is_eq())
    }
}
