//! What the user does about a problem.

use super::{Dimension, FileProblem};

/// Where a file of a machine and a table of readings seem to have changed places.
pub(super) const FILES_IN_ORDER: &str =
    "Check the names of the files and their order: hexapod.toml comes first, then its measurements.csv.";

impl FileProblem {
    /// What to do next, one sentence.
    pub fn next_step(&self) -> String {
        self.fixed_step().map_or_else(|| self.particular_step(), str::to_owned)
    }

    fn fixed_step(&self) -> Option<&'static str> {
        self.step_for_file().or_else(|| self.step_for_table()).or_else(|| self.step_for_hexapod())
    }

    fn step_for_file(&self) -> Option<&'static str> {
        Some(match self {
            Self::NoSuchFile => "Check the spelling and the folder.",
            Self::Folder => "Name a file inside the folder.",
            Self::FileForFolder => {
                "Name the folder; a scene, for example, is the folder that contains scene.toml."
            }
            Self::Read(_) => "Check that the file may be read and is not in use by another program.",
            Self::Write(_) => "Check the free space and that the folder exists and may be written to.",
            Self::Empty => "Export the measurements again; the first line names the columns.",
            Self::Utf16 | Self::NotUtf8 { .. } => {
                "Save the file as UTF-8 (in a spreadsheet: \"CSV UTF-8\"); um may be written for µm."
            }
            Self::NulByte { .. } => "Export the file again as plain text (UTF-8).",
            Self::LineTooLong { .. } => {
                "Check that this is a table of text with one row per line, not a binary file."
            }
            Self::TooManyRows { .. } => {
                "Check that this is the right file; average repeats, use fewer rows, or allow more (`--max-rows`)."
            }
            Self::TooManyColumns { .. } => {
                "Check that this is the right file, and remove columns that are not readings."
            }
            Self::FileTooLong { .. } => "Check the name; such a file has a few thousand bytes.",
            Self::CarriageReturnLines => "Save the file with line feed or carriage return + line feed ends.",
            _ => return None,
        })
    }

    fn step_for_table(&self) -> Option<&'static str> {
        Some(match self {
            Self::NoRows => "Add one line per reading below the header.",
            Self::NoHeader => "Add a first line with the column names, for example pose,repeat,a_mm,b_mm,...",
            Self::NoSeparator => {
                "Separate the columns with commas (semicolons and tabs are understood too); begin a title above the header with #."
            }
            Self::NamelessColumn => {
                "Name the column, or remove it (pandas: to_csv with index=False); a column named note_1 is always ignored."
            }
            Self::NothingMeasured => {
                "Add da_um, db_um, dc_um, dalpha_urad, dbeta_urad, dgamma_urad, or measured_a_mm ... measured_gamma_deg."
            }
            Self::TwoModes => "Split the table into two files, one for each kind of measurement.",
            Self::TwoRotations => "Keep one of the two sets of rotation columns.",
            Self::ReferenceOfAbsolutePose => {
                "Remove the ref_ columns and give the reference state its own rows."
            }
            Self::CellCount { .. } => {
                "Compare the row with the header; a decimal comma or a comma in a note splits one cell into two."
            }
            Self::Truncated { .. } => "Copy or export the file again, or remove the unfinished line.",
            Self::OpenQuote => "Close the quotation mark, and keep each row on one line.",
            Self::MixedDecimals { .. } => {
                "Write all numbers with a decimal point and without thousands separators."
            }
            _ => return self.step_for_cell(),
        })
    }

    fn step_for_cell(&self) -> Option<&'static str> {
        Some(match self {
            Self::EmptyCell => "Fill in the number, or remove the whole row if the reading failed.",
            Self::EmptyOptionalCell => "Fill in the number, or remove the column: it is optional.",
            Self::Date => {
                "Format the column as a number or as text before the values are entered, and enter them again."
            }
            Self::TimeOfDay => {
                "Write the time as a number in the unit of the column name, such as 330 in a column in s."
            }
            Self::Formula => "Export values instead of formulas, or copy the cells and paste their values.",
            Self::TooNarrow => "Make the column wider and export again.",
            Self::NoValue => {
                "Omit the row; with a hexapod file, a reading that was not taken may be an empty cell."
            }
            Self::Thousands => "Format the numbers without thousands separators and export again.",
            Self::OtherUnit { .. } => {
                "Correct the name or the row of units, whichever is wrong; the row of units is optional."
            }
            Self::NotANumber => "Write a number such as -12.5 or 3e-6; units belong in the column name.",
            Self::NotFinite => "Write the correct number, or omit the whole row or key.",
            Self::TooLarge => "Correct the exponent.",
            Self::DecimalComma => {
                "Write a decimal point, or export with semicolons between the columns and commas in the numbers."
            }
            Self::NotWhole => {
                "Number poses, repeats and references 1, 2, 3, ...; put names into a column note_pose."
            }
            Self::Approach => "Write 1 if the load was approached from below, -1 if it was first exceeded.",
            Self::Sigma => "Give the standard deviation of the reading, or remove all sigma_ columns.",
            Self::AngleTooLarge { .. } => "Check the unit in the column name, for example deg, mrad or urad.",
            _ => return None,
        })
    }

    fn step_for_hexapod(&self) -> Option<&'static str> {
        Some(match self {
            Self::Toml(_) => "Correct the line; docs/reference/file-formats.md shows a complete file.",
            Self::DuplicateKey { .. } => "Keep one of the two keys.",
            Self::WrongType { .. } | Self::Count { .. } => {
                "Correct the value; docs/reference/file-formats.md shows a complete file."
            }
            Self::NotPositive { .. } => "Write a positive value, or remove the key if the value is unknown.",
            Self::CoincidingJoints { .. } => {
                "Correct the copied line; legs may meet only if all six joints of this side meet in three pairs."
            }
            Self::NoLegLength { .. } => {
                "Give both joints in their frames at the zero pose, where the two frames coincide."
            }
            Self::MachineSize { .. } => "Check the unit in the name of the key.",
            Self::Stroke => "Exchange the two limits, or check their units.",
            Self::Bracket => "Write pairs such as [[1, 2], [3, 4], [5, 6]].",
            _ => return None,
        })
    }

    fn particular_step(&self) -> String {
        match self {
            Self::NoUnit { usual, kind, .. }
            | Self::UnknownUnit { usual, kind, .. }
            | Self::WrongKindOfUnit { usual, kind, .. } => named_with_unit(usual, *kind),
            Self::MisspeltColumn { suggestion } => {
                format!("Write {suggestion}, or begin the name with x_ to have the column ignored.")
            }
            Self::ForeignColumn { likely, .. } => format!(
                "Rename the columns, in the file or with --columns: {}; begin the name of a column with x_ to have it ignored.",
                likely.join(", ")
            ),
            Self::DuplicateColumn { first_name, .. } => {
                format!("Keep this column or {first_name}; begin the other name with x_ to have it ignored.")
            }
            Self::MissingColumns { names } => missing_columns(names),
            Self::OtherNames { likely, .. } => format!(
                "Rename them, in the file or with --columns: {}; angles are those of R = Rz(gamma) Ry(beta) Rx(alpha).",
                likely.join(", ")
            ),
            Self::IncompleteGroup { group, names } => {
                format!("Add {}, or remove all {group} columns.", names.join(", "))
            }
            Self::Format { expected } => format!("Write format = \"{expected}\" as the first line."),
            Self::UnknownKey { suggestion: Some(name), .. } => format!("Write {name}."),
            Self::UnknownKey { known, .. } => format!("Remove it; allowed here: {}.", known.join(", ")),
            Self::MissingKey { key } => format!("Add {key}."),
            Self::Rule { next, .. } => next.clone(),
            _ => String::from("Correct the file; docs/reference/file-formats.md shows a complete one."),
        }
    }
}

fn named_with_unit(usual: &str, kind: Dimension) -> String {
    match kind {
        Dimension::Number => format!("Write {usual}, without a unit."),
        kind => format!("Write for example {usual}; units of {}: {}.", kind.name(), kind.unit_names()),
    }
}

fn missing_columns(names: &[String]) -> String {
    let is_load = |name: &String| name.starts_with('f') || name.starts_with('m') && !name.starts_with("me");
    if names.iter().any(|name| matches!(name.as_str(), "record" | "ball" | "side" | "leg")) {
        "Add them, or map them to columns of the table with --columns.".into()
    } else if names.iter().all(is_load) {
        "Add them; write zeros where no such force or moment acts.".into()
    } else {
        "Add them with a unit in the name, for example a_mm or a [mm].".into()
    }
}
