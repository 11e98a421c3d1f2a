//! The list of targets.

mod applications;
mod experiments;
mod machines;
mod requests;
mod simulations;
mod tables;
mod texts;

/// Something that reads bytes.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    /// Its name, of the folder of its corpus and of its program too.
    pub name: &'static str,
    /// What is done with the bytes: true when they are accepted, false when they are refused; panics where a promise is broken.
    pub check: fn(&[u8]) -> bool,
}

/// Every target, in the order of the alphabet.
pub const TARGETS: [Target; 22] = [
    Target { name: "answer", check: experiments::answer },
    Target { name: "ball_places", check: machines::ball_places },
    Target { name: "balls", check: tables::balls },
    Target { name: "baseline", check: experiments::baseline },
    Target { name: "campaign", check: applications::campaign },
    Target { name: "formula", check: texts::formula },
    Target { name: "hexapod", check: machines::hexapod },
    Target { name: "journal", check: experiments::journal },
    Target { name: "loads", check: tables::loads },
    Target { name: "measurements", check: tables::measurements },
    Target { name: "model", check: applications::model },
    Target { name: "requests", check: requests::requests },
    Target { name: "robot", check: machines::robot },
    Target { name: "scene", check: simulations::scene },
    Target { name: "sensors", check: machines::sensors },
    Target { name: "session", check: texts::session },
    Target { name: "space", check: machines::space },
    Target { name: "study", check: experiments::study },
    Target { name: "suite", check: experiments::suite },
    Target { name: "term", check: texts::term },
    Target { name: "truth", check: simulations::truth },
    Target { name: "workbook", check: tables::workbook },
];

/// A target by its name.
pub fn named(name: &str) -> Option<&'static Target> {
    TARGETS.iter().find(|target| target.name == name)
}
