//! An engine that does as it is told: answers, refuses, falls over, takes its time.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant};

use hexbench_core::interrupt::go_on;
use hexbench_workbench::bench::{Given, Refusal, RefusalKind};
use hexbench_workbench::server::Desk;
use hexbench_workbench::wire::{
    Ask, Export, FileText, Guess, KeepSession, Open, PlanReadings, Selection, ServerLimits, Try,
};
use serde::Serialize;
use serde_json::json;

/// Bytes of an export: more than the buffers between server and client hold.
const EXPORT_BYTES: usize = 32 << 20;

/// Held computations wait for it.
struct Gate {
    open: bool,
    before_it: usize,
}

static GATE: (Mutex<Gate>, Condvar) = (Mutex::new(Gate { open: false, before_it: 0 }), Condvar::new());

fn gate() -> MutexGuard<'static, Gate> {
    GATE.0.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Let held computations wait, or go.
pub(crate) fn set_gate(open: bool) {
    gate().open = open;
    GATE.1.notify_all();
}

/// Returns when a computation is held.
pub(crate) fn see_one_held() {
    drop(GATE.1.wait_while(gate(), |gate| gate.before_it == 0));
}

fn wait_at_the_gate() {
    let mut held = gate();
    held.before_it += 1;
    GATE.1.notify_all();
    let mut passed = GATE.1.wait_while(held, |gate| !gate.open).unwrap_or_else(PoisonError::into_inner);
    passed.before_it -= 1;
    GATE.1.notify_all();
}

/// Returns when none is held any more.
pub(crate) fn see_none_held() {
    drop(GATE.1.wait_while(gate(), |gate| gate.before_it > 0));
}

/// How long a search takes that nobody ends.
pub(crate) const LONG: Duration = Duration::from_secs(30);

/// A search that is going on; unwinding ends it too.
struct Counted;

impl Counted {
    fn begin() -> Self {
        gate().before_it += 1;
        GATE.1.notify_all();
        Self
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        gate().before_it -= 1;
        GATE.1.notify_all();
    }
}

/// A bench without physics.
pub(crate) struct Obedient;

fn refusal(kind: RefusalKind) -> Refusal {
    Refusal { kind, message: "the engine says no".into(), next: "The engine says what to do.".into() }
}

impl Desk for Obedient {
    fn catalogue(limits: ServerLimits, _: Option<&Given>) -> impl Serialize {
        json!({ "limits": limits })
    }

    fn open(request: &Open, _: Option<&Given>, _: &ServerLimits) -> Result<Self, Refusal> {
        match request {
            Open::Case { id } if id == "falls-over" => panic!("told to fall over"),
            Open::Case { id } if id == "absent" => Err(refusal(RefusalKind::Unknown)),
            Open::Files { data, .. } if data.text == "bad" => Err(refusal(RefusalKind::BadInput)),
            Open::Files { data, .. } if data.text == "long" => Err(refusal(RefusalKind::TooLarge)),
            _ => Ok(Self),
        }
    }

    fn opened(&self, id: &str) -> Result<impl Serialize, Refusal> {
        Ok(json!({ "id": id }))
    }

    fn bytes(&self) -> usize {
        0
    }

    fn view(&self, selection: &Selection) -> Result<impl Serialize + use<>, Refusal> {
        assert!(selection.terms != ["falls-over"], "told to fall over");
        Ok(json!({ "terms": selection.terms }))
    }

    fn try_each(&self, _: &Try) -> Result<impl Serialize + use<>, Refusal> {
        Ok(json!({ "trials": [] }))
    }

    fn followed(&self, _: &Selection) -> Result<impl Serialize + use<>, Refusal> {
        Ok(json!({ "panels": [] }))
    }

    fn picture(&self, _: &Selection) -> Result<impl Serialize + use<>, Refusal> {
        Ok(json!({ "picture": null }))
    }

    fn check(&self, _: &Ask) -> Result<impl Serialize + use<>, Refusal> {
        Ok(json!({ "ready": true }))
    }

    fn diagnose(&self, _: &Ask) -> Result<impl Serialize + use<>, Refusal> {
        wait_at_the_gate();
        Ok(json!({ "word": "adequate" }))
    }

    fn plan(&self, asked: &PlanReadings) -> Result<impl Serialize + use<>, Refusal> {
        Ok(json!({ "next": asked.choice.repeats }))
    }

    fn discover(&self, _: &Ask) -> Result<impl Serialize + use<>, Refusal> {
        let _counted = Counted::begin();
        let since = Instant::now();
        while since.elapsed() < LONG {
            go_on();
            sleep(Duration::from_millis(5));
        }
        Ok(json!({ "law": null }))
    }

    fn export(&self, _: &Export) -> Result<impl Serialize + use<>, Refusal> {
        Ok("x".repeat(EXPORT_BYTES))
    }

    fn keep(&self, _: &KeepSession) -> Result<impl Serialize + use<>, Refusal> {
        Ok(json!({ "name": "session.json" }))
    }

    fn resume(&self, file: &FileText) -> Result<impl Serialize + use<>, Refusal> {
        if file.text == "bad" { Err(refusal(RefusalKind::BadInput)) } else { Ok(json!({ "steps": [] })) }
    }

    fn reveal(&self, _: &Guess) -> Result<impl Serialize + use<>, Refusal> {
        Err::<(), _>(refusal(RefusalKind::Conflict))
    }
}
