//! The files of the bench: readers with exact messages, writers that write a file completely or not at all.
//!
//! | file | read | write |
//! |---|---|---|
//! | `measurements.csv` | [`read_campaign`], without sensors [`read_measurements`] | [`write_campaign`], of full poses [`write_measurements`] |
//! | poses and loads to predict | [`read_conditions`] | - |
//! | poses and loads to be measured | [`read_plan`] | - |
//! | any of these, in memory | [`read_columns`] | [`campaign_to_columns`] |
//! | `balls.csv`, `balls.toml` | [`read_balls`], [`read_ball_places`] | - |
//! | `loads.csv` | [`read_loads`] | - |
//! | `hexapod.toml` | [`read_hexapod`] | [`hexapod_to_toml`], [`write_hexapod`] |
//! | MJCF, URDF, SDF | [`read_robot`] | - |
//! | any other TOML | [`read_toml`] | - |
//! | any other | [`content_hash`] | [`atomic_write`] |
//!
//! A file is checked completely before anyone sees it: what a reader returns is finite, in SI units, and of the
//! right shape. What cannot be read is a [`FileError`] with place, value, rule and next step; what was read but
//! should be looked at is a [`Warning`]. `docs/reference/file-messages.md` lists the messages.

mod atomic;
mod column_name;
mod column_names;
mod columns;
mod csv_text;
mod destination;
mod dialect;
mod digest;
mod duplicates;
mod error;
mod header;
mod layouts;
mod line;
mod lines;
mod load_columns;
mod nearest;
mod next_step;
mod number;
mod other_formats;
mod other_names;
mod place;
mod point_header;
mod points;
mod problem;
mod read_balls;
mod read_columns;
mod read_conditions;
mod read_hexapod;
mod read_joints;
mod read_loads;
mod read_measurements;
mod read_sensor;
mod records;
mod robot;
mod row;
mod sensor_columns;
mod source;
mod spreadsheet;
mod stated_unit;
mod table;
mod toml_file;
mod toml_value;
mod unit_row;
mod units;
mod warning;
mod write_campaign;
mod write_hexapod;
mod write_measurements;

pub use atomic::{atomic_write, open_to_readers};
pub use column_names::{ColumnNames, read_column_names};
pub use csv_text::{CsvText, csv_cell, csv_words};
pub use destination::{Destination, Overlap, is_file, refuse_overlap};
pub use digest::{content_hash, text_hash};
pub use error::{Fault, FileError};
pub use header::GroupPurpose;
pub use nearest::{instead_of, nearest};
pub use place::FilePlace;
pub use points::BallTable;
pub use problem::FileProblem;
pub use read_balls::{read_ball_places, read_balls, read_balls_records};
pub use read_columns::{Cells, MemoryColumn, read_columns};
pub use read_conditions::{read_conditions, read_conditions_named, read_plan};
pub use read_hexapod::{parse_hexapod, read_hexapod};
pub use read_joints::read_joints;
pub use read_loads::{read_loads, read_loads_records};
pub use read_measurements::{
    read_campaign, read_campaign_from, read_campaign_named, read_campaign_records, read_measurements,
    read_measurements_from,
};
pub use read_sensor::{SENSOR_WITH_COST, point, sensor_name, sensor_of, sensors, unit_vector};
pub use records::Records;
pub use robot::{MobileFrame, RobotJoints, parse_robot, read_robot};
pub use table::TableReading;
pub use toml_file::{Format, read_text, read_toml, read_toml_text};
pub use toml_value::{Item, KeyUnit, TomlSection};
pub use units::{Dimension, UNITS, Unit, unit_named};
pub use warning::{Notice, Warning};
pub use write_campaign::{campaign_to_columns, campaign_to_csv, write_campaign};
pub use write_hexapod::{hexapod_to_commented_toml, hexapod_to_toml, write_hexapod};
pub use write_measurements::{
    MeasurementsWriter, conditions_to_columns, measurements_to_columns, measurements_to_csv,
    write_measurements,
};
