//! The token of a server, and ids nobody can guess.

use std::fmt::Write;
use std::io;

use subtle::ConstantTimeEq;

/// Bytes from the operating system: 256 bits.
const BYTES: usize = 32;

/// A secret.
#[derive(Clone)]
pub(super) struct Token([u8; BYTES]);

impl Token {
    /// From the operating system.
    pub(super) fn random() -> io::Result<Self> {
        let mut bytes = [0; BYTES];
        getrandom::fill(&mut bytes).map_err(io::Error::other)?;
        Ok(Self(bytes))
    }

    /// As hexadecimal digits.
    pub(super) fn text(&self) -> String {
        hexadecimal(&self.0)
    }

    /// The bytes, as a key.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.0
    }
}

/// Lower-case hexadecimal digits.
pub(super) fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::with_capacity(2 * bytes.len()), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// Equal? Takes as long for a near miss as for a far one; only the length shows.
pub(super) fn same(a: &[u8], b: &[u8]) -> bool {
    a.ct_eq(b).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_token_is_64_digits_and_no_two_are_alike() {
        let (a, b) = (Token::random().unwrap().text(), Token::random().unwrap().text());
        assert!(a.len() == 64 && a.bytes().all(|c| c.is_ascii_hexdigit()), "{a}");
        assert_ne!(a, b);
    }

    #[test]
    fn texts_are_the_same_only_when_every_byte_is() {
        assert!(same(b"0123", b"0123"));
        assert!(!same(b"0123", b"0124") && !same(b"0123", b"012") && !same(b"", b"0"));
    }
}
