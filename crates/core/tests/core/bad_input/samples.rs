//! A sound table and a sound hexapod, and ways to spoil them.

/// A table of text that tests spoil.
#[derive(Clone)]
pub(crate) struct Table {
    names: Vec<String>,
    rows: Vec<Vec<String>>,
}

const DEFLECTIONS: &str = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,\
    mz_Nm,approach,da_um,db_um,dc_um,dalpha_urad,dbeta_urad,dgamma_urad";
const POSES: &str = "pose,repeat,a_mm,b_mm,c_mm,alpha_deg,beta_deg,gamma_deg,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm,\
    measured_a_mm,measured_b_mm,measured_c_mm,measured_alpha_deg,measured_beta_deg,measured_gamma_deg";

/// Two deflections; the header is line 1, the rows are lines 2 and 3.
pub(crate) fn deflections() -> Table {
    let first = "1,1,6.5,4.25,0.5,-7.5,0.75,7.25,0,0,-338.5,0,0,0,1,-1.5,2.25,-13.125,-18.5,18.375,61.75";
    let second = "1,2,6.5,4.25,0.5,-7.5,0.75,7.25,0,0,-338.5,0,0,0,1,-0.5,2.75,-13.25,-12.125,20.75,61.25";
    Table::new(DEFLECTIONS, &[first, second])
}

/// Two absolute poses.
pub(crate) fn poses() -> Table {
    let first =
        "1,1,27.25,16.0,-11.25,5.25,5.5,-2.5,0,0,-49.05,0,0,0,26.925,15.966,-11.313,5.3177,5.6151,-2.4061";
    let second = "2,1,7.25,6.0,-1.25,5.0,5.25,-2.0,0,0,-49.05,0,0,0,6.925,5.966,-1.313,5.0177,5.3151,-1.9061";
    Table::new(POSES, &[first, second])
}

impl Table {
    fn new(names: &str, rows: &[&str]) -> Self {
        let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        Self { names: cells(names), rows: rows.iter().map(|row| cells(row)).collect() }
    }

    fn position(&self, name: &str) -> usize {
        self.names.iter().position(|known| known == name).unwrap_or_else(|| panic!("{name} is a column"))
    }

    /// Another value in the column `name` of the second row (line 3).
    pub(crate) fn set(mut self, name: &str, value: &str) -> Self {
        let position = self.position(name);
        self.rows[1][position] = value.into();
        self
    }

    /// Another name for a column.
    pub(crate) fn rename(mut self, name: &str, other: &str) -> Self {
        let position = self.position(name);
        self.names[position] = other.into();
        self
    }

    /// Without a column.
    pub(crate) fn without(mut self, name: &str) -> Self {
        let position = self.position(name);
        self.names.remove(position);
        self.rows.iter_mut().for_each(|row| drop(row.remove(position)));
        self
    }

    /// With one more column at the end.
    pub(crate) fn with(mut self, name: &str, value: &str) -> Self {
        self.names.push(name.into());
        self.rows.iter_mut().for_each(|row| row.push(value.into()));
        self
    }

    /// The first row once more, as line 4.
    pub(crate) fn repeated(mut self) -> Self {
        self.rows.push(self.rows[0].clone());
        self
    }

    /// Only the header.
    pub(crate) fn no_rows(mut self) -> Self {
        self.rows.clear();
        self
    }

    /// The text with another separator.
    pub(crate) fn separated(&self, separator: &str) -> String {
        let lines = std::iter::once(&self.names).chain(&self.rows);
        lines.map(|cells| cells.join(separator) + "\n").collect()
    }

    /// The text as it should be.
    pub(crate) fn text(&self) -> String {
        self.separated(",")
    }
}

/// A sound `hexapod.toml`.
pub(crate) const HEXAPOD: &str = r#"format = "hexapod/1"
name = "bench"

[geometry]
base_joints_mm = [
  [157.5, -27.75, -165],
  [157.5, 27.75, -165],
  [-54.75, 150.25, -165],
  [-102.75, 122.5, -165],
  [-102.75, -122.5, -165],
  [-54.75, -150.25, -165],
]
platform_joints_mm = [
  [77.25, -92, 0],
  [77.25, 92, 0],
  [41, 112.75, 0],
  [-118.25, 20.75, 0],
  [-118.25, -20.75, 0],
  [41, -112.75, 0],
]

[metrology]
sigma_translation_um = 0.5
sigma_rotation_urad = 3

[legs]
nominal_stiffness_N_per_um = 4.5
min_length_mm = 150
max_length_mm = 250
brackets = [[1, 2], [3, 4], [5, 6]]

[base]
mounting_plane_z_mm = -170

[payload]
center_of_gravity_mm = [0, 0, 40]
"#;

/// The sound hexapod with one passage replaced.
pub(crate) fn hexapod(old: &str, new: &str) -> String {
    assert!(HEXAPOD.contains(old), "{old}");
    HEXAPOD.replacen(old, new, 1)
}
