//! Balls touched by a coordinate measuring machine.

use crate::Vector3;

/// A ball and the place of its center, m.
#[derive(Debug, Clone, PartialEq)]
pub struct BallPlace {
    /// Name of the ball.
    pub ball: String,
    /// Center.
    pub centre: Vector3,
}

/// Everything that was touched in one state of the machine.
#[derive(Debug, Clone, PartialEq)]
pub struct BallRecord {
    /// Name of the record as the file gives it.
    pub id: String,
    /// Line of its first ball.
    pub line: u64,
    /// Balls in file order, frame of the measuring machine.
    pub balls: Vec<BallPlace>,
}

/// Where balls should be.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BallPlaces {
    /// Standard deviation of one coordinate, m, when stated.
    pub sigma: Option<f64>,
    /// Balls on the platform, mobile frame.
    pub platform: Vec<BallPlace>,
    /// Balls on the base, fixed frame; none: the frame of the measuring machine is the fixed frame.
    pub base: Vec<BallPlace>,
}

impl BallRecord {
    /// The center of a ball.
    pub fn centre(&self, ball: &str) -> Option<Vector3> {
        self.balls.iter().find(|place| place.ball == ball).map(|place| place.centre)
    }
}
