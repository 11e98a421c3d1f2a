//! Misstatements of files: a sign, a unit, an axis, an order, a frame, a row.
//!
//! A campaign is measured correctly; then one convention is broken throughout a file, as users do, and nothing else changes.
//! Single wrong numbers, misstated noise and the like are faults of the [`laboratory`](crate::laboratory).
//!
//! ```text
//! describe   the file of the machine                  units and order of joints, heights, a digit
//! write      a table of readings                      signs, units, axes, frames, rows
//! hold_out   which readings are handed over as held out
//! ```
//!
//! Adding one: a line in the `MISSTATEMENTS` of the file it belongs to; another kind is a file with [`Misstatement`] for its struct
//! and a line in `files!`. Absolute poses have conventions of their own: an entry says which of the two it is [meant for](MeantFor).

mod numbers;
mod rotations;

use std::fmt::Debug;

use hexbench_core::streams::{Purpose, stream};
use hexbench_core::{Dataset, Hexapod};
use rand_pcg::Pcg64;
use serde_json::Value;

use crate::TruthError;
use crate::campaign::SimulatedCase;

/// One way in which a file does not say what is meant.
pub trait Misstatement: Debug + Send + Sync {
    /// Changes the file of the machine.
    fn describe(&self, _hexapod: &mut Hexapod, _rng: &mut Pcg64) {}

    /// Changes a table of readings; `hexapod` is the machine as it is.
    fn write(&self, _data: &mut Dataset, _hexapod: &Hexapod, _rng: &mut Pcg64) {}

    /// Changes what is handed over as held out.
    ///
    /// # Errors
    /// As [`World::reading`](crate::World::reading), where readings are made for it.
    fn hold_out(&self, _case: &mut SimulatedCase, _rng: &mut Pcg64) -> Result<(), TruthError> {
        Ok(())
    }
}

/// Which files are written so.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MisstatedFile {
    /// `hexapod.toml`.
    Machine,
    /// `measurements.csv` and `holdout.csv` alike, as one author writes both.
    Tables,
    /// `measurements.csv` alone.
    Measurements,
    /// `holdout.csv` alone.
    Holdout,
}

/// What a campaign has to measure for a misstatement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeantFor {
    /// Deflections.
    Deflections,
    /// Absolute poses.
    AbsolutePoses,
}

/// Entry of the registry.
#[derive(Debug, Clone, Copy)]
pub struct MisstatementEntry {
    /// Its id: kebab-case.
    pub id: &'static str,
    /// What the author did, one sentence.
    pub sentence: &'static str,
    /// Words of `findings[].kind` that are right, the best first; several where readings cannot tell them apart.
    pub causes: &'static [&'static str],
    /// Effects of the catalogue that say the same of the machine.
    pub effects: &'static [&'static str],
    /// Where it is written.
    pub file: MisstatedFile,
    /// What was measured.
    pub meant_for: MeantFor,
    /// How.
    pub misstatement: &'static dyn Misstatement,
}

impl MisstatementEntry {
    /// Writes the files of a campaign so; its truth says how.
    ///
    /// # Errors
    /// As [`Misstatement::hold_out`].
    pub fn apply(&self, case: &mut SimulatedCase) -> Result<(), TruthError> {
        // The same stream for both tables: they come from the same hands.
        let rng = || stream(case.spec.seed, Purpose::CaseMisstatement, []);
        let (mut of_measurements, mut of_holdout) = (rng(), rng());
        let machine = case.campaign.world.hexapod.clone();
        let how = self.misstatement;
        match self.file {
            MisstatedFile::Machine => how.describe(&mut case.hexapod, &mut of_measurements),
            MisstatedFile::Tables => {
                how.write(&mut case.measurements, &machine, &mut of_measurements);
                how.write(&mut case.holdout, &machine, &mut of_holdout);
            }
            MisstatedFile::Measurements => how.write(&mut case.measurements, &machine, &mut of_measurements),
            MisstatedFile::Holdout => {
                how.write(&mut case.holdout, &machine, &mut of_holdout);
                how.hold_out(case, &mut of_measurements)?;
            }
        }
        case.truth["misstatement"] = Value::from(self.id);
        Ok(())
    }

    /// True when a word of `findings[].kind` is right.
    pub fn is_caused_by(&self, kind: &str) -> bool {
        self.causes.contains(&kind)
    }

    /// The same that an effect says too.
    const fn or_effects(self, effects: &'static [&'static str]) -> Self {
        Self { effects, ..self }
    }

    /// The same for campaigns that measure absolute poses.
    const fn of_absolute_poses(self) -> Self {
        Self { meant_for: MeantFor::AbsolutePoses, ..self }
    }
}

/// Entries of a file, a line each: where it is written ([`MisstatedFile`]), id, sentence, causes, how; behind it what else holds of it.
macro_rules! entries {
    ($($file:ident $id:literal $sentence:literal, $causes:expr => $how:expr
        $(=> $further:ident($($argument:expr),*))?;)+) => {
        &[$(MisstatementEntry {
            id: $id,
            sentence: $sentence,
            causes: $causes,
            effects: &[],
            file: super::MisstatedFile::$file,
            meant_for: super::MeantFor::Deflections,
            misstatement: &$how,
        }$(.$further($($argument),*))?),+]
    };
}

/// Declares the module of every kind and registers its entries.
macro_rules! files {
    ($($module:ident),+ $(,)?) => {
        $(mod $module;)+

        const FILES: &[&[MisstatementEntry]] = &[$($module::MISSTATEMENTS),+];
    };
}

files! {
    signs,
    reference,
    units,
    instruments,
    axes,
    frames,
    angles,
    points,
    heights,
    legs,
    joints,
    rows,
    copies,
    holdout,
    parts,
    poses,
}

/// All of them.
pub fn registry() -> impl Iterator<Item = &'static MisstatementEntry> + Clone {
    FILES.iter().copied().flatten()
}

/// Entry of an id; none of an unknown one.
pub fn entry(id: &str) -> Option<&'static MisstatementEntry> {
    registry().find(|e| e.id == id)
}
