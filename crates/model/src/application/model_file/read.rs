//! From a file back to the model, with every rule checked.

use std::sync::Arc;

use hexbench_core::files::nearest;
use hexbench_core::{
    AngleConvention, Hexapod, Measurand, Metrology, Sensor, SensorKind, Tolerances, Vector3, Vector6,
};
use nalgebra::{DMatrix, Isometry3, Quaternion, Translation3, UnitQuaternion};

use super::layout::{
    File, Frame, HexapodTable, LegTable, NoiseTable, ParameterTable, SensorTable, TermTable,
};
use super::write::mode_word;
use super::{Estimator, Model, ModelFileError};
use crate::application::reach::Reach;
use crate::effects::term::{Term, version_named};
use crate::estimation::linearization::{Active, ModelPoint};
use crate::estimation::noise::{Noise, NoiseSource, Structure};
use crate::estimation::parameters::{Parameter, ParameterPlace, Parameters, parameter_names};
use crate::machine::geometry::Machine;
use crate::{effects::user_term, terms};

/// Largest relative difference between a number for people and the SI number beside it.
const AGREEMENT: f64 = 1e-6;
/// Largest relative asymmetry of a covariance, and how negative an eigenvalue of the correlation may be.
const COVARIANCE_SLACK: f64 = 1e-8;
/// Largest number of a model: in a smaller unit, and multiplied by a few others, it is still finite.
const LARGEST: f64 = 1e100;
/// Largest departure of a quaternion from unit length.
const UNIT_SLACK: f64 = 1e-9;

pub(super) fn model(file: File) -> Result<Model, ModelFileError> {
    if file.format != "model/1" {
        return Err(rule("format", format!("`{}` must be \"model/1\"", file.format)));
    }
    let measurand = measurand(&file.mode)?;
    finite("chi2", &[file.chi2, file.degrees_of_freedom])?;
    let hexapod = hexapod(&file.hexapod)?;
    let active = file.terms.iter().map(term).collect::<Result<Vec<_>, _>>()?;
    refuse_same_term(&active)?;
    let point = ModelPoint {
        compliances: springs(&file.legs)?,
        active,
        machine: machine(&hexapod, &file, measurand)?,
    };
    let mut model = Model {
        hexapod,
        measurand,
        estimator: Estimator::named(&file.estimator)
            .ok_or_else(|| rule("estimator", format!("`{}` must be gls or paper", file.estimator)))?,
        noise: noise(&file.noise)?,
        covariance: DMatrix::zeros(0, 0),
        parameters: Parameters::at(&point, measurand == Measurand::AbsolutePose),
        determined: Vec::new(),
        point,
        data: file.data,
        reach: file.reach.map(reach).transpose()?,
        chi2: file.chi2,
        dof: file.degrees_of_freedom,
        settled: file.settled,
        program: file.program,
    };
    model.covariance = covariance(&file.covariance.order, &file.covariance.matrix, &model.parameters)?;
    model.determined = determined(&model, &file.terms);
    Ok(model)
}

fn rule(key: impl Into<String>, why: impl Into<String>) -> ModelFileError {
    ModelFileError::Rule { key: key.into(), why: why.into() }
}

fn finite(key: &str, values: &[f64]) -> Result<(), ModelFileError> {
    match values.iter().find(|v| !v.is_finite() || v.abs() > LARGEST) {
        Some(value) if value.is_finite() => Err(rule(key, format!("{value:e} is too large for any machine"))),
        Some(value) => Err(rule(key, format!("{value} is not a finite number"))),
        None => Ok(()),
    }
}

fn reach(stated: Reach) -> Result<Reach, ModelFileError> {
    let Reach { force, moment, shift, turn } = stated;
    finite("reach", &[force, moment, shift, turn])?;
    Ok(stated)
}

fn measurand(mode: &str) -> Result<Measurand, ModelFileError> {
    let all = [Measurand::DeflectionEuler, Measurand::DeflectionRotationVector, Measurand::AbsolutePose];
    let known = all.into_iter().find(|m| mode_word(*m) == mode);
    known.ok_or_else(|| {
        let names = all.map(mode_word).join(", ");
        rule("mode", format!("`{mode}` must be one of {names}"))
    })
}

fn noise(table: &NoiseTable) -> Result<Noise, ModelFileError> {
    finite("noise", &[table.translation_m, table.rotation_rad])?;
    if table.translation_m <= 0.0 || table.rotation_rad <= 0.0 {
        return Err(rule("noise", "standard deviations must be greater than zero"));
    }
    let source = NoiseSource::try_from(table.source.clone()).map_err(|why| rule("noise.source", why))?;
    Ok(Noise {
        translation: table.translation_m,
        rotation: table.rotation_rad,
        source,
        dof: table.degrees_of_freedom.unwrap_or(f64::INFINITY),
        structure: Structure::Independent,
    })
}

fn hexapod(t: &HexapodTable) -> Result<Hexapod, ModelFileError> {
    let metrology = match (t.sigma_translation_m, t.sigma_rotation_rad) {
        (Some(sigma_translation), Some(sigma_rotation)) => {
            Some(Metrology { sigma_translation, sigma_rotation })
        }
        (None, None) => None,
        _ => return Err(rule("hexapod", "sigma_translation_m and sigma_rotation_rad belong together")),
    };
    let scalars = [t.sigma_translation_m, t.sigma_rotation_rad, t.mounting_plane_z_m];
    finite("hexapod", &scalars.into_iter().flatten().collect::<Vec<_>>())?;
    if [t.sigma_translation_m, t.sigma_rotation_rad].into_iter().flatten().any(|sigma| sigma <= 0.0) {
        return Err(rule("hexapod", "standard deviations must be greater than zero"));
    }
    finite("hexapod", t.nominal_stiffness_n_per_m.as_ref().map_or(&[], |k| k.as_slice()))?;
    finite("hexapod", t.stroke_m.as_ref().map_or(&[], |s| s.as_slice()))?;
    finite("hexapod", t.payload_centre_m.as_ref().map_or(&[], |c| c.as_slice()))?;
    Ok(Hexapod {
        name: t.name.clone(),
        base_joints: joints("hexapod.base_joints_m", &t.base_joints_m)?,
        platform_joints: joints("hexapod.platform_joints_m", &t.platform_joints_m)?,
        metrology,
        nominal_stiffness: t.nominal_stiffness_n_per_m,
        stroke: t.stroke_m,
        brackets: t.brackets.as_ref().map(|b| brackets(b)).transpose()?,
        mounting_plane_z: t.mounting_plane_z_m,
        payload_centre: t.payload_centre_m.map(Vector3::from),
        tolerances: t.tolerances.map_or(Ok(Tolerances::default()), tolerances)?,
        angles: angles(t.angles.as_deref())?,
        sensors: t.sensors.iter().map(sensor).collect::<Result<_, _>>()?,
    })
}

fn angles(word: Option<&str>) -> Result<AngleConvention, ModelFileError> {
    let Some(word) = word else { return Ok(AngleConvention::default()) };
    AngleConvention::of_word(word)
        .ok_or_else(|| rule("hexapod.angles", format!("{word} is no convention of angles")))
}

fn sensor(t: &SensorTable) -> Result<Sensor, ModelFileError> {
    let key = format!("hexapod.sensors: {}", t.name);
    finite(&key, &t.sigma)?;
    finite(&key, t.point_m.as_ref().map_or(&[], |p| p.as_slice()))?;
    finite(&key, t.direction.as_ref().map_or(&[], |d| d.as_slice()))?;
    let lacks = |what: &str| rule(key.clone(), format!("a sensor of kind {} needs {what}", t.kind));
    let point = || t.point_m.map(Vector3::from).ok_or_else(|| lacks("point_m"));
    let direction = || t.direction.map(Vector3::from).ok_or_else(|| lacks("direction"));
    let leg =
        || t.leg.filter(|l| (1..=6).contains(l)).map(|l| l - 1).ok_or_else(|| lacks("a leg from 1 to 6"));
    if t.sigma.iter().any(|s| *s <= 0.0) {
        return Err(lacks("standard deviations greater than zero"));
    }
    let one = || t.sigma.first().copied().ok_or_else(|| lacks("sigma"));
    let kind = match t.kind.as_str() {
        "distance" => SensorKind::Distance { point: point()?, direction: direction()?, sigma: one()? },
        "point" => {
            let sigma = t.sigma.as_slice().try_into().map_err(|_| lacks("three standard deviations"))?;
            SensorKind::Point { point: point()?, sigma }
        }
        "inclination" => SensorKind::Inclination { axis: direction()?, sigma: one()? },
        "leg-length" => SensorKind::LegLength { leg: leg()?, sigma: one()? },
        _ => return Err(rule(key, "the kind must be distance, point, inclination or leg-length")),
    };
    let gain = t.gain.unwrap_or(1.0);
    if !gain.is_finite() || gain <= 0.0 {
        return Err(lacks("a gain greater than zero"));
    }
    Ok(Sensor { gain, ..Sensor::new(&t.name, kind) })
}

fn tolerances(stated: Tolerances) -> Result<Tolerances, ModelFileError> {
    finite("hexapod.tolerances", &stated.all())?;
    if stated.all().iter().any(|x| *x <= 0.0) {
        return Err(rule("hexapod.tolerances", "every tolerance must be greater than zero"));
    }
    Ok(stated)
}

fn joints(key: &str, rows: &[[f64; 3]]) -> Result<[Vector3; 6], ModelFileError> {
    finite(key, rows.as_flattened())?;
    let six: [[f64; 3]; 6] =
        rows.try_into().map_err(|_| rule(key, format!("six joints are needed, {} are there", rows.len())))?;
    Ok(six.map(Vector3::from))
}

fn brackets(pairs: &[[usize; 2]]) -> Result<Vec<[usize; 2]>, ModelFileError> {
    let valid = |[i, j]: &[usize; 2]| i != j && (1..=6).contains(i) && (1..=6).contains(j);
    match pairs.iter().find(|p| !valid(p)) {
        Some(p) => {
            Err(rule("hexapod.brackets", format!("{p:?} is not a pair of two different legs from 1 to 6")))
        }
        None => Ok(pairs.iter().map(|p| p.map(|leg| leg - 1)).collect()),
    }
}

fn springs(legs: &[LegTable]) -> Result<Vector6, ModelFileError> {
    if legs.len() != 6 {
        return Err(rule("leg", format!("six legs are needed, {} are there", legs.len())));
    }
    for (i, leg) in legs.iter().enumerate() {
        let key = format!("leg {}", i + 1);
        finite(&key, &[leg.compliance])?;
        if let Some(stiffness) = leg.stiffness.filter(|_| leg.compliance > 0.0) {
            agree(&key, stiffness, 1e-6 / leg.compliance)?;
        }
    }
    let compliances = Vector6::from_fn(|i, _| legs[i].compliance);
    physical(compliances.as_slice())?;
    Ok(compliances)
}

/// A spring yields in the direction of its force.
pub(super) fn physical(compliances: &[f64]) -> Result<(), ModelFileError> {
    match (1..).zip(compliances).find(|(_, c)| **c <= 0.0) {
        Some((leg, c)) => {
            Err(rule(format!("leg {leg}"), format!("the compliance {c} m/N must be greater than zero")))
        }
        None => Ok(()),
    }
}

/// A number changed by hand without its SI partner would otherwise be ignored in silence.
fn agree(key: &str, shown: f64, from_si: f64) -> Result<(), ModelFileError> {
    if (shown - from_si).abs() <= AGREEMENT * from_si.abs() {
        return Ok(());
    }
    let why =
        format!("the value {shown} contradicts the SI number beside it, which is {from_si} in that unit");
    Err(rule(key, why))
}

fn term(table: &TermTable) -> Result<Active, ModelFileError> {
    let term = named_term(table)?;
    let (term, rich) = match table.form.as_str() {
        "ideal" => (term, false),
        "rich" => (term, true),
        other => match version_named(&term, other) {
            Some(version) => (version, false),
            None => return Err(no_such_form(table, term.as_ref())),
        },
    };
    let shape = shape(table, term.as_ref())?;
    let mut active = Active::new(term, rich, shape);
    let names = parameter_names(&active);
    refuse_unknown_parameters(table, &names)?;
    for (k, (name, unit, per_si)) in names.iter().enumerate() {
        let key = format!("term {}.{name}", table.id);
        let p = table.parameters.get(name).ok_or_else(|| rule(&key, "the parameter is missing"))?;
        active.values[k] = parameter(&key, p, unit, *per_si)?;
    }
    Ok(active)
}

fn no_such_form(table: &TermTable, term: &dyn Term) -> ModelFileError {
    let versions = term.versions().into_iter().filter_map(|(_, version)| version.version());
    let known: Vec<&str> = ["ideal", "rich"].into_iter().chain(versions).collect();
    let (last, others) = known.split_last().map_or(("", &[][..]), |(last, others)| (*last, others));
    let why = format!("form `{}` must be {} or {last}", table.form, others.join(", "));
    rule(format!("term {}", table.id), why)
}

fn named_term(table: &TermTable) -> Result<Arc<dyn Term>, ModelFileError> {
    if let Some(definition) = &table.definition {
        let term = user_term::parse(definition)
            .map_err(|error| ModelFileError::UserTerm { id: table.id.clone(), error })?;
        let same = term.info().id == table.id;
        return if same {
            Ok(term)
        } else {
            Err(rule("term", "the definition has another id than the term"))
        };
    }
    let all = terms::catalogue();
    let names: Vec<&str> = all.iter().map(|t| t.info().id).collect();
    let found = all.iter().find(|t| t.info().id == table.id).map(Arc::clone);
    found.ok_or_else(|| ModelFileError::UnknownTerm {
        id: table.id.clone(),
        nearest: nearest(&table.id, names).map(str::to_owned),
    })
}

fn shape(table: &TermTable, term: &dyn Term) -> Result<f64, ModelFileError> {
    let key = format!("term {}", table.id);
    match (term.info().shape, &table.shape) {
        (None, None) => Ok(1.0),
        (Some(s), Some(given)) => {
            let value = parameter(&format!("{key}.shape"), given, s.unit, s.per_si)?;
            let inside = (s.bounds[0]..=s.bounds[1]).contains(&value);
            let why = || {
                format!(
                    "the {} {value} (SI) is outside its bounds {} to {}",
                    s.name, s.bounds[0], s.bounds[1]
                )
            };
            if inside { Ok(value) } else { Err(rule(key, why())) }
        }
        (Some(s), None) => Err(rule(key, format!("the shape, its {}, is missing", s.name))),
        (None, Some(_)) => Err(rule(key, "this term has no shape, but one is there")),
    }
}

fn refuse_unknown_parameters(
    table: &TermTable,
    names: &[(String, &'static str, f64)],
) -> Result<(), ModelFileError> {
    let known = |name: &&String| names.iter().any(|n| n.0 == **name);
    let Some(unknown) = table.parameters.keys().find(|name| !known(name)) else { return Ok(()) };
    let near = nearest(unknown, names.iter().map(|n| n.0.as_str()));
    let hint = near.map(|n| format!("; did you mean `{n}`?")).unwrap_or_default();
    Err(rule(format!("term {}", table.id), format!("there is no parameter `{unknown}` in this form{hint}")))
}

fn parameter(key: &str, p: &ParameterTable, unit: &str, per_si: f64) -> Result<f64, ModelFileError> {
    finite(key, &[p.si, p.value, p.standard_error])?;
    if p.unit != unit {
        return Err(rule(key, format!("the unit must be {unit}, not {}", p.unit)));
    }
    agree(key, p.value, p.si * per_si)?;
    Ok(p.si)
}

fn refuse_same_term(active: &[Active]) -> Result<(), ModelFileError> {
    for (i, a) in active.iter().enumerate() {
        if active[..i].iter().any(|b| b.id() == a.id()) {
            return Err(rule("term", format!("`{}` is there twice", a.id())));
        }
    }
    Ok(())
}

fn machine(hexapod: &Hexapod, file: &File, measurand: Measurand) -> Result<Machine, ModelFileError> {
    let mut machine = Machine::nominal(hexapod);
    match (&file.frames, measurand == Measurand::AbsolutePose) {
        (Some(frames), true) => {
            machine.metrology_frame = frame("frames.metrology", &frames.metrology)?;
            machine.target_frame = frame("frames.target", &frames.target)?;
        }
        (None, false) => {}
        (None, true) => {
            return Err(rule("frames", "a model of absolute poses has metrology and target frames"));
        }
        (Some(_), false) => return Err(rule("frames", "a model of deflections has no frames")),
    }
    Ok(machine)
}

fn frame(key: &str, f: &Frame) -> Result<Isometry3<f64>, ModelFileError> {
    finite(key, &f.translation_m)?;
    finite(key, &f.quaternion)?;
    let [i, j, k, w] = f.quaternion;
    let q = Quaternion::new(w, i, j, k);
    if (q.norm() - 1.0).abs() > UNIT_SLACK {
        return Err(rule(key, format!("the quaternion has length {} instead of 1", q.norm())));
    }
    Ok(Isometry3::from_parts(
        Translation3::from(Vector3::from(f.translation_m)),
        UnitQuaternion::new_unchecked(q),
    ))
}

fn covariance(
    order: &[String],
    rows: &[Vec<f64>],
    parameters: &Parameters,
) -> Result<DMatrix<f64>, ModelFileError> {
    let names: Vec<&str> = parameters.iter().map(|p| p.name.as_str()).collect();
    if order != names {
        let first = order.iter().zip(&names).find(|(a, b)| a != b);
        let why = first
            .map_or(format!("{} names are expected, {} are there", names.len(), order.len()), |(a, b)| {
                format!("`{a}` stands where `{b}` is expected")
            });
        return Err(rule("covariance.order", why));
    }
    let n = names.len();
    if rows.len() != n || rows.iter().any(|r| r.len() != n) {
        return Err(rule("covariance.matrix", format!("{n} rows of {n} numbers are needed")));
    }
    rows.iter().try_for_each(|row| finite("covariance.matrix", row))?;
    let matrix = DMatrix::from_fn(n, n, |i, j| rows[i][j]);
    check_covariance(&matrix, &names)?;
    Ok(matrix)
}

fn check_covariance(c: &DMatrix<f64>, names: &[&str]) -> Result<(), ModelFileError> {
    let n = c.nrows();
    if let Some(k) = (0..n).find(|&k| c[(k, k)] < 0.0) {
        return Err(rule("covariance.matrix", format!("the variance of {} is negative", names[k])));
    }
    let scale = |i: usize, j: usize| (c[(i, i)] * c[(j, j)]).sqrt().max(f64::MIN_POSITIVE);
    for (i, j) in (0..n).flat_map(|i| (0..i).map(move |j| (i, j))) {
        if (c[(i, j)] - c[(j, i)]).abs() > COVARIANCE_SLACK * scale(i, j) {
            let why = format!("not symmetric: {} with {}", names[i], names[j]);
            return Err(rule("covariance.matrix", why));
        }
    }
    let correlation = DMatrix::from_fn(n, n, |i, j| c[(i.max(j), i.min(j))] / scale(i, j));
    let lowest = correlation.symmetric_eigenvalues().min();
    if lowest < -COVARIANCE_SLACK * n as f64 {
        let why = format!("not a covariance: the smallest eigenvalue of the correlation is {lowest:.3e}");
        return Err(rule("covariance.matrix", why));
    }
    Ok(())
}

fn determined(model: &Model, tables: &[TermTable]) -> Vec<bool> {
    let said = |parameter: &Parameter| match parameter.place {
        ParameterPlace::Spring(_) | ParameterPlace::Frames(_) => None,
        ParameterPlace::Value { term, index } => {
            let (name, ..) = &parameter_names(&model.point.active[term])[index];
            tables[term].parameters.get(name).map(|p| p.determined)
        }
        ParameterPlace::Shape { term } => tables[term].shape.as_ref().map(|s| s.determined),
    };
    model.parameters.iter().map(|p| said(p).unwrap_or(true)).collect()
}
