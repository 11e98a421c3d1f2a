//! Failures and warnings on standard error: with a caret into the file on a terminal, in plain lines elsewhere.

use std::fmt;
use std::io::{self, IsTerminal, Write};

use hexbench_core::visible_lines;
use hexbench_report::render::WIDTH;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};

use super::excerpt::Excerpt;

use super::Colour;
use super::quiet::is_quiet;
use crate::failure::Failure;

/// Tell why the command stopped.
pub(crate) fn print(failure: &Failure, colour: Colour) {
    let stderr = io::stderr();
    let text = if stderr.is_terminal() { graphical(failure, colour.on(&stderr)) } else { plain(failure) };
    say(&text);
}

/// Tell something that does not stop the command.
pub(crate) fn warn(message: &str, next: &str) {
    say(&visible_lines(&format!("warning: {message}\n  next: {next}\n")));
}

/// Tell something that is as it should be, unless everything is to be quiet.
pub(crate) fn note(message: &str) {
    if !is_quiet() {
        say(&visible_lines(&format!("{message}\n")));
    }
}

/// A closed standard error leaves nobody to tell.
fn say(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
}

fn plain(failure: &Failure) -> String {
    let next = failure.next_step().map(|step| format!("  next: {step}\n")).unwrap_or_default();
    visible_lines(&format!("error: {failure}\n{next}")).into_owned()
}

fn graphical(failure: &Failure, colour: bool) -> String {
    let theme = if colour { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme).with_width(WIDTH).with_context_lines(0);
    let mut text = String::new();
    let report = Pointed { failure, excerpt: excerpt(failure) };
    // Formatting into a String fails only when a Display does; the plain form is left then.
    match handler.render_report(&mut text, &report) {
        Ok(()) => text,
        Err(fmt::Error) => plain(failure),
    }
}

fn excerpt(failure: &Failure) -> Option<Excerpt> {
    let Failure::File(error) = failure else { return None };
    Excerpt::of(&error.path, error.place.span.as_ref()?, error.place.line?)
}

/// A failure with the place it points to.
#[derive(Debug)]
struct Pointed<'a> {
    failure: &'a Failure,
    excerpt: Option<Excerpt>,
}

impl fmt::Display for Pointed<'_> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&visible_lines(&self.failure.to_string()))
    }
}

impl std::error::Error for Pointed<'_> {}

impl Diagnostic for Pointed<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(visible_lines(&self.failure.next_step()?).into_owned()))
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.excerpt.as_ref().map(|e| e as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.excerpt.as_ref()?.span();
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(Some("here".into()), span))))
    }
}
