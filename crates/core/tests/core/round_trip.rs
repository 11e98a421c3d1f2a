//! What is written is read back as the same.

use hexbench_core::files::{
    hexapod_to_toml, measurements_to_csv, parse_hexapod, read_hexapod, read_measurements,
    read_measurements_from, write_hexapod, write_measurements,
};
use hexbench_core::{
    AngleConvention, Approach, Columns, Dataset, Hexapod, Measurand, Metrology, Observation, Pose,
    Tolerances, Vector3, Wrench,
};
use proptest::array::uniform6;
use proptest::prelude::*;

/// A change of unit there and back rounds twice each way.
const ROUNDINGS: f64 = 2.0;

fn near(one: f64, other: f64) -> bool {
    (one - other).abs() <= ROUNDINGS * f64::EPSILON * other.abs()
}

fn numbers(row: &Observation) -> Vec<f64> {
    let mut numbers =
        vec![row.approach.sign(), row.overload, row.delta_t, row.elapsed, row.reference_age.unwrap_or(-1.0)];
    for six in [row.pose.to_array(), row.wrench.to_array(), row.reference.to_array(), row.measured] {
        numbers.extend(six);
    }
    numbers.extend(row.sigma.unwrap_or_default());
    numbers
}

fn assert_near(one: &Dataset, other: &Dataset) {
    assert_eq!((one.measurand, one.columns), (other.measurand, other.columns));
    assert_eq!(one.observations.len(), other.observations.len());
    for (one, other) in one.observations.iter().zip(&other.observations) {
        assert_eq!(
            (one.pose_id, one.repeat, one.reference_record, one.order),
            (other.pose_id, other.repeat, other.reference_record, other.order)
        );
        let pairs = numbers(one).into_iter().zip(numbers(other));
        pairs.for_each(|(one, other)| assert!(near(one, other), "{one:e} {other:e}"));
    }
}

fn measurand() -> impl Strategy<Value = Measurand> {
    use Measurand::{AbsolutePose, DeflectionEuler, DeflectionRotationVector};
    prop_oneof![Just(DeflectionEuler), Just(DeflectionRotationVector), Just(AbsolutePose)]
}

fn columns() -> impl Strategy<Value = Columns> {
    any::<[bool; 9]>().prop_map(
        |[reference, approach, overload, delta_t, elapsed, reference_age, reference_record, order, sigma]| {
            Columns {
                reference,
                approach,
                overload,
                delta_t,
                elapsed,
                reference_age,
                reference_record,
                order,
                sigma,
            }
        },
    )
}

prop_compose! {
    fn observation()(
        pose_id in any::<i32>(), repeat in 0..100_i64,
        pose in uniform6(-6.0..6.0_f64), wrench in uniform6(-1e6..1e6_f64), reference in uniform6(-1e6..1e6_f64),
        up in any::<bool>(), overload in 1.0..3.0_f64, delta_t in -50.0..50.0_f64, elapsed in 0.0..1e6_f64, age in 0.0..1e9_f64,
        record in -5..5_i64,
        measured in uniform6(-1e-3..1e-3_f64), sigma in uniform6(1e-12..1e-3_f64),
    ) -> Observation {
        Observation {
        block: 0,
            pose_id: pose_id.into(), repeat, line: 0,
            pose: Pose::from_array(pose), wrench: Wrench::from_array(wrench), reference: Wrench::from_array(reference),
            approach: if up { Approach::Direct } else { Approach::Overloaded }, overload, delta_t, elapsed,
            reference_age: Some(age), reference_record: Some(record), order: Some(0), measured, sigma: Some(sigma),
        }
    }
}

/// What a table with these columns can say about the row.
fn as_stated(row: &Observation, columns: Columns) -> Observation {
    Observation {
        reference: if columns.reference { row.reference } else { Wrench::default() },
        approach: if columns.approach { row.approach } else { Approach::Direct },
        overload: if columns.overload { row.overload } else { Approach::OVERLOAD },
        delta_t: if columns.delta_t { row.delta_t } else { 0.0 },
        elapsed: if columns.elapsed { row.elapsed } else { 0.0 },
        reference_age: row.reference_age.filter(|_| columns.reference_age),
        reference_record: row.reference_record.filter(|_| columns.reference_record),
        order: row.order.filter(|_| columns.order),
        sigma: row.sigma.filter(|_| columns.sigma),
        ..*row
    }
}

prop_compose! {
    fn dataset()(
        measurand in measurand(), columns in columns(), rows in prop::collection::vec(observation(), 1..6),
    ) -> Dataset {
        let deflections = measurand != Measurand::AbsolutePose;
        let (reference, reference_age) = (columns.reference && deflections, columns.reference_age && deflections);
        let (reference_record, order) = (columns.reference_record && deflections, columns.order && deflections);
        let columns = Columns { reference, reference_age, reference_record, order, ..columns };
        let observations: Vec<Observation> = (1..).zip(&rows)
            .map(|(place, row)| as_stated(&Observation { order: Some(place), ..*row }, columns))
            .collect();
        Dataset::of_poses("measurements.csv", measurand, columns, observations)
    }
}

fn written(dataset: &Dataset) -> Vec<u8> {
    let mut bytes = Vec::new();
    measurements_to_csv(&mut bytes, dataset).unwrap();
    bytes
}

fn reread(bytes: &[u8]) -> Dataset {
    read_measurements_from(bytes, "measurements.csv").unwrap_or_else(|error| panic!("{error}")).dataset
}

prop_compose! {
    fn points()(coordinates in prop::array::uniform6(prop::array::uniform3(-1.0..1.0_f64))) -> [Vector3; 6] {
        coordinates.map(Vector3::from)
    }
}

prop_compose! {
    fn hexapod()(
        name in ".{0,20}", base_joints in points(), platform_joints in points(),
        sigma in prop::option::of([1e-9..1e-3_f64, 1e-9..1e-3_f64]),
        nominal_stiffness in prop::option::of(uniform6(1e3..1e9_f64)),
        shortest in prop::option::of(0.1..1.0_f64), z in prop::option::of(-1.0..1.0_f64),
        brackets in prop::option::of(Just(vec![[0, 1], [2, 3], [4, 5]])),
        payload in prop::option::of(prop::array::uniform3(-1.0..1.0_f64)),
        load_gain in prop::option::of(1e-6..1.0_f64),
        angles in prop::sample::select(AngleConvention::ALL.to_vec()),
    ) -> Hexapod {
        Hexapod {
            sensors: Vec::new(),
            angles,
            name, base_joints, platform_joints, nominal_stiffness, brackets, mounting_plane_z: z,
            metrology: sigma.map(|[t, r]| Metrology { sigma_translation: t, sigma_rotation: r }),
            stroke: shortest.map(|length| [length, length + 0.1]),
            payload_centre: payload.map(Vector3::from),
            tolerances: load_gain.map_or_else(Tolerances::default, |load_gain| {
                Tolerances { joints: 1e-4, load_gain, noise: 0.2, ..Tolerances::default() }
            }),
        }
    }
}

/// Every number of a hexapod.
fn all_numbers(hexapod: &Hexapod) -> Vec<f64> {
    let points = hexapod.base_joints.iter().chain(&hexapod.platform_joints).chain(&hexapod.payload_centre);
    let mut numbers: Vec<f64> = points.flat_map(|point| [point.x, point.y, point.z]).collect();
    numbers
        .extend(hexapod.metrology.iter().flat_map(|noise| [noise.sigma_translation, noise.sigma_rotation]));
    numbers.extend(hexapod.nominal_stiffness.iter().flatten());
    numbers.extend(hexapod.stroke.iter().flatten());
    numbers.extend(hexapod.mounting_plane_z);
    numbers
}

proptest! {
    #[test]
    fn a_dataset_is_read_as_it_was_written(dataset in dataset()) {
        assert_near(&reread(&written(&dataset)), &dataset);
    }

    #[test]
    fn a_hexapod_is_read_as_it_was_written(hexapod in hexapod()) {
        let back = parse_hexapod(&hexapod_to_toml(&hexapod), "hexapod.toml").unwrap();
        let pairs = all_numbers(&back).into_iter().zip(all_numbers(&hexapod));
        pairs.for_each(|(one, other)| assert!(near(one, other), "{one:e} {other:e}"));
        prop_assert_eq!((back.name, back.brackets), (hexapod.name, hexapod.brackets));
    }

    #[test]
    fn the_reader_of_tables_never_panics(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = read_measurements_from(&bytes[..], "noise");
    }

    #[test]
    fn a_damaged_table_never_panics(dataset in dataset(), at in any::<prop::sample::Index>(), byte in any::<u8>()) {
        let mut bytes = written(&dataset);
        let position = at.index(bytes.len());
        bytes[position] = byte;
        let _ = read_measurements_from(&bytes[..], "damaged");
        let _ = read_measurements_from(&bytes[..position], "cut");
    }

    #[test]
    fn the_reader_of_hexapods_never_panics(text in "[a-z_=\\[\\]{}\",.0-9 \n#-]{0,200}") {
        let _ = parse_hexapod(&text, "noise");
    }
}

#[test]
fn numbers_of_a_file_are_written_with_the_same_digits() {
    let text = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,\
        da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad\n\
        1,1,6.94577729,4.45357774,0.586307376,-7.89776734,0.804678281,7.49341492,0,0,-338.445,0,0,0,\
        -1.42682,2.258449,-13.110664,-18.498588,18.37297,61.832877\n";
    assert_eq!(String::from_utf8(written(&reread(text.as_bytes()))).unwrap(), text);
}

#[test]
fn files_on_the_disk_come_back() {
    let folder = tempfile::tempdir().unwrap();
    let hexapod_path = folder.path().join("hexapod.toml");
    let hexapod = Hexapod::of_joints(
        "a \"quoted\" name",
        [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|x: f64| Vector3::new(x, x * x, 0.0)),
        [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|x: f64| Vector3::new(x, x * x, 1.0)),
    );
    write_hexapod(&hexapod_path, &hexapod).unwrap();
    assert_eq!(read_hexapod(&hexapod_path).unwrap(), hexapod);
    let table = folder.path().join("measurements.csv");
    let text = "a_m,b_m,c_m,alpha_rad,beta_rad,gamma_rad,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,measured_a_m,measured_b_m,\
        measured_c_m,measured_alpha_rad,measured_beta_rad,measured_gamma_rad\n0,0,0,0,0,0,1,2,3,4,5,6,0,0,0,0,0,0\n";
    let dataset = reread(text.as_bytes());
    write_measurements(&table, &dataset).unwrap();
    assert_eq!(read_measurements(&table).unwrap().dataset, dataset);
}

#[test]
fn a_dataset_that_could_not_be_read_again_is_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("measurements.csv");
    let row = Observation {
        pose_id: 7,
        measured: [0.0, f64::NAN, 0.0, 0.0, 0.0, 0.0],
        ..Observation::unread(Pose::default(), Wrench::default(), Wrench::default())
    };
    let dataset = Dataset::of_poses("", Measurand::DeflectionEuler, Columns::default(), vec![row]);
    let error = write_measurements(&path, &dataset).unwrap_err();
    assert!(error.to_string().contains("pose 7, repeat 1 has no finite db"), "{error}");
    assert!(!path.exists());
}
