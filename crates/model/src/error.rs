//! What can make a computation impossible.

use crate::effects::untestable::Reason;
use crate::estimation::frames::Departure;
use crate::inference::examination::FindingKind;
use hexbench_core::words::upper_first;
use hexbench_core::{LineRange, Pose};
use thiserror::Error;

/// A physical or numerical situation in which no result exists.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ModelError {
    /// The legs do not hold the platform at this pose.
    #[error("{}", singular(pose, *has_no_height))]
    SingularPose {
        /// The pose.
        pose: Pose,
        /// True where base and platform joints lie in one plane there.
        has_no_height: bool,
    },
    /// Fewer equations than unknowns.
    #[error("{equations} equations cannot determine {unknowns} unknowns")]
    TooFewEquations {
        /// Scalar measurements.
        equations: usize,
        /// Parameters.
        unknowns: usize,
    },
    /// Something not finite reached the algebra.
    #[error("a number that is not finite appeared in {what}")]
    NotFinite {
        /// Where.
        what: &'static str,
    },
    /// The loads do not move the legs.
    #[error("no leg changes its force between reference and load in any row: so nothing can be identified")]
    NoLoad,
    /// The term is unknown.
    #[error("there is no term `{id}`{}", nearest.as_ref().map(|n| format!(" (did you mean `{n}`?)")).unwrap_or_default())]
    UnknownTerm {
        /// As asked for.
        id: String,
        /// The closest known id.
        nearest: Option<String>,
    },
    /// Terms that cannot be asked for like this.
    #[error("{0}")]
    Selection(String),
    /// The term cannot be tested with this file.
    #[error("`{id}` cannot be fitted to this file: {why}")]
    Untestable {
        /// The term.
        id: String,
        /// The reason.
        why: Reason,
    },
    /// A parameter combination is not determined by the data.
    #[error("the data do not determine every parameter: {what}")]
    NotDetermined {
        /// The combination in words.
        what: String,
    },
    /// The fit does not settle.
    #[error("the fit did not converge after {iterations} iterations (last relative step {last_step:.1e})")]
    NotConverged {
        /// Iterations made.
        iterations: usize,
        /// Size of the last step relative to the parameters.
        last_step: f64,
    },
    /// Absolute poses are not the commanded ones, in whatever frames.
    #[error(
        "the measured poses{} do not match the commanded ones: in {}, half of them are more than \
         {:.3} mm and {:.3} deg away",
        place(file),
        if file.is_empty() { "the frames that suit them best" } else { "the frames of the fit" },
        1e3 * left.translation,
        left.rotation.to_degrees()
    )]
    Astray {
        /// Name of the data that were read in other frames than those of a fit; empty for the data of the fit themselves.
        file: String,
        /// How far they are.
        left: Departure,
    },
    /// Nothing can be computed from the files as they are written; read otherwise they are sound.
    #[error("{cause}; {meaning}")]
    Misread {
        /// What seems to be wrong.
        kind: FindingKind,
        /// What is impossible as they are written.
        cause: Box<ModelError>,
        /// What they seem to mean.
        meaning: String,
        /// What to do.
        next: String,
    },
    /// Lines to be left out hold no reading.
    #[error("{lines} of the measurements {} no reading", if lines.is_one() { "has" } else { "have" })]
    NoReading {
        /// As asked for.
        lines: LineRange,
        /// Lines of the first and the last reading.
        readings: Option<(u64, u64)>,
    },
    /// Two things that do not belong together.
    #[error("{0}")]
    Mismatch(String),
}

impl ModelError {
    /// What to do about it, one sentence; `data` names the file.
    pub fn next_step(&self, data: &str) -> String {
        match self {
            Self::SingularPose { has_no_height: true, .. } => {
                "Each side seems to be given in its own frame: in the hexapod file, take how far the platform joints are over the base \
                 joints at the zero pose off the z of base_joints_mm."
                    .into()
            }
            Self::SingularPose { .. } => {
                format!("Check the joints in the hexapod file and this pose in {data} (mm, deg).")
            }
            Self::TooFewEquations { .. } => {
                format!("Add readings at other poses and loads to {data}; one pose gives six numbers.")
            }
            Self::NoLoad => format!("Check fx_N ... mz_Nm and ref_fx_N ... ref_mz_Nm in {data}."),
            Self::UnknownTerm { .. } => "`hexbench terms` lists the effects.".into(),
            Self::Selection(_) => {
                "Name each term once; `hexbench terms TERM` says whether it has a richer form.".into()
            }
            Self::Untestable { .. } => "`hexbench terms TERM` says what the data must contain.".into(),
            Self::NotDetermined { .. } => {
                "Measure other poses or load directions, or leave the term out.".into()
            }
            Self::NotFinite { .. } | Self::NotConverged { .. } => {
                format!("Check {data} for readings of wrong size or unit.")
            }
            Self::Astray { file, .. } => format!(
                "Check in {}: units (mm, deg), axes (right-handed, none exchanged), angles (R = Rz(gamma) Ry(beta) Rx(alpha)), and \
                 that each row has the commanded pose; held-out readings must be in the same frames.",
                if file.is_empty() { data } else { file }
            ),
            Self::Misread { next, .. } => format!("{}.", upper_first(next)),
            Self::NoReading { readings, .. } => {
                let where_to = readings
                    .map_or(String::new(), |(a, b)| format!("; its readings are in lines {a} to {b}"));
                format!("Count the lines of {data} from 1, header included{where_to}.")
            }
            Self::Mismatch(_) => "Use a holdout file of the same kind as the data.".into(),
        }
    }
}

fn place(file: &str) -> String {
    if file.is_empty() { String::new() } else { format!(" of {file}") }
}

fn singular(pose: &Pose, has_no_height: bool) -> String {
    let at = describe(pose);
    if has_no_height {
        return format!(
            "base and platform joints lie in one plane at the pose {at}: the legs have no height"
        );
    }
    format!("the pose {at} is singular: the six legs do not determine the motion of the platform")
}

fn describe(pose: &Pose) -> String {
    let x = pose.to_array();
    let deg = |r: f64| r.to_degrees();
    format!(
        "[{:.3}, {:.3}, {:.3}] mm, [{:.3}, {:.3}, {:.3}] deg",
        x[0] * 1e3,
        x[1] * 1e3,
        x[2] * 1e3,
        deg(x[3]),
        deg(x[4]),
        deg(x[5])
    )
}
