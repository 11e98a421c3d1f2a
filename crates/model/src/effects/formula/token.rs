//! From characters to words of a formula.

use super::FormulaError;

/// A word with its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Token {
    pub(super) kind: TokenKind,
    /// Place of its first character, from 1.
    pub(super) position: usize,
}

/// A word.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum TokenKind {
    Number(f64),
    Name(String),
    /// One of `+ - * / ^ ( ) ,`.
    Symbol(char),
}

/// All words of a text.
pub(super) fn tokens(text: &str) -> Result<Vec<Token>, FormulaError> {
    let characters: Vec<char> = text.chars().collect();
    let (mut all, mut at) = (Vec::new(), 0);
    while at < characters.len() {
        let first = characters[at];
        if first.is_whitespace() {
            at += 1;
            continue;
        }
        let length = match first {
            '0'..='9' | '.' => number_length(&characters[at..]),
            'a'..='z' | 'A'..='Z' | '_' => {
                count(&characters[at..], |c| c.is_ascii_alphanumeric() || c == '_')
            }
            _ => 1,
        };
        let word: String = characters[at..at + length].iter().collect();
        all.push(Token { kind: kind(word, first, at + 1)?, position: at + 1 });
        at += length;
    }
    Ok(all)
}

fn kind(word: String, first: char, position: usize) -> Result<TokenKind, FormulaError> {
    match first {
        '0'..='9' | '.' => match word.parse::<f64>() {
            Ok(number) if number.is_finite() => Ok(TokenKind::Number(number)),
            _ => Err(FormulaError::Number { text: word, position }),
        },
        'a'..='z' | 'A'..='Z' | '_' => Ok(TokenKind::Name(word)),
        '+' | '-' | '*' | '/' | '^' | '(' | ')' | ',' => Ok(TokenKind::Symbol(first)),
        character => Err(FormulaError::Character { character, position }),
    }
}

fn count(characters: &[char], belongs: impl Fn(char) -> bool) -> usize {
    characters.iter().take_while(|c| belongs(**c)).count()
}

/// Digits and points, then an exponent with its sign.
fn number_length(characters: &[char]) -> usize {
    let mantissa = count(characters, |c| c.is_ascii_digit() || c == '.');
    let rest = &characters[mantissa..];
    if !matches!(rest.first(), Some('e' | 'E')) {
        return mantissa;
    }
    let sign = usize::from(matches!(rest.get(1), Some('+' | '-')));
    mantissa + 1 + sign + count(&rest[1 + sign..], |c| c.is_ascii_digit())
}
