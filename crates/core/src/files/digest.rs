//! The fingerprint of a file, for provenance.

use super::FileError;
use super::source::{is_standard_input, standard_input};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

const CHUNK_BYTES: usize = 1 << 16;

/// SHA-256 of the file's bytes as 64 hexadecimal digits: the same as `sha256sum FILE` prints.
///
/// # Errors
/// When the file cannot be opened or read.
pub fn content_hash(path: &Path) -> Result<String, FileError> {
    hash_of(path).map_err(|cause| FileError::reading(path, cause))
}

/// SHA-256 of a text as 64 hexadecimal digits.
pub fn text_hash(text: &str) -> String {
    hexadecimal(&Sha256::digest(text))
}

fn hash_of(path: &Path) -> io::Result<String> {
    if is_standard_input(path) {
        return Ok(hexadecimal(&Sha256::digest(standard_input()?)));
    }
    let mut file = File::open(path)?;
    let mut digest = Sha256::new();
    let mut chunk = vec![0; CHUNK_BYTES];
    loop {
        match file.read(&mut chunk)? {
            0 => break,
            length => digest.update(&chunk[..length]),
        }
    }
    Ok(hexadecimal(&digest.finalize()))
}

fn hexadecimal(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(2 * bytes.len());
    for byte in bytes {
        // Writing into a String cannot fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hash_is_the_published_sha256_of_abc() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("abc");
        std::fs::write(&path, "abc").unwrap();
        assert_eq!(
            content_hash(&path).unwrap(),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"
        );
    }

    #[test]
    fn a_missing_file_has_no_hash() {
        assert!(content_hash(Path::new("no-such-file")).is_err());
    }
}
