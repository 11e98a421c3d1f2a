//! Touched balls against where the commanded poses put them: axes of the measuring machine, orders of balls, mirror images.

use hexbench_core::{BallPlace, BallRecord, Matrix3, Matrix6, Pose, Vector3};

use super::super::records::angle_map;
use super::super::{Places, RegisteredPose, RegistrationError, Rigid, rigid};
use super::BallCampaignError;
use super::order::orders;

/// Balls this share of their spread from where they are commanded do not follow the commands.
const ASTRAY: f64 = 0.1;
/// An explanation has to leave this share of what the file as it stands leaves.
const FAR_BETTER: f64 = 0.2;

/// How the axes of a measuring machine stand to those of the hexapod, by its commanded poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InstrumentAxes {
    /// Angle between them, rad.
    pub angle: f64,
    /// Standard error of that angle by what the records leave, rad.
    pub uncertainty: f64,
    /// Distance of the origins, m.
    pub shift: f64,
}

/// Records seen from the base, and where they should be.
pub(super) struct Placing<'a> {
    records: &'a [BallRecord],
    places: &'a [BallPlace],
    commands: Vec<(usize, Pose)>,
    /// Balls of the platform of each record in the order of the places; in the frame of the base balls where there are some.
    centres: Vec<Vec<Vector3>>,
    /// From commanded to touched; none with balls on the base.
    frame: Option<Rigid>,
}

/// What turns readings into fixed axes.
pub(super) struct Fixed {
    frame: Option<(Matrix3, Vector3)>,
}

impl<'a> Placing<'a> {
    /// Balls of the records that rows name, each with its commanded pose.
    pub(super) fn new(
        records: &'a [BallRecord],
        places: &'a Places,
        commands: &[(usize, Pose)],
    ) -> Result<Self, BallCampaignError> {
        let mut centres = vec![Vec::new(); records.len()];
        for (k, _) in commands {
            centres[*k] = seen(&records[*k], places)?;
        }
        let mut placing =
            Self { records, places: &places.platform, commands: commands.to_vec(), centres, frame: None };
        if places.base.is_empty() {
            placing.frame = placing.fitted(|p| p);
        }
        Ok(placing)
    }

    /// Balls of a record in the order of the places.
    pub(super) fn centres(&self, record: usize) -> &[Vector3] {
        &self.centres[record]
    }

    /// Motion from commanded to touched balls of all records, after a change of the touched ones.
    fn fitted(&self, change: impl Fn(Vector3) -> Vector3) -> Option<Rigid> {
        let known: Vec<Vector3> = self.commands.iter().flat_map(|(_, pose)| self.commanded(pose)).collect();
        let touched: Vec<Vector3> =
            self.commands.iter().flat_map(|(k, _)| self.centres[*k].iter().map(|p| change(*p))).collect();
        rigid(&known, &touched)
    }

    fn commanded(&self, pose: &Pose) -> Vec<Vector3> {
        let r = pose.rotation();
        self.places.iter().map(|place| pose.translation + r * place.centre).collect()
    }

    /// The same in the frame of the measuring machine.
    fn expected(&self, pose: &Pose) -> Vec<Vector3> {
        let carried = |p: Vector3| match &self.frame {
            Some(frame) => frame.translation + frame.rotation * p,
            None => p,
        };
        self.commanded(pose).into_iter().map(carried).collect()
    }

    fn spread(&self) -> f64 {
        let count = self.places.len().max(1) as f64;
        let centre: Vector3 = self.places.iter().map(|p| p.centre).sum::<Vector3>() / count;
        (self.places.iter().map(|p| (p.centre - centre).norm_squared()).sum::<f64>() / count).sqrt()
    }

    /// Refuses balls in another order than their names, mirror images, and records that follow no command.
    pub(super) fn refuse_other_orders(&self) -> Result<(), BallCampaignError> {
        self.refuse_mirror_image()?;
        let limit = ASTRAY * self.spread();
        let worst = self.commands.iter().map(|command| (self.left(command), command));
        let Some((left, (record, pose))) = worst.max_by(|a, b| a.0.total_cmp(&b.0)) else { return Ok(()) };
        if left < limit {
            return Ok(());
        }
        if let Some(exchanged) = self.exchanged(*record, pose, left) {
            return Err(exchanged);
        }
        let BallRecord { id, line, .. } = &self.records[*record];
        Err(BallCampaignError::Astray { line: *line, record: id.clone(), left_mm: left * 1e3 })
    }

    /// Root mean square distance of the balls of a record from where its command puts them, m.
    fn left(&self, (record, pose): &(usize, Pose)) -> f64 {
        apart(&self.expected(pose), &self.centres[*record])
    }

    fn refuse_mirror_image(&self) -> Result<(), BallCampaignError> {
        let rms = |fit: &Rigid| (fit.sum_of_squares() / fit.residuals.len() as f64).sqrt();
        let mirror = |p: Vector3| Vector3::new(p.x, p.y, -p.z);
        let both = self.fitted(|p| p).zip(self.fitted(mirror));
        let Some((left, mirrored)) = both.map(|(as_touched, other)| (rms(&as_touched), rms(&other))) else {
            return Ok(());
        };
        if mirrored < FAR_BETTER * left {
            return Err(BallCampaignError::Mirrored { left_mm: left * 1e3, mirrored_mm: mirrored * 1e3 });
        }
        Ok(())
    }

    /// Another order of the names that makes a record follow its command.
    fn exchanged(&self, record: usize, pose: &Pose, left: f64) -> Option<BallCampaignError> {
        let (expected, touched) = (self.expected(pose), &self.centres[record]);
        let by_order = orders(touched.len()).into_iter().map(|order| {
            let named: Vec<Vector3> = order.iter().map(|k| touched[*k]).collect();
            (apart(&expected, &named), order)
        });
        let (best, order) = by_order.min_by(|a, b| a.0.total_cmp(&b.0))?;
        if best > FAR_BETTER * left {
            return None;
        }
        let name = |k: usize| &self.places[k].ball;
        let others = order.iter().enumerate().filter(|(k, other)| k != *other);
        Some(BallCampaignError::Exchanged {
            line: self.records[record].line,
            record: self.records[record].id.clone(),
            exchanged: others.map(|(k, other)| format!("{} for {}", name(k), name(*other))).collect(),
        })
    }

    /// How the axes of the measuring machine stand.
    pub(super) fn axes(&self) -> Option<InstrumentAxes> {
        let frame = self.frame.as_ref()?;
        let variance = frame.sum_of_squares() / frame.degrees_of_freedom().max(1) as f64;
        Some(InstrumentAxes {
            angle: angle_of(&frame.rotation),
            uncertainty: (variance * frame.cofactors.fixed_view::<3, 3>(3, 3).trace() / 3.0).sqrt(),
            shift: frame.translation.norm(),
        })
    }

    /// What turns readings into fixed axes: nothing unless asked for.
    pub(super) fn fixed(&self, align: bool) -> Fixed {
        let frame = self.frame.as_ref().filter(|_| align);
        Fixed { frame: frame.map(|frame| (frame.rotation.transpose(), frame.translation)) }
    }
}

impl Fixed {
    /// A pose in fixed axes, and its covariance.
    pub(super) fn pose(&self, seen: &RegisteredPose) -> (Pose, Matrix6) {
        let Some((back, origin)) = &self.frame else { return (seen.pose, seen.covariance) };
        let turned = back * seen.pose.rotation();
        let pose = Pose::from_rotation(back * (seen.pose.translation - origin), &turned);
        let mut turn = Matrix6::zeros();
        turn.fixed_view_mut::<3, 3>(0, 0).copy_from(back);
        turn.fixed_view_mut::<3, 3>(3, 3).copy_from(back);
        let from_angles = angle_map(&seen.pose).try_inverse().unwrap_or_else(Matrix6::identity);
        let map = angle_map(&pose) * turn * from_angles;
        (pose, map * seen.covariance * map.transpose())
    }

    /// A direction in fixed axes.
    pub(super) fn turned(&self, direction: &Vector3) -> Vector3 {
        self.frame.as_ref().map_or(*direction, |(back, _)| back * direction)
    }
}

/// Balls of the platform in the frame of the base balls, or as touched.
fn seen(record: &BallRecord, places: &Places) -> Result<Vec<Vector3>, RegistrationError> {
    let touched = |all: &[BallPlace]| -> Vec<Vector3> {
        all.iter().filter_map(|place| record.centre(&place.ball)).collect()
    };
    let platform = touched(&places.platform);
    if places.base.is_empty() {
        return Ok(platform);
    }
    let known: Vec<Vector3> = places.base.iter().map(|place| place.centre).collect();
    let base = rigid(&known, &touched(&places.base))
        .ok_or_else(|| RegistrationError::Undetermined { line: record.line, record: record.id.clone() })?;
    Ok(platform.iter().map(|p| base.rotation.transpose() * (p - base.translation)).collect())
}

/// Root mean square distance of points, m.
fn apart(one: &[Vector3], other: &[Vector3]) -> f64 {
    let squares: f64 = one.iter().zip(other).map(|(a, b)| (a - b).norm_squared()).sum();
    (squares / one.len().max(1) as f64).sqrt()
}

/// Angle of a rotation, rad; accurate for small ones.
fn angle_of(r: &Matrix3) -> f64 {
    let axis = Vector3::new(r[(2, 1)] - r[(1, 2)], r[(0, 2)] - r[(2, 0)], r[(1, 0)] - r[(0, 1)]);
    (axis.norm() / 2.0).atan2((r.trace() - 1.0) / 2.0)
}
