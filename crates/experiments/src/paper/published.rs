//! What the paper prints, in its own units.
//!
//! Source: V. J. Kalas, A. Vissiere, T. Roux, O. Company, S. Krut, F. Pierrot, A new efficient stiffness evaluation method to
//! improve accuracy of hexapods, IDETC/CIE 2018, DETC2018-85986.

/// Table 1, the best pose set: a, b, c in mm, gamma in deg; alpha and beta are zero.
pub const BEST_POSES: [[f64; 4]; 3] =
    [[2.616, 0.832, -0.666, 15.756], [10.017, -3.434, -0.764, -11.007], [-7.784, -3.21, 1.76, -11.266]];

/// Table 2, identified leg stiffnesses, N/um.
pub const STIFFNESS_N_PER_UM: [f64; 6] = [4.1981, 3.7898, 2.7503, 4.32, 3.6716, 3.7288];

/// Table 3, positions along X and then along Y of the validation poses, mm; all else zero.
pub const VALIDATION_MM: [f64; 5] = [-30.0, -15.0, 0.0, 15.0, 30.0];

/// Table 4, root mean square error of prediction: a, b, c in um, alpha, beta, gamma in urad.
pub const PREDICTION_ERROR: [f64; 6] = [2.7, 3.1, 2.2, 6.4, 8.3, 8.8];

/// Root mean square of the measured dc over the validation poses, um, and what correction leaves of it.
pub const DC_BEFORE_UM: f64 = 13.5;
/// See [`DC_BEFORE_UM`].
pub const DC_AFTER_UM: f64 = 2.2;

/// Preload, kg.
pub const PRELOAD_KG: f64 = 12.2;
/// Full load, kg.
pub const FULL_LOAD_KG: f64 = 34.5;
/// Full load less preload, kg.
pub const EFFECTIVE_KG: f64 = 22.3;

/// Loads over which fig. 7 shows the observability index, N.
pub const FIGURE_7_LOADS_N: [f64; 5] = [100.0, 150.0, 200.0, 250.0, 300.0];
/// Largest index fig. 7 shows, at 300 N, as read from the figure; its unit is not stated.
pub const FIGURE_7_TOP: f64 = 200.0;
/// Point of fig. 8 as read from the figure: deflection along Z (um) at a load (N).
pub const FIGURE_8_POINT: [f64; 2] = [12.0, 290.0];
/// Readings at each pose.
pub const REPEATS: i64 = 3;
