//! A fitted model that can be saved, reopened and used: `model.toml`, format `model/1`.
//!
//! Every number of the model is stored in SI with all its digits, so that reading gives the same bits; next to it is
//! the value in the usual unit, and the two must agree. The file contains everything that predictions need: hexapod,
//! springs, terms (a user's term with its definition), frames of absolute mode, covariance, and origin.

mod layout;
mod read;
mod write;

use hexbench_core::{Channel, Hexapod, Measurand, Vector6};
use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::application::reach::Reach;
use crate::effects::user_term::UserTermError;
use crate::estimation::campaign::Campaign;
use crate::estimation::estimate::{Estimates, LegCompliances, Numbers};
use crate::estimation::fit::Fit;
use crate::estimation::linearization::ModelPoint;
use crate::estimation::noise::Noise;
use crate::estimation::parameters::Parameters;

/// Which estimator gave the numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Estimator {
    /// Generalised least squares in whitened units.
    Gls,
    /// The paper's unweighted minimum-norm least squares.
    Paper,
}

hexbench_core::worded! {
    /// Name in files and on the command line.
    Estimator::word { Gls => "gls", Paper => "paper" }
}

/// The data a model was fitted to.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DataOrigin {
    /// Name of the file.
    pub file: String,
    /// SHA-256 of its bytes, hexadecimal.
    pub sha256: String,
    /// Readings used.
    pub readings: usize,
    /// What the files were read as meaning otherwise than they say, as `KIND=VALUE`; absent where they mean what they say.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub read_as: Vec<String>,
    /// Lines of the file that were left out of the fit; absent where every reading was fitted.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub excluded: Vec<u64>,
}

/// A fitted model with everything needed to use it.
#[derive(Debug, Clone)]
pub struct Model {
    /// The machine as drawn.
    pub hexapod: Hexapod,
    /// Kind of measurements it was fitted to.
    pub measurand: Measurand,
    /// How it was fitted.
    pub estimator: Estimator,
    /// Noise of one reading.
    pub noise: Noise,
    /// Values.
    pub point: ModelPoint,
    /// Its numbers.
    pub parameters: Parameters,
    /// Their covariance, SI; shapes by their logarithm.
    pub covariance: DMatrix<f64>,
    /// Whether the data, and not the prior, determine each of them.
    pub determined: Vec<bool>,
    /// What it was fitted to.
    pub data: DataOrigin,
    /// How far that reaches; none in files of versions that did not write it.
    pub reach: Option<Reach>,
    /// Chi-square of the fit.
    pub chi2: f64,
    /// Its degrees of freedom.
    pub dof: f64,
    /// False when the iterations ran out.
    pub settled: bool,
    /// Program and version that made it.
    pub program: String,
}

/// Why a file is no model.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ModelFileError {
    /// The file of a machine.
    #[error("this is the file of a machine (hexapod.toml), not a model fitted to its readings")]
    Machine,
    /// Not TOML, an unknown key, a missing key, a value of another type.
    #[error("{0}")]
    Toml(String),
    /// A key whose value breaks a rule.
    #[error("{key}: {why}")]
    Rule {
        /// The key.
        key: String,
        /// The rule.
        why: String,
    },
    /// A term this program does not have.
    #[error("there is no term `{id}`{}; a user's term needs its definition", nearest.as_ref().map(|n| format!(" (did you mean `{n}`?)")).unwrap_or_default())]
    UnknownTerm {
        /// As written.
        id: String,
        /// The closest known id.
        nearest: Option<String>,
    },
    /// The definition of a user's term is wrong.
    #[error("definition of term `{id}`: {error}")]
    UserTerm {
        /// The term.
        id: String,
        /// What is wrong.
        error: UserTermError,
    },
    /// A file that is not as `fit` wrote it.
    #[error("the file was changed after `fit` wrote it: its numbers do not give the digest in [seal]")]
    Changed,
    /// A file without a digest.
    #[error("the digest of its numbers is missing: [seal] with sha256, which `fit` writes")]
    Unsealed,
    /// A number that cannot be written.
    #[error("the model holds a number that is not finite and cannot be saved: {0}")]
    NotFinite(String),
}

impl Model {
    /// A model from a fit of a campaign.
    pub fn new(campaign: &Campaign, fit: &Fit, estimator: Estimator, data: DataOrigin) -> Self {
        let columns = fit.covariance.ncols();
        Self {
            hexapod: campaign.hexapod.clone(),
            measurand: campaign.measurand,
            estimator,
            noise: campaign.noise,
            point: fit.point.clone(),
            parameters: Parameters::at(&fit.point, campaign.is_absolute()),
            covariance: fit.covariance.clone(),
            determined: (0..columns).map(|k| fit.is_determined(k)).collect(),
            data,
            reach: Some(Reach::of(campaign)),
            chi2: fit.chi2,
            dof: fit.dof,
            settled: fit.is_settled(),
            program: concat!("hexbench ", env!("CARGO_PKG_VERSION")).to_owned(),
        }
    }

    /// The same where so large a share of every spring is open beside, because its legs move otherwise than the model says: predictions
    /// and compensations are as uncertain as that makes them.
    #[must_use]
    pub fn open_by(mut self, share: &Vector6) -> Self {
        for (leg, compliance) in self.point.compliances.iter().enumerate() {
            self.covariance[(leg, leg)] += (compliance * share[leg]).powi(2);
        }
        self
    }

    /// The same without effects that live in the measurement: of the platform, not of its reading.
    pub(crate) fn without_metrology(&self) -> Self {
        let mut model = self.clone();
        for a in model.point.active.iter_mut().filter(|a| a.term.is_of_metrology()) {
            a.values.fill(0.0);
        }
        model
    }

    /// The same in the machine's own frame: the frames of the metrology are taken away.
    pub(crate) fn in_machine_frames(&self) -> Self {
        let mut bare = self.clone();
        bare.point.machine.metrology_frame = nalgebra::Isometry3::identity();
        bare.point.machine.target_frame = nalgebra::Isometry3::identity();
        bare
    }

    /// Standard error of a column, SI.
    pub fn std(&self, column: usize) -> f64 {
        self.covariance[(column, column)].max(0.0).sqrt()
    }

    /// Stiffness of every leg, then the parameters and shape of every term.
    pub fn estimates(&self) -> Estimates {
        let determined: Vec<bool> =
            (0..self.parameters.len()).map(|k| self.determined.get(k).copied().unwrap_or(true)).collect();
        let springs = LegCompliances {
            compliance: self.point.compliances,
            variance: Vector6::from_fn(|leg, _| self.std(leg).powi(2)),
            determined: std::array::from_fn(|leg| determined[leg]),
        };
        let (parameters, point, covariance) = (&self.parameters, &self.point, &self.covariance);
        Numbers { parameters, point, covariance, determined: &determined }.estimates(&springs)
    }

    /// True for a model of absolute poses.
    pub fn is_absolute(&self) -> bool {
        self.measurand == Measurand::AbsolutePose
    }

    /// The numbers that the sensors of the machine read, in the order of their columns; none in a model of absolute poses, for sensors
    /// read deflections.
    pub fn sensor_channels(&self) -> Vec<Channel> {
        if self.is_absolute() { Vec::new() } else { Channel::all([], &self.hexapod.sensors) }
    }

    /// Names of the columns of those numbers, with units.
    pub fn sensor_columns(&self) -> Vec<String> {
        let column = |channel: Channel| channel.column(&self.hexapod.sensors, self.measurand);
        self.sensor_channels().into_iter().map(column).collect()
    }

    /// The text of `model.toml`.
    ///
    /// # Errors
    /// [`ModelFileError::NotFinite`].
    pub fn to_toml(&self) -> Result<String, ModelFileError> {
        let named = self.parameters.iter().zip(self.covariance.column_iter());
        if let Some((parameter, _)) = named.into_iter().find(|(_, c)| !c.iter().all(|x| x.is_finite())) {
            return Err(ModelFileError::NotFinite(format!("the covariance of {}", parameter.name)));
        }
        read::physical(self.point.compliances.as_slice())?;
        let unwritten = |e: toml::ser::Error| ModelFileError::Toml(e.to_string());
        let mut file = write::file(self);
        file.seal.sha256 = file.digest().map_err(unwritten)?;
        toml::to_string(&file).map_err(unwritten)
    }

    /// The model of a `model.toml`.
    ///
    /// # Errors
    /// [`ModelFileError`] with the key and the rule it breaks; [`ModelFileError::Changed`] and [`ModelFileError::Unsealed`] where nothing
    /// else is wrong with a file that is not as it was written.
    pub fn from_toml(text: &str) -> Result<Self, ModelFileError> {
        let file = layout::File::of(text)?;
        let (seal, digest) = (file.seal.sha256.clone(), file.digest());
        let model = read::model(file)?;
        match digest {
            _ if seal.is_empty() => Err(ModelFileError::Unsealed),
            Ok(digest) if digest == seal => Ok(model),
            _ => Err(ModelFileError::Changed),
        }
    }

    /// The same of a file that may have been changed by hand; every other rule holds.
    ///
    /// # Errors
    /// [`ModelFileError`] with the key and the rule it breaks.
    pub fn from_changed_toml(text: &str) -> Result<Self, ModelFileError> {
        read::model(layout::File::of(text)?)
    }
}
