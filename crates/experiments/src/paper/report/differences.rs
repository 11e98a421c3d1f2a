//! Every difference to the paper, with its reason.

use hexbench_report::Section;

use super::super::study::Reproduction;
use super::number;

/// What differs and why.
pub(super) fn reasons(study: &Reproduction) -> Section {
    Section::new("Differences, one sentence each").list([
        "Geometry: the paper's is confidential; ours was chosen to agree with its dc (14.5 um without noise on our validation poses, 13.5 um measured on its own).".to_owned(),
        "Equations 3 to 13 print two Jacobians alike: forces and moments are conjugate to the twist, so the J beside them is the \
         geometric one, and the one that maps to differences of Euler angles is another; we use each where it belongs (at poses \
         without tilt they agree)."
            .to_owned(),
        "Equation 14 takes N as the number of poses; with N readings instead, repeats leave O1 unchanged, since the singular values grow with the root of their number.".to_owned(),
        format!(
            "Table 1: our best poses turn further and do not move in a and b (O1 {} against {}), because the workspace and geometry differ.",
            number(study.best_sets[0].1.observability.o1, 0),
            number(study.published_set.observability.o1, 0)
        ),
        "Table 2: ours scatters about it by the noise of one experiment, since Table 2 is our truth.".to_owned(),
        "Table 2: leg 3 is a quarter softer than the others; the paper gives no reason, and springs that absorb another effect would look \
         like that."
            .to_owned(),
        "Table 4: our rotations are at the noise of 1 um per ball coordinate, the paper's a little below; its instrument may be better."
            .to_owned(),
        "Fig. 8: ours is steeper, see step 4.".to_owned(),
        "Figs. 9 and 10: the paper's curves are not tabulated, so only their root mean squares can be compared.".to_owned(),
    ])
}

/// What cannot be told.
pub(super) fn limits() -> Section {
    Section::new("What this does not show").list([
        "That the paper's machine stood on a soft support. It shows that such a support would leave the published errors, which of the \
         other effects would not, and that the published plan could not have told.",
        "Drift of the measuring machine between the two readings would also move without turning. It has no place in the paper's data, \
         which carry no times, and is not simulated here.",
    ])
}
