//! What is told of inputs that are not as the file says: joints, loads, sensors.

use hexbench_core::{Sensor, SensorInput, Wrench};
use statrs::distribution::{ChiSquared, ContinuousCDF};

use super::finding::{Finding, FindingKind, probability};
use super::tolerance::{Doubted, Tolerance};
use crate::estimation::tolerances::InputKind;

/// A sensor that does not stand, look or read as the file says, beside whatever else is at work.
pub(super) fn sensor_otherwise(found: &Tolerance, input: SensorInput, sensor: &Sensor) -> Finding {
    const MEASURE: &str = "measure position and direction of the sensor, and correct the hexapod file";
    let name = &sensor.name;
    let off = norm(&found.errors);
    let (kind, size, text, next) = match input {
        SensorInput::Point => {
            let mm: Vec<String> = found.errors.iter().map(|e| format!("{:+.1}", e * 1e3)).collect();
            let at = format!("another point of the platform than stated: ({}) mm from it", mm.join(", "));
            (FindingKind::SensorPlace, format!("{:.1} mm", off * 1e3), format!("measure {at}"), MEASURE)
        }
        SensorInput::Direction => {
            let size = format!("{:.1} deg", off.to_degrees());
            let text = format!("measure in another direction than stated, {size} from it");
            (FindingKind::SensorPlace, size, text, MEASURE)
        }
        SensorInput::Gain => {
            let percent = 100.0 * found.errors[0];
            let much = if percent > 0.0 { "much" } else { "little" };
            let text = format!("show {:.1} % too {much}", percent.abs());
            (FindingKind::SensorGain, format!("{percent:+.1} %"), text, "calibrate the sensor")
        }
    };
    Finding {
        probability: probability(found.evidence),
        text: format!(
            "sensor {name} seems to {text}; it is taken as found here, with its tolerance enlarged accordingly"
        ),
        size,
        next: next.to_owned(),
        ..Finding::of(kind)
    }
}

/// One component of the loads, or all moments, off by one factor.
pub(super) fn scaled_loads(found: &Tolerance) -> Finding {
    let percent: f64 = found.errors.iter().map(|error| 100.0 * error).sum();
    let larger = if percent > 0.0 { "larger" } else { "smaller" };
    let than_written = format!("{larger} by {:.1} % than written", percent.abs());
    let better = "the readings better than loads as written, and better than any effect";
    let (what, text, next) = match found.doubted {
        Doubted::Gain(k) => {
            let name = Wrench::NAMES[k];
            (name, format!("{name} that is {than_written} in every load explains {better}"), CALIBRATE)
        }
        _ => (
            "moments",
            format!("moments that are all {than_written} explain {better}"),
            "measure the lever arms of the loads again",
        ),
    };
    Finding {
        probability: probability(found.evidence),
        text,
        size: format!("{what} {percent:+.1} %"),
        next: next.to_owned(),
        is_within_tolerance: found.is_within(),
        ..Finding::of(FindingKind::Tolerance)
    }
}

/// Joints or loads that are not as the file says.
pub(super) fn errors_of_inputs(found: &Tolerance, kind: InputKind) -> Finding {
    let (size, text, next) = match kind {
        InputKind::LoadGain => wrong_gain(&found.errors),
        InputKind::LoadPoint => beside_the_point(found),
        InputKind::LoadDirection => tilted_loads(found),
        InputKind::Joints | InputKind::Frame => off_the_drawing(found.size),
    };
    Finding {
        probability: probability(found.evidence),
        text,
        size,
        next: next.to_owned(),
        is_within_tolerance: found.is_within(),
        ..Finding::of(FindingKind::Tolerance)
    }
}

const CALIBRATE: &str = "calibrate the load cell, weigh the masses, measure the lever arms";

/// Size of an error of inputs, what it is, and what to do about it.
type Told = (String, String, &'static str);

fn wrong_gain(errors: &[f64]) -> Told {
    let largest = Wrench::NAMES.iter().zip(errors).max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
    let (component, error) = largest.map_or(("", 0.0), |(name, error)| (*name, 100.0 * error));
    (
        format!("{component} {error:+.1} %"),
        format!(
            "loads that are larger or smaller than written explain the readings better than loads as written, and better than \
             any effect; {component} most, by {error:+.1} %"
        ),
        CALIBRATE,
    )
}

fn off_the_drawing(size: f64) -> Told {
    let size = format!("{:.2} mm", size * 1e3);
    let text = format!(
        "joints about {size} off the drawing explain the readings better than the joints of the drawing, and better than any effect"
    );
    (size, text, "measure the joint positions, or calibrate the machine")
}

fn beside_the_point(found: &Tolerance) -> Told {
    let mm = |e: f64| 1e3 * e;
    let size = format!("{:.2} mm", mm(norm(&found.errors)));
    let at: Vec<String> = found.errors.iter().map(|e| format!("{:+.2}", mm(*e))).collect();
    let text = format!(
        "the loads act {size} from the point that the file states, at ({}) mm from it in mobile axes: clear of the noise, and {} \
         what the tolerance of {} mm makes likely",
        at.join(", "),
        found.within_or_beyond(),
        mm(found.size)
    );
    (size, text, "measure where the loads act and correct the moments in the file, or fit load-offset")
}

fn tilted_loads(found: &Tolerance) -> Told {
    let size = format!("{:.2} deg", norm(&found.errors).to_degrees());
    let about: Vec<String> = found.errors.iter().map(|e| format!("{:+.2}", e.to_degrees())).collect();
    let text = format!(
        "the loads are tilted by {size} from the directions that the file states, by ({}) deg about the fixed axes: clear of the \
         noise, and {} what the tolerance of {:.2} deg makes likely",
        about.join(", "),
        found.within_or_beyond(),
        found.size.to_degrees()
    );
    (size, text, "measure the directions of the loads and correct them in the file, or fit load-tilt")
}

impl Tolerance {
    /// True for errors that are together within what the stated tolerance gives in 99 of 100 cases.
    fn is_within(&self) -> bool {
        const LIKELY: f64 = 0.99;
        let stated = self.size / self.factor;
        let errors = self.errors.len().max(1) as f64;
        let longest = ChiSquared::new(errors).map_or(0.0, |law| law.inverse_cdf(LIKELY));
        norm(&self.errors) <= longest.sqrt() * stated
    }

    /// The same in a word.
    fn within_or_beyond(&self) -> &'static str {
        if self.is_within() { "within" } else { "beyond" }
    }
}

fn norm(errors: &[f64]) -> f64 {
    errors.iter().map(|e| e * e).sum::<f64>().sqrt()
}
