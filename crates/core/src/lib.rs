//! Types and units of hexapod elastostatics, their files, random streams and statistics. No physics.
//!
//! Conventions (every public item follows them unless it says otherwise):
//!
//! - The fixed (base) frame and the mobile (platform) frame coincide at the zero pose.
//! - A pose is `[a, b, c, alpha, beta, gamma]` with extrinsic X-Y-Z angles, `R = Rz(gamma) Ry(beta) Rx(alpha)`.
//! - A wrench `[F; M]` is applied *to the platform*, at the mobile origin, in fixed axes.
//! - SI units inside (m, rad, N, N m, K, s); units appear in names only at the boundaries (files, arguments,
//!   pages).

pub mod angles;
pub mod approach;
pub mod balls;
pub mod calendar;
pub mod dataset;
mod drawn;
pub mod files;
pub mod hexapod;
pub mod interrupt;
pub mod line_range;
pub mod load_sequence;
pub mod loads;
mod pairs;
pub mod parallel;
pub mod parser_words;
pub mod pose;
pub mod remembered;
pub mod rings;
pub mod sensor;
pub mod spread;
pub mod statistics;
pub mod streams;
pub mod tolerances;
pub mod visible;
mod worded;
pub mod words;
pub mod wrench;

pub use angles::AngleConvention;
pub use approach::Approach;
pub use balls::{BallPlace, BallPlaces, BallRecord};
pub use dataset::{Columns, Dataset, Measurand, Observation};
pub use hexapod::{Hexapod, Metrology};
pub use line_range::{LineRange, NoLines};
pub use load_sequence::{LoadSequence, LoadSequences, PastLoad};
pub use loads::{HungMasses, LoadRow, LoadTable};
pub use pairs::pairs_of_six;
pub use pose::Pose;
pub use remembered::Remembered;
pub use rings::JointCircle;
pub use sensor::{Channel, NumberKind, PoseFunction, Sensor, SensorInput, SensorKind, UNREAD};
pub use spread::{spread, spread_of};
pub use tolerances::{StatedTolerances, Tolerances};
pub use visible::{visible, visible_json, visible_lines};
pub use wrench::Wrench;

/// A point or direction, meters or unit length.
pub type Vector3 = nalgebra::Vector3<f64>;
/// Six numbers in the order translation, rotation (or one per leg).
pub type Vector6 = nalgebra::Vector6<f64>;
/// A rotation matrix or other 3x3 block.
pub type Matrix3 = nalgebra::Matrix3<f64>;
/// A 6x6 matrix such as a Jacobian, stiffness or compliance.
pub type Matrix6 = nalgebra::Matrix6<f64>;
