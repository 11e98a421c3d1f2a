//! Poses from ball centers measured on a CMM.
//!
//! The pose `R, t` minimizes `sum |t + R c_i - m_i|^2` over the balls, `c_i` the known places and `m_i` the touched ones.
//! With the centered points as columns of `C` and `M` and `M C' = U S V'`, `R = U diag(1, 1, det(U V')) V'`: the last factor
//! keeps R a rotation; without it three balls, which are always coplanar, give a reflection half the time. Source: W. Kabsch,
//! Acta Cryst. A 34 (1978) 827; K. S. Arun et al., IEEE PAMI 9 (1987) 698; S. Umeyama, IEEE PAMI 13 (1991) 376.
//!
//! With balls on the base each record has a frame of its own, and the pose of the platform is given in it.

mod campaign;
mod distances;
mod records;
mod rigid;

pub use campaign::{
    BallCampaign, BallCampaignError, InstrumentAxes, MovedBall, RecordsRead, STANDARD_GRAVITY,
    campaign_of_balls,
};
pub use distances::{DistanceResidual, distances};
pub use records::{Places, Registered, RegisteredPose, RegistrationError, register_all};
pub use rigid::{Rigid, rigid};
