//! Computations that can be ended before they are done, by whoever no longer wants them.
//!
//! ```text
//! who asks      Interrupt::ask          a client that has gone away, a limit of time
//! who computes  Interrupt::obeyed_here  on each of its threads, once
//!               go_on                   between its steps: unwinds the thread when it was asked to
//! ```
//!
//! Nothing is printed and nothing is answered: a computation that was ended has no result. Where nobody has said
//! [`obeyed_here`](Interrupt::obeyed_here), [`go_on`] does nothing.

use std::cell::RefCell;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

thread_local! {
    static OBEYED: RefCell<Option<Interrupt>> = const { RefCell::new(None) };
}

/// A request to end a computation, shared by who may ask and the threads that obey.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

/// What a thread unwinds with that was asked to end.
#[derive(Debug, Clone, Copy)]
pub struct Interrupted;

impl Interrupt {
    /// Asks the computation to end at its next step.
    pub fn ask(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Has this thread obey from here on; a thread obeys the last one it was told of.
    pub fn obeyed_here(&self) {
        OBEYED.with(|obeyed| *obeyed.borrow_mut() = Some(self.clone()));
    }
}

/// Ends the computation of this thread when it was asked to: unwinds with [`Interrupted`], past the hook that reports panics.
pub fn go_on() {
    let is_asked = |obeyed: &Option<Interrupt>| obeyed.as_ref().is_some_and(|i| i.0.load(Ordering::Relaxed));
    if OBEYED.with(|obeyed| is_asked(&obeyed.borrow())) {
        resume_unwind(Box::new(Interrupted));
    }
}

#[cfg(test)]
mod tests {
    use std::thread;

    use super::*;

    #[test]
    fn a_thread_goes_on_until_it_is_asked_to_end() {
        go_on();
        let interrupt = Interrupt::default();
        let obeys = interrupt.clone();
        let (tell, told) = std::sync::mpsc::channel();
        let computes = thread::spawn(move || {
            obeys.obeyed_here();
            go_on();
            tell.send(()).unwrap();
            loop {
                go_on();
                thread::yield_now();
            }
        });
        told.recv().unwrap();
        interrupt.ask();
        assert!(computes.join().unwrap_err().is::<Interrupted>());
        go_on();
    }
}
