//! `hexbench discover HEXAPOD DATA`.

use std::path::{Path, PathBuf};

use clap::Args;
use hexbench_model::results::discover::{DiscoveryStudy, MOST_LAWS, discover_watched, most_steps};
use hexbench_model::results::runs::WithOrigin;
use hexbench_report::words::{LawFiles, ReportSubject, as_word};
use hexbench_report::{charts, words};

use super::diagnose;
use crate::failure::Failure;
use crate::output::{OutFile, PageFiles, Progress, Screen, report, write_json};
use crate::question::{Asked, Question};
use crate::read_as::ReadAs;

/// Search for a law outside the catalogue that explains what springs and catalogue do not
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench discover hexapod.toml measurements.csv --holdout holdout.csv -o law.toml")]
pub(crate) struct Arguments {
    #[command(flatten)]
    question: Question,
    #[command(flatten)]
    read_as: ReadAs,
    /// Write discovery.json to FILE, or to standard output (-) instead of the page
    #[arg(long, value_name = "FILE")]
    json: Option<OutFile>,
    /// Write the best law to FILE as a term file (term/1) for `--term`, or to standard output (-) instead of the page; if no law is found,
    /// nothing is written
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutFile>,
    /// Write the law, and those that these readings cannot separate from it, to DIR as term files (law-1.toml, law-2.toml, ...) for
    /// `discriminate --term`
    #[arg(long, value_name = "DIR")]
    all: Option<PathBuf>,
    #[command(flatten)]
    page: PageFiles,
}

impl Arguments {
    /// The files that may be written to the folder of all laws.
    fn laws(&self) -> Vec<PathBuf> {
        let name = |number| format!("law-{number}.toml");
        self.all.iter().flat_map(|folder| (1..=MOST_LAWS).map(|n| folder.join(name(n)))).collect()
    }

    /// What the next commands name.
    fn files(&self) -> LawFiles {
        let law = self.output.as_ref().filter(|file| !file.is_stdout()).map(|file| as_word(file.as_os_str()));
        let (asked, left_out) = (self.question.words(&self.read_as), self.question.left_out());
        LawFiles { asked, left_out, law, all: self.all.as_ref().map(as_word) }
    }
}

/// Search and tell.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    arguments.question.refuse_overlaps(&arguments.laws())?;
    let asked = arguments.question.read(&arguments.read_as)?;
    let Asked { hexapod, data, holdout, terms, options } = &asked;
    let progress = Progress::of(most_steps(data), "steps at most");
    let watch = || progress.advance(1);
    let study = discover_watched(hexapod, data, holdout.as_ref(), terms, options, &watch)
        .map_err(Failure::of_model(&data.source))?;
    progress.done();
    let to_stdout =
        OutFile::any_is_stdout([&arguments.json, &arguments.output]) || arguments.page.to_stdout();
    if let Some(path) = &arguments.json {
        let run = arguments.question.origin(&asked)?;
        write_json(screen, Some(path), &WithOrigin { result: &study.discovery, run })?;
    }
    let files = arguments.files();
    write_law(arguments.output.as_deref(), &study, screen)?;
    write_all(arguments.all.as_deref(), &study, screen)?;
    arguments.page.write(screen, || {
        let with_law = diagnose::study(hexapod, data, holdout.as_ref(), &study.competing(terms), options)?;
        let subject = ReportSubject::of(hexapod, data, holdout.as_ref(), &with_law);
        Ok(charts::discovery(&subject, &study, &files, &arguments.question.provenance()?)?)
    })?;
    if !to_stdout {
        let subject = ReportSubject::of(hexapod, data, holdout.as_ref(), &study.diagnosis);
        screen.show(&words::discovery(subject.hexapod, subject.data, subject.holdout, &study, &files))?;
    }
    Ok(())
}

/// The law as a term file; an idea that does not convince is not written, so that nobody takes it for a finding.
fn write_law(path: Option<&Path>, study: &DiscoveryStudy, screen: &Screen) -> Result<(), Failure> {
    let Some(path) = path else { return Ok(()) };
    if let Some(text) = study.term_file() {
        return screen.write_to(path, text);
    }
    warn_without(path);
    Ok(())
}

/// The same of all laws that look alike.
fn write_all(folder: Option<&Path>, study: &DiscoveryStudy, screen: &Screen) -> Result<(), Failure> {
    let Some(folder) = folder else { return Ok(()) };
    if study.term_files.is_empty() {
        warn_without(folder);
    }
    for (law, text) in study.discovery.laws.iter().zip(&study.term_files) {
        screen.write_into(folder, &format!("{}.toml", law.id), text)?;
    }
    Ok(())
}

fn warn_without(path: &Path) {
    let next = "Nothing, or see the ideas of the page: each can be written as a term file by hand.";
    report::warn(&format!("{} is not written: no law was found", path.display()), next);
}
