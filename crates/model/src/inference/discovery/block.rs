//! The building blocks of laws: what a leg carries, and what changes it.

/// What a block varies with. Two factors of one law never share it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Family {
    /// Forces of legs.
    Force,
    /// Length of the leg.
    Length,
    /// Direction of the leg.
    Direction,
    /// Pose of the platform.
    Pose,
    /// Temperature.
    Temperature,
    /// Time under load.
    Time,
    /// Way in which the load was reached.
    Approach,
    /// Wrench on the platform.
    Wrench,
}

/// A constant inside a block that is fitted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Constant {
    /// `period` of a wave over leg length, m.
    Period,
    /// `F`, a force at which something begins or saturates, N.
    Force,
    /// `tau`, a time constant, s.
    Time,
    /// `instant`, a time at which something happens, s.
    Instant,
    /// `length`, a leg length at which something begins, m.
    Length,
    /// `p`, an exponent of a force.
    Exponent,
}

impl Constant {
    /// All of them.
    pub(crate) const ALL: [Self; 6] =
        [Self::Period, Self::Force, Self::Time, Self::Instant, Self::Length, Self::Exponent];

    /// Name in formulas.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Period => "period",
            Self::Force => "F",
            Self::Time => "tau",
            Self::Instant => "instant",
            Self::Length => "length",
            Self::Exponent => "p",
        }
    }

    /// Unit of files, and how many of it make one SI unit.
    pub(crate) fn unit(self) -> (&'static str, f64) {
        match self {
            Self::Period | Self::Length => ("mm", 1e3),
            Self::Force => ("N", 1.0),
            Self::Time | Self::Instant => ("s", 1.0),
            Self::Exponent => ("1", 1.0),
        }
    }
}

/// A factor of a law.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Block {
    /// Short name for ids.
    pub(crate) slug: &'static str,
    /// Formula, SI.
    pub(crate) text: &'static str,
    /// A second formula with a size of its own: the other phase of a wave.
    pub(crate) twin: Option<&'static str>,
    /// Powers of N, m, K and s in its unit.
    pub(crate) powers: [f64; 4],
    /// The constant inside.
    pub(crate) constant: Option<Constant>,
    /// What it varies with.
    pub(crate) family: Family,
    /// As what something goes with; empty for a factor that makes a compliance of it.
    pub(crate) words: &'static str,
}

const fn block(
    slug: &'static str,
    text: &'static str,
    powers: [f64; 4],
    family: Family,
    words: &'static str,
) -> Block {
    Block { slug, text, twin: None, powers, constant: None, family, words }
}

const fn inner(constant: Constant, block: Block) -> Block {
    Block { constant: Some(constant), ..block }
}

const NONE: [f64; 4] = [0.0; 4];
const N: [f64; 4] = [1.0, 0.0, 0.0, 0.0];
const N2: [f64; 4] = [2.0, 0.0, 0.0, 0.0];
const N3: [f64; 4] = [3.0, 0.0, 0.0, 0.0];
const NM: [f64; 4] = [1.0, 1.0, 0.0, 0.0];
const N2M: [f64; 4] = [2.0, 1.0, 0.0, 0.0];
const NM2: [f64; 4] = [2.0, 2.0, 0.0, 0.0];
const NK: [f64; 4] = [1.0, 0.0, 1.0, 0.0];
const NMK: [f64; 4] = [1.0, 1.0, 1.0, 0.0];
const NS: [f64; 4] = [1.0, 0.0, 0.0, 1.0];
const NMS: [f64; 4] = [1.0, 1.0, 0.0, 1.0];
const M: [f64; 4] = [0.0, 1.0, 0.0, 0.0];
const M2: [f64; 4] = [0.0, 2.0, 0.0, 0.0];
const M3: [f64; 4] = [0.0, 3.0, 0.0, 0.0];
const K: [f64; 4] = [0.0, 0.0, 1.0, 0.0];
const K2: [f64; 4] = [0.0, 0.0, 2.0, 0.0];
const K3: [f64; 4] = [0.0, 0.0, 3.0, 0.0];
const S: [f64; 4] = [0.0, 0.0, 0.0, 1.0];
const S2: [f64; 4] = [0.0, 0.0, 0.0, 2.0];
const ROOT_S: [f64; 4] = [0.0, 0.0, 0.0, 0.5];

/// Index of the carrier of compliances among [`CARRIERS`].
pub(crate) const COMPLIANCE: usize = 0;

/// Index of the force under the load, which a compliance that something changes after the reference acts on.
pub(crate) const LOADED: usize = CARRIERS.len() - 1;

/// What a leg carries: differences between load and reference, zero without a load.
pub(crate) const CARRIERS: [Block; 28] = [
    block("compliance", "df", N, Family::Force, ""),
    block("square", "(f*abs(f) - f0*abs(f0))", N2, Family::Force, "the square of the force"),
    block("cube", "(f^3 - f0^3)", N3, Family::Force, "the cube of the force"),
    block(
        "even-square",
        "(f^2 - f0^2)",
        N2,
        Family::Force,
        "the square of the force, pulled or pressed alike",
    ),
    block(
        "magnitude",
        "(abs(f) - abs(f0))",
        N,
        Family::Force,
        "the size of the force, pulled or pressed alike",
    ),
    inner(
        Constant::Exponent,
        block(
            "power",
            "(sign(f)*abs(f/100)^p - sign(f0)*abs(f0/100)^p)",
            NONE,
            Family::Force,
            "a power of the force",
        ),
    ),
    inner(
        Constant::Force,
        block("pull-beyond", "(max(f - F, 0) - max(f0 - F, 0))", N, Family::Force, "the pull beyond a force"),
    ),
    inner(
        Constant::Force,
        block("push-beyond", "(min(f + F, 0) - min(f0 + F, 0))", N, Family::Force, "the push beyond a force"),
    ),
    inner(
        Constant::Force,
        block("saturating", "(tanh(f/F) - tanh(f0/F))", NONE, Family::Force, "the force, saturating"),
    ),
    block("step-square", "df*abs(df)", N2, Family::Force, "the square of the load step"),
    block("next-leg", "df_next", N, Family::Force, "the force of the next leg"),
    block("previous-leg", "df_previous", N, Family::Force, "the force of the leg before"),
    block("both-neighbors", "(df_next + df_previous)", N, Family::Force, "the forces of their neighbors"),
    block("opposite-leg", "df_opposite", N, Family::Force, "the force of the opposite leg"),
    block("other-legs", "df_others", N, Family::Force, "the forces of all other legs"),
    block("force-x", "(fx - ref_fx)", N, Family::Wrench, "the force along x"),
    block("force-y", "(fy - ref_fy)", N, Family::Wrench, "the force along y"),
    block("force-z", "(fz - ref_fz)", N, Family::Wrench, "the force along z"),
    block("moment-x", "(mx - ref_mx)", NM, Family::Wrench, "the moment about x"),
    block("moment-y", "(my - ref_my)", NM, Family::Wrench, "the moment about y"),
    block("moment-z", "(mz - ref_mz)", NM, Family::Wrench, "the moment about z"),
    block("load-x", "(f*fx - f0*ref_fx)", N2, Family::Force, "its force times the force along x"),
    block("load-y", "(f*fy - f0*ref_fy)", N2, Family::Force, "its force times the force along y"),
    block("load-z", "(f*fz - f0*ref_fz)", N2, Family::Force, "its force times the force along z"),
    block("load-mx", "(f*mx - f0*ref_mx)", N2M, Family::Force, "its force times the moment about x"),
    block("load-my", "(f*my - f0*ref_my)", N2M, Family::Force, "its force times the moment about y"),
    block("load-mz", "(f*mz - f0*ref_mz)", N2M, Family::Force, "its force times the moment about z"),
    block("loaded", "f", N, Family::Force, ""),
];

/// What changes the length of a leg without any load; zero in the reference state.
pub(crate) const COVARIATES: [Block; 13] = [
    block("temperature", "delta_T", K, Family::Temperature, "temperature"),
    block("temperature-2", "delta_T^2", K2, Family::Temperature, "the square of temperature"),
    block("temperature-3", "delta_T^3", K3, Family::Temperature, "the cube of temperature"),
    block("temperature-abs", "abs(delta_T)", K, Family::Temperature, "the size of the temperature change"),
    block("warming", "max(delta_T, 0)", K, Family::Temperature, "temperature, in warming only"),
    block("cooling", "min(delta_T, 0)", K, Family::Temperature, "temperature, in cooling only"),
    block("time", "elapsed", S, Family::Time, "time"),
    block("time-2", "elapsed^2", S2, Family::Time, "the square of time"),
    block("root-time", "sqrt(elapsed)", ROOT_S, Family::Time, "the root of time"),
    inner(
        Constant::Time,
        block("log-time", "ln(1 + elapsed/tau)", NONE, Family::Time, "the logarithm of time"),
    ),
    inner(
        Constant::Time,
        block("settling", "(1 - exp(-elapsed/tau))", NONE, Family::Time, "time towards an end value"),
    ),
    inner(Constant::Instant, block("jump", "step(elapsed - instant)", NONE, Family::Time, "time at once")),
    block("overload", "(1 - approach)/2", NONE, Family::Approach, "a load exceeded before"),
];

/// What changes a compliance, or the way in which a covariate acts.
pub(crate) const MODULATIONS: [Block; 38] = [
    Block {
        twin: Some("cos(2*pi*q/period)"),
        ..inner(
            Constant::Period,
            block("wave", "sin(2*pi*q/period)", NONE, Family::Length, "leg length, over and over"),
        )
    },
    block("length", "(q - q_home)", M, Family::Length, "leg length"),
    block("length-2", "(q - q_home)^2", M2, Family::Length, "the square of the way from the home length"),
    block("length-3", "(q - q_home)^3", M3, Family::Length, "the cube of the way from the home length"),
    block("length-abs", "abs(q - q_home)", M, Family::Length, "the way from the home length"),
    block("extension", "max(q - q_home, 0)", M, Family::Length, "leg length beyond the home length"),
    inner(
        Constant::Length,
        block("beyond-length", "step(q - length)", NONE, Family::Length, "leg length, at once"),
    ),
    block("nx", "nx", NONE, Family::Direction, "the leg's inclination along x"),
    block("ny", "ny", NONE, Family::Direction, "the leg's inclination along y"),
    block("nz", "nz", NONE, Family::Direction, "the leg's steepness"),
    block("nx-2", "nx^2", NONE, Family::Direction, "the square of the leg's inclination along x"),
    block("ny-2", "ny^2", NONE, Family::Direction, "the square of the leg's inclination along y"),
    block("nx-ny", "nx*ny", NONE, Family::Direction, "the leg's direction in the plane of the base"),
    block("nx-nz", "nx*nz", NONE, Family::Direction, "the leg's direction in the plane of x and z"),
    block("ny-nz", "ny*nz", NONE, Family::Direction, "the leg's direction in the plane of y and z"),
    block("a", "a", M, Family::Pose, "the platform's place along x"),
    block("b", "b", M, Family::Pose, "the platform's place along y"),
    block("c", "c", M, Family::Pose, "the platform's height"),
    block("alpha", "alpha", NONE, Family::Pose, "the tilt alpha of the platform"),
    block("beta", "beta", NONE, Family::Pose, "the tilt beta of the platform"),
    block("gamma", "gamma", NONE, Family::Pose, "the turn gamma of the platform"),
    block("a-2", "a^2", M2, Family::Pose, "the square of the platform's place along x"),
    block("b-2", "b^2", M2, Family::Pose, "the square of the platform's place along y"),
    block("c-2", "c^2", M2, Family::Pose, "the square of the platform's height"),
    block("alpha-2", "alpha^2", NONE, Family::Pose, "the square of the tilt alpha"),
    block("beta-2", "beta^2", NONE, Family::Pose, "the square of the tilt beta"),
    block("gamma-2", "gamma^2", NONE, Family::Pose, "the square of the turn gamma"),
    block("alpha-beta", "alpha*beta", NONE, Family::Pose, "the product of both tilts"),
    block("a-3", "a^3", M3, Family::Pose, "the cube of the platform's place along x"),
    block("b-3", "b^3", M3, Family::Pose, "the cube of the platform's place along y"),
    block("c-3", "c^3", M3, Family::Pose, "the cube of the platform's height"),
    block("a-b", "a*b", M2, Family::Pose, "the product of the platform's places along x and y"),
    block("tilt-2", "(alpha^2 + beta^2)", NONE, Family::Pose, "the square of the tilt"),
    block("radius-2", "(a^2 + b^2)", M2, Family::Pose, "the square of the way from the middle"),
    block("alpha-abs", "abs(alpha)", NONE, Family::Pose, "the size of the tilt alpha"),
    block("beta-abs", "abs(beta)", NONE, Family::Pose, "the size of the tilt beta"),
    block("approach", "approach", NONE, Family::Approach, "the direction of approach"),
    block("preload", "f0", N, Family::Force, "the preload of the leg"),
];

/// Index of what is applied with every load, among the causes of motions and wrenches.
pub(crate) const PRESENCE: usize = COVARIATES.len();

/// What moves base or platform, or loads it, beyond what the catalogue has: what is applied with every load, loads that act more
/// than in proportion, or with temperature or time.
pub(crate) const LOADS: [Block; 19] = [
    block("presence", "1", NONE, Family::Wrench, "every load"),
    block(
        "fx-square",
        "(fx*abs(fx) - ref_fx*abs(ref_fx))",
        N2,
        Family::Wrench,
        "the square of the force along x",
    ),
    block(
        "fy-square",
        "(fy*abs(fy) - ref_fy*abs(ref_fy))",
        N2,
        Family::Wrench,
        "the square of the force along y",
    ),
    block(
        "fz-square",
        "(fz*abs(fz) - ref_fz*abs(ref_fz))",
        N2,
        Family::Wrench,
        "the square of the force along z",
    ),
    block(
        "mx-square",
        "(mx*abs(mx) - ref_mx*abs(ref_mx))",
        NM2,
        Family::Wrench,
        "the square of the moment about x",
    ),
    block(
        "my-square",
        "(my*abs(my) - ref_my*abs(ref_my))",
        NM2,
        Family::Wrench,
        "the square of the moment about y",
    ),
    block(
        "mz-square",
        "(mz*abs(mz) - ref_mz*abs(ref_mz))",
        NM2,
        Family::Wrench,
        "the square of the moment about z",
    ),
    block("fx-temperature", "fx*delta_T", NK, Family::Temperature, "the force along x times temperature"),
    block("fy-temperature", "fy*delta_T", NK, Family::Temperature, "the force along y times temperature"),
    block("fz-temperature", "fz*delta_T", NK, Family::Temperature, "the force along z times temperature"),
    block("mx-temperature", "mx*delta_T", NMK, Family::Temperature, "the moment about x times temperature"),
    block("my-temperature", "my*delta_T", NMK, Family::Temperature, "the moment about y times temperature"),
    block("mz-temperature", "mz*delta_T", NMK, Family::Temperature, "the moment about z times temperature"),
    block("fx-time", "fx*elapsed", NS, Family::Time, "the force along x times time"),
    block("fy-time", "fy*elapsed", NS, Family::Time, "the force along y times time"),
    block("fz-time", "fz*elapsed", NS, Family::Time, "the force along z times time"),
    block("mx-time", "mx*elapsed", NMS, Family::Time, "the moment about x times time"),
    block("my-time", "my*elapsed", NMS, Family::Time, "the moment about y times time"),
    block("mz-time", "mz*elapsed", NMS, Family::Time, "the moment about z times time"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws_find_the_compliance_and_the_force_under_load_at_their_places() {
        assert_eq!((CARRIERS[COMPLIANCE].slug, CARRIERS[LOADED].text), ("compliance", "f"));
    }
}
