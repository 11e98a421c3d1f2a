//! Measured poses that are far from the commanded ones.
//!
//! Frames that carry most commanded poses to the measured ones are not moved by a few that are wrong, and through them every other reading
//! stands near its command.

use hexbench_core::statistics::median;
use hexbench_core::{Dataset, Hexapod, Observation};

use super::{Finding, TIMES_MEDIAN, blunder};
use crate::estimation::frames::{Departure, Frames, lever};

/// Share of a leg length, or angle in rad, by which no machine errs in one pose.
const NO_MACHINE: f64 = 0.02;

/// Lines of which measured and commanded pose do not belong together.
pub(super) fn far_from_command(hexapod: &Hexapod, data: &Dataset) -> Vec<Finding> {
    let rows = &data.observations;
    let frames = Frames::closest(hexapod, rows);
    let off: Vec<Departure> = rows.iter().map(|row| frames.departure_at(row)).collect();
    let limit = |of: fn(&Departure) -> f64, unit: f64| {
        let typical = median(off.iter().map(of)).unwrap_or(f64::INFINITY);
        (TIMES_MEDIAN * typical).max(NO_MACHINE * unit)
    };
    let limits = Departure {
        translation: limit(|d| d.translation, lever(hexapod)),
        rotation: limit(|d| d.rotation, 1.0),
    };
    rows.iter().zip(&off).filter_map(|(row, off)| finding(row, off, &limits)).collect()
}

/// What is told of a reading that is beyond a limit.
fn finding(row: &Observation, off: &Departure, limits: &Departure) -> Option<Finding> {
    let far = (off.translation > limits.translation).then(|| format!("{:.0} mm", off.translation * 1e3));
    let turned = (off.rotation > limits.rotation).then(|| format!("{:.1} deg", off.rotation.to_degrees()));
    let size = far.into_iter().chain(turned).reduce(|far, turned| format!("{far} and {turned}"))?;
    let text = format!(
        "the pose measured in line {} is {size} from the commanded one, over {TIMES_MEDIAN} times as far as is usual in this file",
        row.line
    );
    let next = "compare the commanded and the measured pose of this line with the record";
    Some(blunder(row.line, size, text, next))
}

#[cfg(test)]
mod tests {
    use hexbench_core::{Columns, Measurand, Pose, Wrench};
    use nalgebra::Isometry3;

    use super::super::gross_readings;
    use super::*;
    use crate::test_machine::machine;

    /// Poses that a machine meets to half a millimeter, seen by an instrument two meters away.
    fn seen() -> Dataset {
        let at = Isometry3::new([1.5, -2.0, 0.4].into(), [0.0, 1.2, 2.0].into());
        let frames = Frames { metrology: at, ..Frames::default() };
        let rows = (0..40_u32).map(|i| {
            let wave = |k: f64| (f64::from(i) * (1.3 + k)).sin();
            let pose: [f64; 6] = std::array::from_fn(|k| if k < 3 { 0.02 } else { 0.1 } * wave(k as f64));
            let wrench = Wrench::default();
            let met: [f64; 6] = std::array::from_fn(|k| pose[k] + 5e-4 * wave(7.0 + k as f64));
            let measured = frames.seen(&Pose::from_array(met)).to_array();
            let unread = Observation::unread(Pose::from_array(pose), wrench, wrench);
            Observation { line: u64::from(2 + i), measured, ..unread }
        });
        Dataset::of_poses("", Measurand::AbsolutePose, Columns::default(), rows.collect())
    }

    fn lines(data: &Dataset) -> Vec<u64> {
        gross_readings(&machine(), data).into_iter().flat_map(|f| f.rows).collect()
    }

    #[test]
    fn a_reading_far_from_its_command_is_gross_and_an_error_of_the_machine_is_not() {
        let sound = seen();
        assert_eq!(lines(&sound), Vec::<u64>::new());
        for (k, size) in [(1, 2.0), (5, 1.0), (3, -0.7)] {
            let mut data = sound.clone();
            data.observations[7].measured[k] += size;
            assert_eq!(lines(&data), [9], "{k} {size}");
        }
        // A millimeter is for the evidence to judge.
        let mut data = sound;
        data.observations[7].measured[0] += 1e-3;
        assert_eq!(lines(&data), Vec::<u64>::new());
    }

    #[test]
    fn a_file_of_which_much_is_far_off_is_not_judged_line_by_line() {
        let mut data = seen();
        data.observations[..8].iter_mut().for_each(|o| o.measured[2] += 1.0);
        assert_eq!(lines(&data), Vec::<u64>::new());
    }
}
