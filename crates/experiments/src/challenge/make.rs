//! Writing a challenge: public cases, the sealed truth, the manifest.
//!
//! ```text
//! DIR/README.md                 the contract for entrants
//! DIR/cases/case-001/           hexapod.toml, measurements.csv, predict.csv
//! DIR/sealed/case-001/          truth.json, true.csv, measured.csv
//! DIR/challenge.toml            digests of all of these
//! ```

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write};
use std::path::Path;

use hexbench_core::files::{
    MeasurementsWriter, atomic_write, campaign_to_csv, hexapod_to_toml, measurements_to_csv, text_hash,
};
use hexbench_core::{AngleConvention, Dataset, Hexapod};

use crate::challenge::folder::{
    CASES, HEXAPOD, MEASURED, MEASUREMENTS, PREDICT, README, SEALED, TRUE_READINGS, TRUTH, refuse_content,
};
use crate::challenge::stored::json;
use crate::challenge::{ChallengeError, ChallengeSuite, MANIFEST, Manifest, SampledCase, draw};
use crate::error::ExperimentError;
use crate::harness::Progress;

/// The contract for entrants, as it stands in every challenge.
const CONTRACT: &str = include_str!("entrants.md");

/// Makes a challenge in a folder, which must be empty or absent. The same suite and seed give the same bytes.
///
/// # Errors
/// [`ChallengeError::NotEmpty`], [`ChallengeError::Case`], [`ExperimentError::Write`].
pub fn make(
    suite: &ChallengeSuite,
    folder: &Path,
    progress: &dyn Progress,
) -> Result<Manifest, ChallengeError> {
    refuse_content(folder, &[])?;
    let cases = draw(suite, progress)?;
    let mut files = BTreeMap::new();
    let mut keep = |name: String, text: &str| -> Result<(), ChallengeError> {
        write(&folder.join(&name), text)?;
        files.insert(name, text_hash(text));
        Ok(())
    };
    keep(README.to_owned(), CONTRACT)?;
    for case in &cases {
        for (name, text) in files_of(case).map_err(ExperimentError::writing(folder))? {
            keep(name, &text)?;
        }
    }
    let manifest = Manifest::new(suite, cases.into_iter().map(|c| c.id).collect(), files);
    let path = folder.join(MANIFEST);
    let text =
        toml::to_string(&manifest).map_err(|e| ExperimentError::writing(&path)(io::Error::other(e)))?;
    write(&path, &text)?;
    Ok(manifest)
}

fn files_of(case: &SampledCase) -> io::Result<[(String, String); 6]> {
    let public = |name: &str| format!("{CASES}/{}/{name}", case.id);
    let sealed = |name: &str| format!("{SEALED}/{}/{name}", case.id);
    let hexapod = Hexapod { angles: AngleConvention::default(), ..case.hexapod.clone() };
    Ok([
        (public(HEXAPOD), hexapod_to_toml(&hexapod)),
        (public(MEASUREMENTS), read_by(&hexapod, &case.measurements)?),
        (public(PREDICT), asked(&case.measured)?),
        (sealed(TRUTH), json(&case.truth)),
        (sealed(MEASURED), csv(&case.measured)?),
        (sealed(TRUE_READINGS), csv(&case.true_readings)?),
    ])
}

/// What was read, by the sensors of the machine where it has some.
fn read_by(hexapod: &Hexapod, rows: &Dataset) -> io::Result<String> {
    let mut bytes = Vec::new();
    campaign_to_csv(&mut bytes, hexapod, rows)?;
    String::from_utf8(bytes).map_err(io::Error::other)
}

fn csv(rows: &Dataset) -> io::Result<String> {
    let mut bytes = Vec::new();
    measurements_to_csv(&mut bytes, rows)?;
    String::from_utf8(bytes).map_err(io::Error::other)
}

/// Poses and loads with a running number in front, from 1.
fn asked(rows: &Dataset) -> io::Result<String> {
    let writer = MeasurementsWriter::conditions(rows.columns);
    let mut bytes = b"row,".to_vec();
    writer.header(&mut bytes)?;
    for (number, row) in (1..).zip(&rows.observations) {
        write!(bytes, "{number},")?;
        writer.rows(&mut bytes, std::slice::from_ref(row))?;
    }
    String::from_utf8(bytes).map_err(io::Error::other)
}

/// Writes a file whole, its folder too.
pub(crate) fn write(path: &Path, text: &str) -> Result<(), ChallengeError> {
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(ExperimentError::writing(folder))?;
    }
    Ok(atomic_write(path, |out| out.write_all(text.as_bytes())).map_err(ExperimentError::writing(path))?)
}
