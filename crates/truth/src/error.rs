//! Why a state of the world could not be computed.

/// A situation without an answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum TruthError {
    /// A commanded leg length lies outside the stroke of the machine.
    #[error(
        "leg {leg} would need a length of {length_mm:.3} mm; its range is {shortest_mm:.3} to {longest_mm:.3} mm"
    )]
    Unreachable {
        /// Leg, from 1.
        leg: usize,
        /// Length the pose asks for, mm.
        length_mm: f64,
        /// Shortest length, mm.
        shortest_mm: f64,
        /// Longest length, mm.
        longest_mm: f64,
    },
    /// The legs cannot hold the platform at this pose.
    #[error("singular pose: smallest pivot of the stiffness is {pivot_ratio:.1e} of the largest")]
    Singular {
        /// Smallest over largest pivot of the scaled equations.
        pivot_ratio: f64,
    },
    /// The platform left the neighbourhood of the commanded pose.
    #[error(
        "the platform gave way: {translation_mm:.3} mm and {rotation_deg:.3} deg from the commanded pose"
    )]
    GaveWay {
        /// Distance from the commanded position, mm.
        translation_mm: f64,
        /// Angle from the commanded orientation, deg.
        rotation_deg: f64,
    },
    /// A leg would lengthen under compression.
    #[error("the compliance of leg {leg} at this length is {compliance:.3e} m/N, below zero")]
    NoSpring {
        /// Leg, from 1.
        leg: usize,
        /// Its compliance at the commanded length, m/N.
        compliance: f64,
    },
    /// Newton's method did not settle.
    #[error("no equilibrium after {iterations} iterations: {imbalance_n:.3e} N out of balance")]
    NotConverged {
        /// Iterations done.
        iterations: usize,
        /// Largest imbalance left, in newtons (moments over the platform radius, gaps times the stiffness).
        imbalance_n: f64,
    },
    /// Another world or format lacks the means for a part of the structure.
    #[error("{world} cannot express {what}")]
    Inexpressible {
        /// The world or format.
        world: &'static str,
        /// The part of the structure.
        what: &'static str,
    },
    /// A pose, wrench or parameter is NaN or infinite.
    #[error("{what} is not a finite number")]
    NotFinite {
        /// Which quantity.
        what: &'static str,
    },
    /// Balls do not determine a pose.
    #[error("{found} balls measured, {expected} expected; at least three that are not on a line are needed")]
    Balls {
        /// Balls measured.
        found: usize,
        /// Balls expected.
        expected: usize,
    },
    /// An effect cannot be made as visible as asked for.
    #[error(
        "{id}: distance {wanted} cannot be reached; the largest is {reached:.3}, at {scale:.3e} times the usual size"
    )]
    NotVisible {
        /// Effect.
        id: String,
        /// Distance asked for.
        wanted: f64,
        /// Best distance found.
        reached: f64,
        /// Scale at which it was found.
        scale: f64,
    },
    /// An effect of this size would not be called by its name.
    #[error("{id}: an effect of this size would no longer be of this kind")]
    TooLarge {
        /// Effect.
        id: String,
    },
    /// No effect has this id.
    #[error("there is no mechanism `{id}`")]
    UnknownMechanism {
        /// Id asked for.
        id: String,
    },
    /// The parameters given do not fit the mechanism.
    #[error("parameters of `{id}`: {why}")]
    BadParameters {
        /// Mechanism.
        id: String,
        /// What is wrong.
        why: String,
    },
    /// A file could not be written.
    #[error("{path}: {why}")]
    File {
        /// File or folder.
        path: String,
        /// What the system said.
        why: String,
    },
}
