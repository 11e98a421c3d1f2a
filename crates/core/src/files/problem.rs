//! Everything that can be wrong with a file, each with its next step.

use super::Dimension;
use std::io;
use thiserror::Error;

/// What is wrong with a file. `Display` states the rule that is broken.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FileProblem {
    // The file itself.
    /// The file does not exist.
    #[error("there is no such file")]
    NoSuchFile,
    /// The name belongs to a folder.
    #[error("this is a folder, not a file")]
    Folder,
    /// The name leads through a file as if it were a folder.
    #[error("a file stands where this name has a folder")]
    FileForFolder,
    /// The system could not read.
    #[error("cannot be read: {0}")]
    Read(#[source] io::Error),
    /// The system could not write.
    #[error("cannot be written: {0}")]
    Write(#[source] io::Error),
    /// No byte, or only blank lines and comments.
    #[error("the file is empty")]
    Empty,
    /// Two bytes per character.
    #[error("the file is UTF-16 that cannot be read: damaged, too long, or without a byte order mark")]
    Utf16,
    /// A byte that is not part of UTF-8 text.
    #[error("byte {byte} of the file is not UTF-8 text")]
    NotUtf8 {
        /// Offset of the byte, from 0.
        byte: usize,
    },
    /// A zero byte.
    #[error("byte {byte} of the file is NUL; this is not a text file, or it is damaged")]
    NulByte {
        /// Offset of the byte, from 0.
        byte: usize,
    },
    /// A line beyond every table.
    #[error("the line is longer than {limit_bytes} bytes")]
    LineTooLong {
        /// The limit.
        limit_bytes: usize,
    },
    /// A file beyond every description of a machine.
    #[error("the file is longer than {limit_bytes} bytes")]
    FileTooLong {
        /// The limit.
        limit_bytes: usize,
    },
    /// More rows than whoever reads the table wants.
    #[error("the table has more than {limit} rows")]
    TooManyRows {
        /// The limit.
        limit: usize,
    },
    /// More columns than a table of readings can mean.
    #[error("the table has {found} columns; the limit is {limit}")]
    TooManyColumns {
        /// How many there are.
        found: usize,
        /// The limit.
        limit: usize,
    },
    /// Lines end with a bare carriage return.
    #[error("lines end with a bare carriage return (old Macintosh style)")]
    CarriageReturnLines,

    // The header of a table.
    /// Only a header.
    #[error("there is a header but no row of measurements")]
    NoRows,
    /// The first line holds numbers.
    #[error("the first line must name the columns, but it contains only numbers")]
    NoHeader,
    /// One column only.
    #[error("no separator found: the header is a single cell")]
    NoSeparator,
    /// A header cell without text.
    #[error("the column has no name")]
    NamelessColumn,
    /// A quantity with a unit is named without one.
    #[error("the name has no unit; {quantity} is {}", kind.with_article())]
    NoUnit {
        /// The quantity.
        quantity: String,
        /// Its kind.
        kind: Dimension,
        /// The name with its usual unit.
        usual: String,
    },
    /// Text in the place of the unit that is no unit.
    #[error("\"{unit}\" is not a known unit; {quantity} is {}", kind.with_article())]
    UnknownUnit {
        /// What stands in the place of the unit.
        unit: String,
        /// The quantity.
        quantity: String,
        /// Its kind.
        kind: Dimension,
        /// The name with its usual unit.
        usual: String,
    },
    /// A unit of another kind.
    #[error("{unit} is a unit of {}, but {quantity} is {}", unit_kind.name(), kind.with_article())]
    WrongKindOfUnit {
        /// The unit in the file.
        unit: String,
        /// What it measures.
        unit_kind: Dimension,
        /// The quantity.
        quantity: String,
        /// Its kind.
        kind: Dimension,
        /// The name with its usual unit.
        usual: String,
    },
    /// An unknown column whose name is near a known one.
    #[error("unknown column; probably \"{suggestion}\" is meant")]
    MisspeltColumn {
        /// The name it is near to, with the unit of the file.
        suggestion: String,
    },
    /// An unknown column whose name is that of a known one elsewhere.
    #[error("unknown column; perhaps \"{suggestion}\" is meant")]
    ForeignColumn {
        /// The column it may stand for, with the unit of the file.
        suggestion: String,
        /// `dx_um is da_um`, one for each such column.
        likely: Vec<String>,
    },
    /// A row of units contradicts the names of the columns.
    #[error("the row of units contradicts the name of the column, which says {named:?}")]
    OtherUnit {
        /// The unit in the name.
        named: &'static str,
    },
    /// One quantity twice.
    #[error("{quantity} is given twice: already in column {first} ({first_name})")]
    DuplicateColumn {
        /// The quantity.
        quantity: String,
        /// Number of the earlier column.
        first: usize,
        /// Name of the earlier column.
        first_name: String,
    },
    /// Required columns that are not there.
    #[error("required columns are missing: {}", names.join(", "))]
    MissingColumns {
        /// Their names, with the usual unit.
        names: Vec<String>,
    },
    /// Required columns that are there under the names of another program.
    #[error("required columns are missing: {}; they may have other names in this file", names.join(", "))]
    OtherNames {
        /// Their names, with the usual unit.
        names: Vec<String>,
        /// `X_mm is a_mm`, one each.
        likely: Vec<String>,
    },
    /// No measured value at all.
    #[error("no measured values: neither deflections (da_um ... dgamma_urad) nor poses (measured_a_mm ...)")]
    NothingMeasured,
    /// A part of an all-or-nothing group.
    #[error("the {group} columns must be complete or absent; missing: {}", names.join(", "))]
    IncompleteGroup {
        /// Common beginning of the names, for example `ref_`.
        group: &'static str,
        /// The missing names, with the usual unit.
        names: Vec<String>,
    },
    /// Deflections and absolute poses in one table.
    #[error("the table contains both deflections (da ...) and absolute poses (measured_a ...)")]
    TwoModes,
    /// Euler differences and rotation vectors in one table.
    #[error("the table contains both Euler differences (dalpha ...) and rotation vectors (drx ...)")]
    TwoRotations,
    /// Reference wrench beside absolute poses.
    #[error("absolute poses have no reference state, but the table has ref_ columns")]
    ReferenceOfAbsolutePose,

    // The cells of a table.
    /// A row of another length than the header.
    #[error("the row has {found} cells, the header has {expected}")]
    CellCount {
        /// Cells in the row.
        found: usize,
        /// Cells in the header.
        expected: usize,
    },
    /// The last line breaks off.
    #[error("the last line ends after {found} of {expected} cells; the file is truncated")]
    Truncated {
        /// Cells in the row.
        found: usize,
        /// Cells in the header.
        expected: usize,
    },
    /// A quotation mark without its partner.
    #[error("a quotation mark is not closed on its line")]
    OpenQuote,
    /// Nothing in a number's cell.
    #[error("the cell is empty; every reading needs a number here")]
    EmptyCell,
    /// Nothing in a cell of a column that may be absent.
    #[error("the cell is empty; every reading needs a number here")]
    EmptyOptionalCell,
    /// A day, which a spreadsheet has made of a number.
    #[error("this is a date; spreadsheets turn numbers such as 3.5 into dates")]
    Date,
    /// Digits in groups.
    #[error("the number is written with thousands separators")]
    Thousands,
    /// A time of day.
    #[error("this is a time of day, not a number")]
    TimeOfDay,
    /// A formula as text.
    #[error("this is a formula, not its value")]
    Formula,
    /// What a spreadsheet writes in a cell that is too narrow.
    #[error("the spreadsheet wrote this because its column was too narrow for the number")]
    TooNarrow,
    /// A word for nothing.
    #[error("this is not a value")]
    NoValue,
    /// Text in a number's cell.
    #[error("this is not a number")]
    NotANumber,
    /// A number that is none.
    #[error("NaN and infinity are not values")]
    NotFinite,
    /// A number beyond every machine, with which nothing can be computed.
    #[error("the number is too large; the limit is 1e30, and 1e24 in SI units")]
    TooLarge,
    /// A comma in a number of a comma-separated table.
    #[error("the number is written with a comma; it needs a decimal point")]
    DecimalComma,
    /// Commas and points in the numbers of one table.
    #[error(
        "numbers with a decimal comma and numbers with a point are mixed; line {other_line} has the other kind"
    )]
    MixedDecimals {
        /// A line of the other kind.
        other_line: u64,
    },
    /// A pose or repeat number with a fraction.
    #[error("this must be a whole number")]
    NotWhole,
    /// An approach other than +1 and -1.
    #[error("approach must be 1 or -1")]
    Approach,
    /// A standard deviation of zero or less.
    #[error("a standard deviation must be greater than zero")]
    Sigma,
    /// An angle beyond a full turn.
    #[error("the angle is {turns:.3} turns; beyond one full turn the unit is probably wrong")]
    AngleTooLarge {
        /// The angle in turns of 360 deg.
        turns: f64,
    },

    // hexapod.toml.
    /// Not TOML.
    #[error("not valid TOML: {0}")]
    Toml(String),
    /// A format this program does not know.
    #[error("the format must be \"{expected}\"")]
    Format {
        /// The format this program reads.
        expected: &'static str,
    },
    /// An unknown key.
    #[error("unknown key{}", suggestion.as_ref().map(|name| format!("; probably \"{name}\" is meant")).unwrap_or_default())]
    UnknownKey {
        /// The name it is near to.
        suggestion: Option<String>,
        /// Keys that may stand there.
        known: Vec<String>,
    },
    /// A key that must be there.
    #[error("the key \"{key}\" is missing")]
    MissingKey {
        /// The key, with its usual unit.
        key: String,
    },
    /// One quantity twice.
    #[error("{quantity} is given twice")]
    DuplicateKey {
        /// The quantity.
        quantity: String,
    },
    /// A value of another type.
    #[error("expected {expected}, found {found}")]
    WrongType {
        /// What belongs there.
        expected: &'static str,
        /// What stands there.
        found: &'static str,
    },
    /// A list of another length.
    #[error("expected {expected}, found {found}")]
    Count {
        /// What belongs there.
        expected: &'static str,
        /// Length of the list.
        found: usize,
    },
    /// Zero or less where a positive number belongs.
    #[error("{quantity} must be greater than zero")]
    NotPositive {
        /// The quantity.
        quantity: &'static str,
    },
    /// Two joints at one point.
    #[error("{side} joints {first} and {second} are at the same point")]
    CoincidingJoints {
        /// `base` or `platform`.
        side: &'static str,
        /// Joint number, from 1.
        first: usize,
        /// Joint number, from 1.
        second: usize,
    },
    /// A leg from a point to itself.
    #[error("leg {leg} has no length at the zero pose: its base and platform joints are at the same point")]
    NoLegLength {
        /// Leg number, from 1.
        leg: usize,
    },
    /// A hexapod smaller than a pinhead or larger than a stadium.
    #[error(
        "the {side} joints are within {size_mm} mm of each other; a hexapod measures between 1 mm and 1000000 mm"
    )]
    MachineSize {
        /// `base` or `platform`.
        side: &'static str,
        /// Greatest distance between two joints of this side.
        size_mm: f64,
    },
    /// Stroke limits in the wrong order.
    #[error("the shortest leg length must be smaller than the longest")]
    Stroke,
    /// A bracket that is not a pair of two different legs.
    #[error("a bracket joins two different legs, numbered 1 to 6")]
    Bracket,

    // Formats defined elsewhere.
    /// A rule of a format that is built on this module.
    #[error("{rule}")]
    Rule {
        /// What is wrong.
        rule: String,
        /// What to do about it, one sentence.
        next: String,
    },
}
