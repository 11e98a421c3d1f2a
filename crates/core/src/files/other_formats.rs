//! Files of other programs that are no text, known by how they begin.

use super::FileProblem;

/// How a file begins, what it is, and what to do.
const OTHERS: [(&[u8], &str, &str); 5] = [
    (b"\x1f\x8b", "packed with gzip", "Unpack it first: gunzip FILE."),
    (b"\x28\xb5\x2f\xfd", "packed with zstd", "Unpack it first: zstd -d FILE."),
    (
        b"ARROW1",
        "an Arrow or Feather file",
        "Save the table as Parquet or CSV: to_parquet or to_csv in pandas.",
    ),
    (
        b"\x89HDF",
        "an HDF5 file, perhaps of MATLAB",
        "Export the table as CSV: writetable in MATLAB, to_csv in pandas.",
    ),
    (b"MATLAB ", "a MAT-file of MATLAB", "Export the table as CSV: writetable in MATLAB."),
];

/// What is wrong with a file that begins like one of another program; none for text and workbooks.
pub(super) fn other_format(beginning: &[u8]) -> Option<FileProblem> {
    let (_, what, next) = OTHERS.into_iter().find(|(mark, ..)| beginning.starts_with(mark))?;
    Some(FileProblem::Rule { rule: format!("the file is {what}, not a table of text"), next: next.into() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_of_other_programs_are_told_by_their_name() {
        let told = |bytes: &[u8]| other_format(bytes).map(|problem| problem.to_string()).unwrap_or_default();
        assert!(told(b"\x1f\x8b\x08\0 and so on").contains("gzip"));
        assert!(told(b"ARROW1\0\0").contains("Feather"));
        assert_eq!(told(b"pose,a_mm,b_mm"), "");
        assert_eq!(told(b""), "");
    }
}
