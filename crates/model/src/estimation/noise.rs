//! How large the measurement noise is, and how well that is known.

use std::collections::HashMap;
use std::sync::Arc;

use hexbench_core::statistics::{Welford, root_mean_square};
use hexbench_core::{Dataset, Hexapod, LoadSequence, Matrix6, Observation};

use crate::estimation::campaign::frames_of;
use crate::estimation::frames::ReadingAxes;
use crate::estimation::load_response::{LoadResponse, LoadScatter};
use crate::estimation::residuals::Residual;

/// Where the noise level comes from; in files, its word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(into = "&'static str", try_from = "String")]
pub enum NoiseSource {
    /// `sigma_*` columns of the file.
    Columns,
    /// `[[sensor]]` tables of the hexapod file, beside `[metrology]` and `sigma` columns.
    Sensors,
    /// `[metrology]` of the hexapod file.
    Metrology,
    /// Scatter of repeated readings.
    Repeats,
    /// Residuals of the model itself: no absolute verdict is possible.
    Residuals,
}

hexbench_core::worded! {
    /// One word for files and tables.
    NoiseSource::word {
        Columns => "sigma columns",
        Sensors => "sensors",
        Metrology => "metrology",
        Repeats => "repeats",
        Residuals => "residuals",
    }
}

impl From<NoiseSource> for &'static str {
    fn from(source: NoiseSource) -> Self {
        source.word()
    }
}

impl TryFrom<String> for NoiseSource {
    type Error = String;

    fn try_from(word: String) -> Result<Self, String> {
        let unknown = || format!("`{word}` must be one of {}", Self::ALL.map(Self::word).join(", "));
        Self::named(&word).ok_or_else(unknown)
    }
}

/// A symmetric matrix that weighs readings: its lower triangle, row by row, to seven digits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Symmetric6([f32; 21]);

impl Symmetric6 {
    /// The symmetric matrix with this lower triangle.
    pub fn new(matrix: &Matrix6) -> Self {
        let mut entries = (0..6).flat_map(|i| (0..=i).map(move |j| (i, j)));
        #[allow(clippy::cast_possible_truncation, reason = "weights need no more digits")]
        let short = |at: (usize, usize)| matrix[at] as f32;
        Self(std::array::from_fn(|_| entries.next().map_or(0.0, short)))
    }

    /// The matrix.
    pub fn matrix(&self) -> Matrix6 {
        Matrix6::from_fn(|i, j| f64::from(self.0[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)]))
    }
}

/// What errors of different readings have in common. Shares are of the variance of one reading.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Structure {
    /// Nothing.
    #[default]
    Independent,
    /// Repeats of a condition share an error of the set-up: averaging does not reduce it.
    Setup {
        /// Share of the variance.
        share: f64,
    },
    /// Readings of a record are differences from one reference reading.
    Reference {
        /// Share of the variance.
        share: f64,
        /// What a record is.
        record: SharedReference,
    },
    /// Part of each error resembles that of the row before: the instrument drifts while the file is taken.
    Drift {
        /// Share of the variance.
        share: f64,
        /// Correlation of that part in neighboring rows.
        correlation: f64,
    },
    /// The six coordinates of a reading are not equally good, or err together.
    Axes {
        /// Their covariance, in units of the standard deviations that are stated.
        covariance: Symmetric6,
    },
    /// Loads are not quite as written, condition by condition: the machine yields to what they really are.
    Loads {
        /// How they scatter.
        scatter: LoadScatter,
        /// How the machine yields to them.
        response: LoadResponse,
    },
    /// All legs are longer by one share of their length, condition by condition, as under a temperature that nobody wrote down.
    Lengths {
        /// Standard deviation of the share.
        strain: f64,
    },
}

/// Which readings share a reference.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SharedReference {
    /// All readings at a pose.
    Pose,
    /// The readings of one repeat at a pose.
    Repeat,
    /// Those to which the file gives one number in `ref_record`.
    Named,
}

impl Structure {
    /// True when readings share what the file says they share.
    pub fn has_named_records(self) -> bool {
        matches!(self, Self::Reference { record: SharedReference::Named, .. })
    }

    /// True when both weigh conditions nearly alike, as far as that depends on a model.
    pub(crate) fn weighs_like(self, other: Self) -> bool {
        match (self, other) {
            (Self::Loads { response, .. }, Self::Loads { response: before, .. }) => response.is_like(&before),
            _ => true,
        }
    }

    /// Share of the variance of one reading that is its own.
    pub fn own_share(self) -> f64 {
        match self {
            Self::Independent | Self::Axes { .. } | Self::Loads { .. } | Self::Lengths { .. } => 1.0,
            Self::Setup { share } | Self::Reference { share, .. } | Self::Drift { share, .. } => 1.0 - share,
        }
    }
}

/// Sum of squared whitened errors that tell of the noise level, and their degrees of freedom: repeats, and what a statement is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoiseLevel {
    /// Sum of squares.
    pub sum: f64,
    /// Degrees of freedom: infinite for a level that is exact (as in the GUM, JCGM 100:2008, G.4.3), zero for one of which nothing is known.
    pub dof: f64,
}

impl NoiseLevel {
    /// A level without doubt.
    pub const EXACT: Self = Self { sum: f64::INFINITY, dof: f64::INFINITY };
}

/// Standard deviation of one reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Of a translation, m.
    pub translation: f64,
    /// Of a rotation, rad.
    pub rotation: f64,
    /// Where it comes from.
    pub source: NoiseSource,
    /// Degrees of freedom behind the level: infinite when it is stated (as in the GUM, JCGM 100:2008, G.4.3), zero when taken from residuals.
    pub dof: f64,
    /// What errors have in common.
    pub structure: Structure,
}

impl Noise {
    /// As somebody states it: standard deviations of a translation (m) and of a rotation (rad).
    pub fn stated(translation: f64, rotation: f64) -> Self {
        Self {
            translation,
            rotation,
            source: NoiseSource::Metrology,
            dof: f64::INFINITY,
            structure: Structure::Independent,
        }
    }

    /// The same levels of readings that have nothing in common.
    #[must_use]
    pub fn independent(self) -> Self {
        Self { structure: Structure::Independent, ..self }
    }

    /// Standard deviations of the six measured values.
    pub fn sigma(&self) -> [f64; 6] {
        let (t, r) = (self.translation, self.rotation);
        [t, t, t, r, r, r]
    }

    /// True when somebody has stated the level.
    pub fn is_stated(&self) -> bool {
        matches!(self.source, NoiseSource::Columns | NoiseSource::Sensors | NoiseSource::Metrology)
    }

    /// Degrees of freedom from which the level is known: those of the fit where it comes from its residuals.
    pub fn dof_beside(&self, of_fit: f64) -> f64 {
        if self.source == NoiseSource::Residuals { of_fit } else { self.dof }
    }

    /// True when the level is known well enough to say that a model is adequate.
    pub fn allows_verdict(&self) -> bool {
        self.source != NoiseSource::Residuals
    }
}

/// Scatter of readings repeated under the same pose, loads and approach.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RepeatScatter {
    /// Pooled variance of the translations, m^2.
    pub variance_translation: f64,
    /// Pooled variance of the rotations, rad^2.
    pub variance_rotation: f64,
    /// Degrees of freedom of each (three directions per extra reading).
    pub dof: f64,
}

/// Smallest number of degrees of freedom from which repeats give a usable noise level.
const ENOUGH_REPEATS: f64 = 9.0;

impl RepeatScatter {
    /// The noise that it shows; none of too few repeats.
    pub fn noise(&self) -> Option<Noise> {
        let usable =
            self.dof >= ENOUGH_REPEATS && self.variance_translation > 0.0 && self.variance_rotation > 0.0;
        usable.then(|| Noise {
            translation: self.variance_translation.sqrt(),
            rotation: self.variance_rotation.sqrt(),
            source: NoiseSource::Repeats,
            dof: 2.0 * self.dof,
            structure: Structure::Independent,
        })
    }
}

/// Noise by the rule of the file format: columns, then metrology, then repeats. `None` leaves the residuals.
pub fn stated_or_repeated(hexapod: &Hexapod, dataset: &Dataset) -> Option<Noise> {
    if dataset.has_other_readings() {
        return Some(from_sensors(hexapod, dataset));
    }
    if dataset.columns.sigma {
        return Some(from_columns(&dataset.observations));
    }
    if let Some(m) = hexapod.metrology {
        return Some(Noise::stated(m.sigma_translation, m.sigma_rotation));
    }
    let axes = ReadingAxes::of(&frames_of(hexapod, dataset));
    scatter(dataset, &axes).noise()
}

/// Of readings that are not full poses every number states its own; on the average, of lengths and of angles.
fn from_sensors(hexapod: &Hexapod, dataset: &Dataset) -> Noise {
    let mean = |angles: bool| {
        let of_row = |o: &Observation| {
            let (o, channels) = (*o, dataset.channels(o));
            let counts = move |k: &usize| o.is_read(*k) && channels[*k].is_angle(&hexapod.sensors) == angles;
            (0..6).filter(counts).filter_map(move |k| o.sigma.map(|s| s[k]))
        };
        root_mean_square(dataset.observations.iter().flat_map(of_row))
    };
    let radius = hexapod.platform_radius().max(1e-6);
    let (translation, rotation) = match (mean(false), mean(true)) {
        (Some(t), Some(r)) => (t, r),
        (Some(t), None) => (t, t / radius),
        (None, Some(r)) => (r * radius, r),
        (None, None) => (1e-6, 1e-6 / radius),
    };
    Noise { source: NoiseSource::Sensors, ..Noise::stated(translation, rotation) }
}

fn from_columns(rows: &[Observation]) -> Noise {
    let mean_square = |range: std::ops::Range<usize>| {
        let n = (rows.len() * range.len()).max(1) as f64;
        let row_sum = |r: &Observation| r.sigma.map_or(0.0, |s| s[range.clone()].iter().map(|x| x * x).sum());
        rows.iter().map(row_sum).sum::<f64>() / n
    };
    Noise {
        translation: mean_square(0..3).sqrt(),
        rotation: mean_square(3..6).sqrt(),
        source: NoiseSource::Columns,
        dof: f64::INFINITY,
        structure: Structure::Independent,
    }
}

/// Pooled scatter of full poses read under the same pose, loads and way to them; temperature and time are ignored. Of other readings
/// nothing is pooled: each number of theirs states its own noise.
pub fn scatter(data: &Dataset, axes: &ReadingAxes) -> RepeatScatter {
    scatter_of(data, |row| axes.continuous(&data.observations[row].measured))
}

/// The same of what a model leaves of the readings: what it does from one temperature or time to another is no scatter.
pub fn scatter_beside(data: &Dataset, left: &[Residual]) -> RepeatScatter {
    if left.len() < data.observations.len() {
        return RepeatScatter::default();
    }
    scatter_of(data, |row| left[row].value.into())
}

fn scatter_of(data: &Dataset, numbers: impl Fn(usize) -> [f64; 6]) -> RepeatScatter {
    if data.has_other_readings() {
        return RepeatScatter::default();
    }
    let mut groups: HashMap<([u64; 20], Vec<u64>), [Welford; 6]> = HashMap::new();
    for (index, row) in data.observations.iter().enumerate() {
        let sequence = data.sequences.to(row).map(Arc::as_ref);
        let group = groups.entry((key(row), loads_of(sequence))).or_default();
        group.iter_mut().zip(numbers(index)).for_each(|(all, x)| all.add(x));
    }
    let mut sums = [0.0; 6];
    let mut dof = 0.0;
    // The order of a hash map is not fixed: sort so that sums are the same in every run.
    let mut moments: Vec<[Welford; 6]> = groups.into_values().filter(|m| m[0].count() > 1).collect();
    let squares = |m: &[Welford; 6]| m[0].sum_of_squares();
    moments.sort_by(|a, b| squares(a).total_cmp(&squares(b)).then(a[0].mean().total_cmp(&b[0].mean())));
    for m in moments {
        dof += (m[0].count() - 1) as f64;
        sums.iter_mut().zip(m).for_each(|(sum, one)| *sum += one.sum_of_squares());
    }
    let pooled = |range: std::ops::Range<usize>| sums[range].iter().sum::<f64>() / (3.0 * dof).max(1.0);
    RepeatScatter { variance_translation: pooled(0..3), variance_rotation: pooled(3..6), dof: 3.0 * dof }
}

/// The loads of a sequence, bit by bit; none of no sequence.
fn loads_of(sequence: Option<&LoadSequence>) -> Vec<u64> {
    let past = sequence.map_or(&[][..], |sequence| &sequence.past);
    let numbers = past.iter().flat_map(|load| load.wrench.to_array());
    numbers.map(|x| (x + 0.0).to_bits()).collect()
}

fn key(row: &Observation) -> [u64; 20] {
    let mut key = [0; 20];
    let parts = [row.pose.to_array(), row.wrench.to_array(), row.reference.to_array()];
    for (k, x) in key.iter_mut().zip(parts.iter().flatten().chain(&[row.approach.sign(), row.overload])) {
        *k = (x + 0.0).to_bits();
    }
    key
}
