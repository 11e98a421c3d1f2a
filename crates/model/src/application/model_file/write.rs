//! From a model to its file.

use nalgebra::Isometry3;

use hexbench_core::{AngleConvention, Hexapod, Measurand, Sensor, Tolerances};

use super::Model;
use super::layout::{
    Covariance, File, Frame, Frames, HexapodTable, LegTable, NoiseTable, ParameterTable, Seal, SensorTable,
    TermTable,
};
use crate::estimation::linearization::Active;
use crate::estimation::parameters::parameter_names;

const STIFFNESS_PER_SI: f64 = 1e-6;

pub(super) fn file(model: &Model) -> File {
    let absolute = model.measurand == Measurand::AbsolutePose;
    File {
        format: "model/1".to_owned(),
        program: model.program.clone(),
        estimator: model.estimator.word().to_owned(),
        mode: mode_word(model.measurand).to_owned(),
        settled: model.settled,
        chi2: model.chi2,
        degrees_of_freedom: model.dof,
        data: model.data.clone(),
        reach: model.reach,
        noise: noise(model),
        hexapod: hexapod(&model.hexapod),
        legs: (0..6).map(|leg| leg_table(model, leg)).collect(),
        terms: terms(model),
        frames: absolute.then(|| Frames {
            metrology: frame(&model.point.machine.metrology_frame),
            target: frame(&model.point.machine.target_frame),
        }),
        covariance: Covariance {
            order: model.parameters.iter().map(|p| p.name.clone()).collect(),
            matrix: model.covariance.row_iter().map(|row| row.iter().copied().collect()).collect(),
        },
        seal: Seal::default(),
    }
}

pub(super) fn mode_word(measurand: Measurand) -> &'static str {
    match measurand {
        Measurand::DeflectionEuler => "deflection",
        Measurand::DeflectionRotationVector => "deflection-rotation-vector",
        Measurand::AbsolutePose => "absolute",
    }
}

fn noise(model: &Model) -> NoiseTable {
    NoiseTable {
        translation_m: model.noise.translation,
        rotation_rad: model.noise.rotation,
        source: model.noise.source.word().to_owned(),
        degrees_of_freedom: Some(model.noise.dof).filter(|d| d.is_finite()),
    }
}

fn hexapod(h: &Hexapod) -> HexapodTable {
    HexapodTable {
        name: h.name.clone(),
        base_joints_m: h.base_joints.iter().map(|a| (*a).into()).collect(),
        platform_joints_m: h.platform_joints.iter().map(|b| (*b).into()).collect(),
        sigma_translation_m: h.metrology.map(|m| m.sigma_translation),
        sigma_rotation_rad: h.metrology.map(|m| m.sigma_rotation),
        nominal_stiffness_n_per_m: h.nominal_stiffness,
        stroke_m: h.stroke,
        brackets: h.brackets.as_ref().map(|b| b.iter().map(|pair| pair.map(|leg| leg + 1)).collect()),
        mounting_plane_z_m: h.mounting_plane_z,
        payload_centre_m: h.payload_centre.map(Into::into),
        tolerances: Some(h.tolerances).filter(|t| *t != Tolerances::default()),
        angles: (h.angles != AngleConvention::default()).then(|| h.angles.word()),
        sensors: h.sensors.iter().map(sensor).collect(),
    }
}

fn sensor(sensor: &Sensor) -> SensorTable {
    let kind = &sensor.kind;
    SensorTable {
        name: sensor.name.clone(),
        kind: kind.word().to_owned(),
        point_m: kind.point().map(|point| (*point).into()),
        direction: kind.direction().map(|direction| (*direction).into()),
        leg: kind.leg().map(|leg| leg + 1),
        gain: Some(sensor.gain).filter(|gain| gain.to_bits() != 1.0_f64.to_bits()),
        sigma: (0..kind.numbers()).map(|k| kind.sigma(k)).collect(),
    }
}

fn leg_table(model: &Model, leg: usize) -> LegTable {
    let c = model.point.compliances[leg];
    let stiffness = Some(STIFFNESS_PER_SI / c).filter(|k| k.is_finite());
    let error = stiffness.map(|k| model.std(leg) / c.abs() * k.abs()).filter(|e| e.is_finite());
    LegTable { stiffness, standard_error: error, compliance: c }
}

fn terms(model: &Model) -> Vec<TermTable> {
    (0..model.point.active.len()).map(|k| term(model, k)).collect()
}

fn term(model: &Model, number: usize) -> TermTable {
    let a = &model.point.active[number];
    let offset = model.parameters.of_term(number).start;
    let parameter = |(k, (name, unit, per_si)): (usize, (String, &'static str, f64))| {
        let table = ParameterTable {
            value: a.values[k] * per_si,
            standard_error: model.std(offset + k) * per_si,
            unit: unit.to_owned(),
            determined: model.determined.get(offset + k).copied().unwrap_or(true),
            si: a.values[k],
        };
        (name, table)
    };
    TermTable {
        id: a.id().to_owned(),
        form: if a.rich { "rich" } else { a.term.version().unwrap_or("ideal") }.to_owned(),
        shape: shape(model, a, model.parameters.shape_of_term(number)),
        definition: a.term.definition().map(str::to_owned),
        parameters: parameter_names(a).into_iter().enumerate().map(parameter).collect(),
    }
}

/// The shape of a term, whose column, when it has one, holds its logarithm.
fn shape(model: &Model, a: &Active, column: Option<usize>) -> Option<ParameterTable> {
    let shape = a.term.info().shape?;
    Some(ParameterTable {
        value: a.shape * shape.per_si,
        standard_error: column.map_or(0.0, |k| model.std(k) * a.shape * shape.per_si),
        unit: shape.unit.to_owned(),
        determined: column.and_then(|k| model.determined.get(k).copied()).unwrap_or(true),
        si: a.shape,
    })
}

fn frame(isometry: &Isometry3<f64>) -> Frame {
    let q = isometry.rotation.coords;
    Frame { translation_m: isometry.translation.vector.into(), quaternion: [q.x, q.y, q.z, q.w] }
}
