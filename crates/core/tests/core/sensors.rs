//! Files of machines with sensors, and of readings that were not all taken.

use hexbench_core::files::{
    Cells, GroupPurpose, MemoryColumn, campaign_to_csv, hexapod_to_toml, parse_hexapod, read_campaign_from,
    read_columns,
};
use hexbench_core::{Channel, Dataset, Hexapod, SensorKind, UNREAD};

const MACHINE: &str = include_str!("../../../../data/cases/contact/hexapod.toml");
const SENSORS: &str = r#"
[[sensor]]
name = "g1"
kind = "distance"
point_mm = [120, 0, 40]
direction = [0, 0, 2]
sigma_um = 0.3

[[sensor]]
name = "ball"
kind = "point"
point_mm = [0, 100, 40]
sigma_um = [0.5, 0.5, 0.8]

[[sensor]]
name = "level_x"
kind = "inclination"
axis = [1, 0, 0]
sigma_urad = 2

[[sensor]]
name = "scale"
kind = "leg-length"
leg = 3
sigma_um = 0.1
"#;
const INPUTS: &str = "pose,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm";
const READINGS: &str = "da_um,dc_um,g1_um,ball_x_um,ball_y_um,ball_z_um,level_x_urad,scale_um";

fn machine() -> Hexapod {
    parse_hexapod(&format!("{MACHINE}{SENSORS}"), "hexapod.toml").unwrap()
}

fn read(header: &str, rows: &[&str]) -> Result<Dataset, String> {
    let rows: Vec<String> = rows.iter().map(|r| format!("1,0,0,0,0,0,0,0,0,-100,0,0,0,{r}\n")).collect();
    let text = format!("{INPUTS},{header}\n{}", rows.concat());
    read_campaign_from(&machine(), text.as_bytes(), "data.csv").map(|r| r.dataset).map_err(|e| e.to_string())
}

#[test]
fn sensors_are_read_from_the_hexapod_file_and_written_back() {
    let hexapod = machine();
    let SensorKind::Distance { direction, sigma, .. } = hexapod.sensors[0].kind else { panic!("a gauge") };
    assert!((direction.norm() - 1.0).abs() < 1e-15 && (sigma - 0.3e-6).abs() < 1e-20);
    assert_eq!(parse_hexapod(&hexapod_to_toml(&hexapod), "again").unwrap(), hexapod);
}

#[test]
fn a_row_with_more_than_six_numbers_makes_two_observations() {
    let data = read(READINGS, &["1,2,3,4,5,6,7,8"]).unwrap();
    assert_eq!(data.observations.len(), 2);
    let sensor = |sensor, number| Channel::Sensor { sensor, number };
    assert_eq!(data.blocks[0][..3], [Channel::Pose(0), Channel::Pose(2), sensor(0, 0)]);
    assert_eq!(data.blocks[1][..2], [sensor(2, 0), sensor(3, 0)]);
    let [first, second] = &data.observations[..] else { panic!("two") };
    assert_eq!((first.line, first.numbers()), (second.line, 6));
    assert_eq!(second.numbers(), 2);
    assert!((second.measured[0] - 7e-6).abs() < 1e-18 && (second.sigma.unwrap()[0] - 2e-6).abs() < 1e-18);
    assert!((first.sigma.unwrap()[5] - 0.8e-6).abs() < 1e-18, "each axis of a point has its own");
}

#[test]
fn an_empty_cell_is_a_reading_that_was_not_taken() {
    let data = read(READINGS, &["1,2,3,4,5,6,7,8", ",2,,4,5,6,,"]).unwrap();
    assert_eq!(data.observations.len(), 3, "a block in which nothing was read is left out");
    let row = data.observations[2];
    assert!(!row.is_read(0) && row.is_read(1) && !row.is_read(2));
    assert_eq!(row.sigma.unwrap()[0].to_bits(), UNREAD.to_bits());
}

#[test]
fn a_row_states_the_noise_of_a_sensor() {
    let data = read(&format!("{READINGS},g1_sigma_um,ball_sigma_um"), &["1,2,3,4,5,6,7,8,0.9,"]).unwrap();
    let sigma = data.observations[0].sigma.unwrap();
    assert!((sigma[2] - 0.9e-6).abs() < 1e-18 && (sigma[3] - 0.5e-6).abs() < 1e-18);
}

#[test]
fn what_is_written_is_read_back() {
    let header = format!("{READINGS},g1_sigma_um");
    let data = read(&header, &["1,2,3,4,5,6,7,8,0.9", ",2,,4,5,6,,,0.9", "1,,3,,,6,7,8,0.9"]).unwrap();
    let mut text = Vec::new();
    campaign_to_csv(&mut text, &machine(), &data).unwrap();
    let again = read_campaign_from(&machine(), text.as_slice(), "data.csv").unwrap().dataset;
    assert_eq!(again.blocks, data.blocks);
    assert_eq!(again.observations, data.observations, "{}", String::from_utf8_lossy(&text));
}

#[test]
fn not_a_number_in_memory_is_an_empty_cell() {
    let names = format!("{INPUTS},{READINGS}");
    let values = [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -100.0, 0.0, 0.0, 0.0];
    let readings = [f64::NAN, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0];
    let column = |(name, value): (&str, &f64)| MemoryColumn {
        name: name.to_owned(),
        cells: Cells::Numbers(vec![*value]),
    };
    let columns: Vec<MemoryColumn> =
        names.split(',').zip(values.iter().chain(&readings)).map(column).collect();
    let data = read_columns(&columns, "frame", GroupPurpose::Measurements, Some(&machine())).unwrap().dataset;
    assert_eq!(data.observations[0].numbers(), 5);
}

#[test]
fn every_mistake_says_what_to_write() {
    let said = |header: &str, row: &str| read(header, &[row]).unwrap_err();
    let none = said(READINGS, ",,,,,,,");
    assert!(none.contains("nothing was read in this row"), "{none}");
    let unknown = said(&format!("{READINGS},g7_um"), "1,2,3,4,5,6,7,8,9");
    assert!(unknown.contains("no sensor of the hexapod file is called \"g7\""), "{unknown}");
    let foreign = said(&READINGS.replace("da_um", "dx_um"), "1,2,3,4,5,6,7,8");
    assert!(foreign.contains("perhaps \"da_um\" is meant"), "{foreign}");
    let absent = said("da_um,g1_um,ball_x_um,ball_y_um,ball_z_um,level_x_urad", "1,2,3,4,5,6");
    assert!(absent.contains("sensor \"scale\" of the hexapod file has no column"), "{absent}");
    let unit = said(&READINGS.replace("level_x_urad", "level_x_um"), "1,2,3,4,5,6,7,8");
    assert!(unit.contains("um is a unit of length"), "{unit}");
    let axis = said(&READINGS.replace("ball_x_um", "ball_um"), "1,2,3,4,5,6,7,8");
    assert!(axis.contains("ball is a point: its columns are ball_x_um, ball_y_um, ball_z_um"), "{axis}");
    let twice = said(&format!("{READINGS},g1_um"), "1,2,3,4,5,6,7,8,9");
    assert!(twice.contains("g1 is given twice"), "{twice}");
    let text = said(READINGS, "1,2,three,4,5,6,7,8");
    assert!(text.contains("(g1_um)") && text.contains("this is not a number"), "{text}");
    let absolute =
        "measured_a_mm,measured_b_mm,measured_c_mm,measured_alpha_deg,measured_beta_deg,measured_gamma_deg";
    let modes =
        said(&format!("{absolute},{}", READINGS.replace("da_um,dc_um,", "")), "1,2,3,4,5,6,1,2,3,4,5,6");
    assert!(modes.contains("sensors read deflections"), "{modes}");
}

#[test]
fn a_sensor_that_cannot_be_is_refused() {
    let refused = |from: &str, to: &str| {
        let text = format!("{MACHINE}{}", SENSORS.replacen(from, to, 1));
        parse_hexapod(&text, "hexapod.toml").unwrap_err().to_string()
    };
    let cases = [
        ("[0, 0, 2]", "[0, 0, 0]", "a direction must not be zero"),
        ("\"ball\"", "\"g1\"", "two sensors are called \"g1\""),
        ("sigma_um = 0.3", "sigma_um = 0", "must be greater than zero"),
        ("\"distance\"", "\"distanz\"", "\"distanz\" is no kind of sensor"),
        ("\"g1\"", "\"G 1\"", "begins with a small letter"),
        ("\"g1\"", "\"a\"", "a sensor called \"a\" would take the column a_mm"),
        ("\"g1\"", "\"ref\"", "would take the column ref_fx_N"),
        ("\"g1\"", "\"delta_t\"", "would take the column delta_T_K"),
        ("leg = 3", "leg = 7", "a leg is numbered 1 to 6"),
        ("sigma_urad = 2", "sigma_um = 2", "a sensor of kind inclination states sigma_urad"),
        ("point_mm = [120, 0, 40]\n", "", "the key \"point_mm\" is missing"),
    ];
    for (from, to, rule) in cases {
        let said = refused(from, to);
        assert!(said.contains(rule), "{said}");
    }
}
