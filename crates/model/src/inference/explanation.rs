//! What a probability of a diagnosis belongs to.

use std::cmp::Ordering;
use std::fmt;

use serde::{Deserialize, Serialize};

/// An explanation of what the springs leave; in files one word: the id of a term, `outside` or `none`. Ordered by its word.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(into = "String", from = "String")]
pub enum Explanation {
    /// A term, by its id.
    Term(String),
    /// Something no term describes.
    Outside,
    /// Nothing is left to explain.
    Nothing,
}

impl Explanation {
    /// The explanations that are not terms.
    pub const SPECIAL: [Self; 2] = [Self::Outside, Self::Nothing];

    /// One word, as in the files.
    pub fn word(&self) -> &str {
        match self {
            Self::Term(id) => id,
            Self::Outside => "outside",
            Self::Nothing => "none",
        }
    }

    /// Id of the term, when it is one.
    pub fn term(&self) -> Option<&str> {
        match self {
            Self::Term(id) => Some(id),
            Self::Outside | Self::Nothing => None,
        }
    }

    /// True for the term of this id.
    pub fn is_term(&self, id: &str) -> bool {
        self.term() == Some(id)
    }
}

impl From<&str> for Explanation {
    fn from(word: &str) -> Self {
        Self::SPECIAL.into_iter().find(|e| e.word() == word).unwrap_or_else(|| Self::Term(word.to_owned()))
    }
}

impl From<String> for Explanation {
    fn from(word: String) -> Self {
        Self::from(word.as_str())
    }
}

impl From<Explanation> for String {
    fn from(explanation: Explanation) -> Self {
        explanation.word().to_owned()
    }
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.word())
    }
}

impl PartialOrd for Explanation {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Explanation {
    fn cmp(&self, other: &Self) -> Ordering {
        self.word().cmp(other.word())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_term_is_known_by_its_id() {
        let all = ["base-compliance", "outside", "none"].map(Explanation::from);
        assert_eq!(all.clone().map(|e| e.is_term("base-compliance")), [true, false, false]);
        assert_eq!(all.map(|e| e.is_term("creep")), [false; 3]);
    }
}
