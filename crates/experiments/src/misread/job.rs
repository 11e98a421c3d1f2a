//! What a trial is: a campaign whose files are written wrongly, or a sound one.

use hexbench_truth::campaign::CaseKind;
use hexbench_truth::campaign::machines::FAMILIES;
use hexbench_truth::misstatements::{self, MeantFor, MisstatementEntry};

use super::MisreadScene;
use crate::trial::numbered;

/// Sizes of the effects of sound campaigns over the usual one.
pub(super) const SIZES: [u32; 3] = [1, 3, 10];

/// A campaign and how its files are written.
#[derive(Debug, Clone)]
pub enum MisreadJob {
    /// A campaign whose files are written wrongly.
    Misread {
        /// How.
        entry: &'static MisstatementEntry,
        /// Family of the machine.
        family: &'static str,
        /// A clean machine, one effect, or absolute poses.
        kind: CaseKind,
        /// Number within the kind; the same number is the same campaign however it is written.
        index: usize,
    },
    /// A sound campaign.
    Sound {
        /// Its kind.
        kind: CaseKind,
        /// Size of its effects over the usual one.
        size: u32,
        /// Number within the kind.
        index: usize,
    },
    /// A sound campaign in a scene.
    Scene {
        /// The scene.
        scene: MisreadScene,
        /// Size of its effects over those it has.
        size: u32,
        /// Number of the campaign.
        index: usize,
    },
}

/// Kinds of campaigns that are written wrongly.
const MISREAD: [CaseKind; 2] = [CaseKind::Clean, CaseKind::Single];
/// Kinds of sound campaigns, in turn.
const SOUND_KINDS: [CaseKind; 7] = [
    CaseKind::Single,
    CaseKind::Pair,
    CaseKind::Outside,
    CaseKind::Clean,
    CaseKind::SeedProtocol,
    CaseKind::Absolute,
    CaseKind::RichForm,
];

impl MisreadJob {
    /// Families in turn, clean and with an effect by turns, after two rounds every family has had both; or of absolute poses.
    pub(super) fn misread(entry: &'static MisstatementEntry, index: usize) -> Self {
        let (family, round) = (FAMILIES[index % FAMILIES.len()], index / FAMILIES.len());
        let kind = match entry.meant_for {
            MeantFor::Deflections => MISREAD[(index % FAMILIES.len() + round) % MISREAD.len()],
            MeantFor::AbsolutePoses => CaseKind::Absolute,
        };
        Self::Misread { entry, family, kind, index }
    }

    /// Kinds in turn, and behind each round one in a scene where there are scenes.
    pub(super) fn sound(number: usize, scenes: &[MisreadScene]) -> Self {
        let round = SOUND_KINDS.len() + usize::from(!scenes.is_empty());
        let index = number / round;
        if let Some(&kind) = SOUND_KINDS.get(number % round) {
            return Self::Sound { kind, size: SIZES[index % SIZES.len()], index };
        }
        let size = SIZES[index / scenes.len() % SIZES.len()];
        Self::Scene { scene: scenes[index % scenes.len()].clone(), size, index }
    }

    /// What is done to which campaign: `fz-negated/ring_a-clean-0000`, `sound/single-10x-0002`, `scene/paper-3x-0014`.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Misread { entry, family, kind, index } => {
                format!("{}/{family}-{}-{index:04}", entry.id, kind.name())
            }
            Self::Sound { kind, size, index } => format!("sound/{}-{size}x-{index:04}", kind.name()),
            Self::Scene { scene, size, index } => format!("scene/{}-{size}x-{index:04}", scene.name),
        }
    }

    /// The trial of a name.
    pub(super) fn parse(name: &str, scenes: &[MisreadScene]) -> Option<Self> {
        let (how, rest) = name.split_once('/')?;
        let (rest, index) = numbered(rest)?;
        if let Some(entry) = misstatements::entry(how) {
            let kinds = MISREAD.into_iter().chain([CaseKind::Absolute]);
            let (family, kind) = kinds.into_iter().find_map(|k| Some((before(rest, k.name())?, k)))?;
            let family = FAMILIES.iter().copied().find(|f| *f == family)?;
            return Some(Self::Misread { entry, family, kind, index });
        }
        let (of, size) = SIZES.into_iter().find_map(|s| Some((before(rest, &format!("{s}x"))?, s)))?;
        match how {
            "sound" => {
                let kind = SOUND_KINDS.into_iter().find(|k| k.name() == of)?;
                Some(Self::Sound { kind, size, index })
            }
            "scene" => {
                let scene = scenes.iter().find(|scene| scene.name == of)?.clone();
                Some(Self::Scene { scene, size, index })
            }
            _ => None,
        }
    }
}

/// What stands before a last word and its hyphen.
fn before<'a>(text: &'a str, last: &str) -> Option<&'a str> {
    text.strip_suffix(last)?.strip_suffix('-')
}
