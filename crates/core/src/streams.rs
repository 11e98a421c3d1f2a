//! Independent random streams: one for every seed, purpose and number.
//!
//! ```text
//! h = m(seed),  h <- m(h ^ m(x)) for the purpose and each number x      m: one step of SplitMix64
//! state = (h, m(!h)),  increment = m(h ^ last number)
//! ```
//!
//! Everything is hashed into state and increment, because generators of this kind are not independent when their states are
//! equal or neighbors and their increments count up: the ninth draws of trial k and trial k + 1 then correlate by 0.07.
//! `crates/core/tests/core/streams/correlation.rs` measures both forms. All random numbers of the bench come from here.
//!
//! Sources: O'Neill 2014, Harvey Mudd College HMC-CS-2014-0905 (PCG, the generator); Steele, Lea, Flood 2014, OOPSLA (`SplitMix`,
//! the hash).

use rand_pcg::Pcg64;

/// What a stream decides. Each use of random numbers has a purpose of its own, so that none shares a stream with another,
/// whatever the seeds and numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u64)]
pub enum Purpose {
    /// Scene: loads of the plan.
    SceneLoads = 1,
    /// Scene: frames of the instrument.
    SceneFrames = 2,
    /// Scene: a pose to learn from.
    SceneTrainingPose = 10,
    /// Scene: a pose to judge by.
    SceneHoldoutPose = 11,
    /// Scene: approach and surroundings of a condition to learn from.
    SceneTrainingSurroundings = 20,
    /// Scene: approach and surroundings of a condition to judge by.
    SceneHoldoutSurroundings = 21,
    /// Scene: noise of a row to learn from.
    SceneTrainingNoise = 30,
    /// Scene: noise of a row to judge by.
    SceneHoldoutNoise = 31,
    /// Scene: noise of a reference reading that rows to learn from share.
    SceneTrainingReferenceNoise = 32,
    /// Scene: noise of a reference reading that rows to judge by share.
    SceneHoldoutReferenceNoise = 33,

    /// Case: its effects, the same in every attempt.
    CaseEffects = 100,
    /// Case: family of machines, make of the plan, distance and seed of an attempt.
    CaseSpec = 101,
    /// Case: machine and leg stiffness.
    CaseMachine = 102,
    /// Case: poses, loads and surroundings.
    CasePlan = 103,
    /// Case: shapes and sizes of its effects.
    CaseEffectShapes = 104,
    /// Case: noise of the readings.
    CaseNoise = 105,
    /// Case: frames of the instrument.
    CaseFrames = 106,
    /// Case: what a fault of the laboratory hits.
    CaseFault = 107,
    /// Case: what a misstatement of its files hits.
    CaseMisstatement = 108,
    /// Case: noise and empty cells of its sensors.
    CaseSensors = 109,
    /// Case: where its sensors really stand.
    CaseSensorSetup = 110,
    /// Case: noise of readings that tell the same.
    CaseAlikeNoise = 111,
    /// Case: empty cells of them.
    CaseAlikeGaps = 112,

    /// Comparison of two worlds: machine, plan and situation.
    WorldsSituation = 200,
    /// Comparison of two worlds: shape of the effect.
    WorldsEffect = 201,

    /// Campaigns of springs alone: a piece of them.
    SpringTrials = 300,
    /// Simulated outcomes behind the chance to tell two explanations apart.
    SeparationOutcomes = 301,
    /// Draws from the Gaussian behind the evidence of a set of effects.
    GaussianCheck = 302,
    /// Conditions at which two statements about their scatter are compared.
    ComparedConditions = 303,

    /// Readings that are used of a long table.
    DrawnReadings = 304,

    /// Exchange of readings: a random plan to start from.
    ExchangeStart = 400,
    /// Poses from a low-discrepancy sequence that has been used up: its next scrambling.
    SobolScrambling = 401,
    /// Power of a plan: noise behind the threshold of a test.
    PowerTest = 402,
    /// Power of a plan: noise behind what a signature is confused with.
    PowerConfusion = 403,
    /// Choice of sensors: a random set to start from.
    SensorStart = 404,

    /// Recovery: what a campaign is.
    RecoveryCampaign = 500,
    /// Recovery: seed of the campaigns that are diagnosed.
    RecoveryDiagnoses = 501,
    /// Power in the simulated world: effects of usual size.
    PowerEffects = 510,
    /// Power in the simulated world: noise of campaigns without an effect.
    PowerCleanNoise = 511,
    /// Power in the simulated world: noise of campaigns with an effect of usual size.
    PowerUsualNoise = 512,
    /// Power in the simulated world: noise of campaigns with an effect as large as is seen.
    PowerSeenNoise = 513,
    /// Power in the simulated world: errors of the inputs of a campaign.
    PowerInputErrors = 514,
    /// Effects a plan confuses: what a trial is, and the readings at random beside those chosen.
    ConfusionTrial = 520,
    /// Effects a plan confuses: noise of further readings.
    ConfusionFurtherNoise = 521,
    /// Effects a plan confuses: machine and leg stiffness.
    ConfusionMachine = 522,
    /// Effects a plan confuses: poses, loads and surroundings.
    ConfusionPlan = 523,
    /// Effects a plan confuses: shape of the effect.
    ConfusionEffect = 524,
    /// Effects a plan confuses: noise of the first readings.
    ConfusionNoise = 525,
    /// The publication's experiment: noise of a set of readings.
    PaperNoise = 530,
    /// The publication's experiment: the richer plan.
    PaperPlan = 531,
    /// The publication's experiment: noise of its repetitions.
    PaperRepetitions = 532,
    /// The publication's experiment: seed of a repetition with other poses and other noise.
    PaperAgain = 533,
    /// Regression: seed of the fits of a run.
    RegressFits = 540,
    /// Regression: seed of the diagnoses of a run.
    RegressDiagnoses = 541,
    /// Regression: seed of the laboratories of a run.
    RegressLaboratories = 542,
    /// Regression: seed of the files of a run that do not say what is meant.
    RegressFiles = 543,

    /// Misread files: seed of a sound campaign in a scene.
    MisreadScene = 550,

    /// Interactions: seed of the machine, plan and sizes of a set of effects.
    InteractionCase = 560,
    /// Interactions: the effects of a triple.
    InteractionTriple = 561,

    /// Challenge: order of the cases.
    ChallengeOrder = 600,
    /// Challenge: seed of a group of cases.
    ChallengeGroup = 601,
    /// Challenge: sizes of effects.
    ChallengeSize = 603,
    /// Gate: runs of before and after a change, exchanged case by case.
    GateExchange = 602,
    /// Workbench: kind and number of a hidden case.
    WorkbenchGame = 700,

    /// A sample that decides nothing: any other would do.
    Example = 900,
    /// A test.
    Test = 901,

    /// Sweep over choices of an experiment; its own purposes are the first number.
    Study = 0x0053_5455_4459,
}

/// The random stream of a seed, a purpose, and the numbers of what it is for: a row, a trial, a block.
///
/// # Example
/// ```
/// use hexbench_core::streams::{Purpose, stream};
///
/// let of_trial = |trial| stream(7, Purpose::Test, [trial]);
/// assert_eq!(of_trial(3), of_trial(3));
/// assert_ne!(of_trial(3), of_trial(4));
/// ```
pub fn stream<const N: usize>(seed: u64, purpose: Purpose, numbers: [u64; N]) -> Pcg64 {
    let hash = hashed(seed, purpose, &numbers);
    let last = numbers.last().copied().unwrap_or(purpose as u64);
    Pcg64::new(u128::from(hash) << 64 | u128::from(mixed(!hash)), u128::from(mixed(hash ^ last)))
}

/// A seed for a part that takes a seed of its own; parts of one seed, and of neighboring ones, have nothing in common.
pub fn derived_seed<const N: usize>(seed: u64, purpose: Purpose, numbers: [u64; N]) -> u64 {
    hashed(seed, purpose, &numbers)
}

fn hashed(seed: u64, purpose: Purpose, numbers: &[u64]) -> u64 {
    let with = |hash: u64, number: u64| mixed(hash ^ mixed(number));
    numbers.iter().fold(with(mixed(seed), purpose as u64), |hash, &number| with(hash, number))
}

/// One step of `SplitMix64`: a bijection whose output bits all depend on all input bits.
fn mixed(word: u64) -> u64 {
    let mut z = word.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}
