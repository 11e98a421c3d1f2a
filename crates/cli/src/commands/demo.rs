//! `hexbench demo`: the whole story on measurements that come with the program, with its page at the end.

use std::io::{self, Read};
use std::path::Path;

use clap::Args;
use hexbench_core::files::{parse_hexapod, read_measurements_from, text_hash};
use hexbench_core::{Dataset, Hexapod};
use hexbench_model::results::diagnose::DiagnoseOptions;
use hexbench_model::results::discover::{Discovery, discover};
use hexbench_model::terms::catalogue;
use hexbench_report::charts::{self, ReportError};
use hexbench_report::render::{html, is_own};
use hexbench_report::words::{self, Provenance, ReportSubject};
use hexbench_workbench::bench::cases::{BundledCase, FOUNDATION, UNLISTED};

use crate::commands::diagnose::study;
use crate::failure::Failure;
use crate::output::{OutFile, Screen, report};

const CASE: BundledCase = FOUNDATION;
const FILES: [(&str, &str); 3] =
    [("hexapod.toml", CASE.hexapod), ("measurements.csv", CASE.data), ("holdout.csv", CASE.holdout)];

/// Where the page goes when nobody says.
const PAGE: &str = "report.html";

/// Run the whole workflow on bundled measurements: the springs fail, the program names the missing effect,
/// and the error drops
#[derive(Debug, Args)]
#[command(after_help = "Examples:\n  \
    hexbench demo\n  \
    hexbench demo -o story.html")]
pub(crate) struct Arguments {
    /// Write the page with charts to FILE instead of report.html
    #[arg(short, long, value_name = "FILE", conflicts_with = "no_report")]
    output: Option<OutFile>,
    /// Do not write the page
    #[arg(long)]
    no_report: bool,
}

/// Tell the story.
pub(crate) fn run(arguments: &Arguments, screen: &Screen) -> Result<(), Failure> {
    let (hexapod, data, holdout) = read(&CASE)?;
    let study = study(&hexapod, &data, Some(&holdout), &catalogue(), &DiagnoseOptions::default())?;
    let subject = ReportSubject::of(&hexapod, &data, Some(&holdout), &study);
    let failed = Failure::of_model(&data.source);
    let story = words::demo(&subject, &elsewhere()?).map_err(failed)?;
    screen.show(&story)?;
    if arguments.no_report { Ok(()) } else { page(&subject, arguments.output.as_deref(), screen) }
}

/// Hexapod, measurements and holdout.
fn read(case: &BundledCase) -> Result<(Hexapod, Dataset, Dataset), Failure> {
    let table = |text: &str, name| Ok::<_, Failure>(read_measurements_from(text.as_bytes(), name)?.dataset);
    let [hexapod, data, holdout] = FILES.map(|(name, _)| name);
    Ok((parse_hexapod(case.hexapod, hexapod)?, table(case.data, data)?, table(case.holdout, holdout)?))
}

/// What is found on the machine whose effect no catalogue has.
fn elsewhere() -> Result<Discovery, Failure> {
    let (hexapod, data, holdout) = read(&UNLISTED)?;
    let found = discover(&hexapod, &data, Some(&holdout), &catalogue(), &DiagnoseOptions::default());
    found.map(|study| study.discovery).map_err(Failure::of_model(&data.source))
}

/// The page. One that nobody asked for by name gives way to whatever is in its place, and its absence is no failure.
fn page(subject: &ReportSubject<'_>, asked: Option<&Path>, screen: &Screen) -> Result<(), Failure> {
    let path = asked.unwrap_or(Path::new(PAGE));
    let files = FILES.map(|(name, text)| (format!("{name} (bundled)"), text_hash(text)));
    let provenance = Provenance { command: "hexbench demo".to_owned(), files: files.to_vec() };
    let page = html(&charts::diagnosis(subject, &provenance)?).map_err(ReportError::from)?;
    match write(path, &page, screen) {
        Ok(()) => {
            let size = page.len().div_ceil(1000);
            report::note(&format!("The same with charts: {} ({size} kB), for a browser.", path.display()));
            Ok(())
        }
        Err(failure) if asked.is_some() => Err(failure),
        Err(failure) => {
            report::warn(&failure.to_string(), "`hexbench demo -o FILE` writes the page elsewhere.");
            Ok(())
        }
    }
}

fn write(path: &Path, page: &str, screen: &Screen) -> Result<(), Failure> {
    if path.as_os_str() != "-" && is_foreign(path) {
        return Err(Failure::usage(
            format!("{} exists and is not a page of hexbench; it was not replaced", path.display()),
            "Name another file, or move this one.",
        ));
    }
    screen.write_to(path, page)
}

/// Something is there that this program did not write.
fn is_foreign(path: &Path) -> bool {
    match head(path) {
        Ok(text) => !is_own(&text),
        Err(cause) => cause.kind() != io::ErrorKind::NotFound && path.exists(),
    }
}

/// The beginning of a file: a page says there who wrote it.
fn head(path: &Path) -> io::Result<String> {
    const ENOUGH: u64 = 2000;
    let mut bytes = Vec::new();
    std::fs::File::open(path)?.take(ENOUGH).read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
