//! Files that a command writes, known as such by their type.

use std::ffi::OsString;
use std::ops::Deref;
use std::path::{Path, PathBuf};

use clap::{ArgMatches, Command};
use hexbench_core::files::{Destination, is_file, refuse_overlap};

use super::TableFile;
use crate::failure::Failure;

/// A file to be written; `-` is standard output, and so is every name that leads there.
#[derive(Debug, Clone)]
pub(crate) struct OutFile(PathBuf);

impl From<OsString> for OutFile {
    fn from(text: OsString) -> Self {
        let path = PathBuf::from(text);
        match Destination::of(&path) {
            Ok(Destination::StandardOutput) => Self("-".into()),
            _ => Self(path),
        }
    }
}

impl OutFile {
    /// True when this is standard output, where nothing else may go then.
    pub(crate) fn is_stdout(&self) -> bool {
        self.0.as_os_str() == "-"
    }

    /// True when one of these files is asked for and is standard output.
    pub(crate) fn any_is_stdout<'a>(files: impl IntoIterator<Item = &'a Option<Self>>) -> bool {
        files.into_iter().flatten().any(Self::is_stdout)
    }
}

impl Deref for OutFile {
    type Target = Path;

    fn deref(&self) -> &Path {
        &self.0
    }
}

/// A file, or a folder of files, to be written; folders on the way to it are made.
#[derive(Debug, Clone)]
pub(crate) struct OutPlace(OutFile);

impl From<OsString> for OutPlace {
    fn from(text: OsString) -> Self {
        Self(text.into())
    }
}

impl Deref for OutPlace {
    type Target = OutFile;

    fn deref(&self) -> &OutFile {
        &self.0
    }
}

/// Refuse what cannot be written where it is to go, and files in the place of folders, before any work.
pub(crate) fn refuse_misplaced(command: &Command, matches: &ArgMatches) -> Result<(), Failure> {
    if let Some((name, below)) = matches.subcommand() {
        return command.find_subcommand(name).map_or(Ok(()), |command| refuse_misplaced(command, below));
    }
    let folders: Vec<&Path> = folders(command, matches).collect();
    if folders.iter().any(|folder| folder.as_os_str() == "-") {
        return Err(Failure::usage("several files cannot go to standard output (-)", "Name a folder."));
    }
    if let Some(file) = folders.iter().find(|folder| folder.is_file()) {
        return Err(Failure::usage(format!("{} is a file, not a folder", file.display()), "Name a folder."));
    }
    for place in of_type::<OutPlace>(matches) {
        let there = place.ancestors().skip(1).find(|folder| folder.exists());
        if let Some(file) = there.filter(|folder| folder.is_file()) {
            return Err(Failure::unwritable(place)(is_file(file)));
        }
    }
    // A folder that the command makes is not there yet.
    let is_made = |path: &Path| folders.iter().any(|folder| path.starts_with(folder));
    let files = of_type::<OutFile>(matches).map(|file| &**file);
    for file in files.chain(of_type::<TableFile>(matches).map(TableFile::path)) {
        if let Some(cause) = Destination::of(file).err().filter(|_| !is_made(file)) {
            return Err(Failure::unwritable(file)(cause));
        }
    }
    Ok(())
}

/// Folders among the arguments.
fn folders<'m>(command: &Command, matches: &'m ArgMatches) -> impl Iterator<Item = &'m Path> {
    let is_folder = |id: &str| {
        let argument = command.get_arguments().find(|argument| argument.get_id() == id);
        argument.and_then(|a| a.get_value_names()).is_some_and(|names| names.iter().any(|name| name == "DIR"))
    };
    let ids: Vec<&str> = matches.ids().map(clap::Id::as_str).filter(|id| is_folder(id)).collect();
    let paths = ids.into_iter().filter_map(|id| matches.try_get_many::<PathBuf>(id).ok().flatten());
    paths.flatten().map(PathBuf::as_path)
}

/// Refuse outputs that would overwrite an input or each other, before any work. Every argument that is an [`OutFile`], an
/// [`OutPlace`] or a [`TableFile`] is an output, every other path an input; standard output, where pages go, is an output of every command.
pub(crate) fn refuse_overlaps(matches: &ArgMatches) -> Result<(), Failure> {
    if let Some((_, below)) = matches.subcommand() {
        return refuse_overlaps(below);
    }
    let inputs: Vec<&Path> = of_type::<PathBuf>(matches).map(PathBuf::as_path).collect();
    let places = of_type::<OutPlace>(matches).map(|place| &***place);
    let files = of_type::<OutFile>(matches).map(|file| &**file).chain(places);
    let mut outputs: Vec<&Path> = files.chain(of_type::<TableFile>(matches).map(TableFile::path)).collect();
    let standard_output = Path::new("-");
    if !outputs.contains(&standard_output) {
        outputs.push(standard_output);
    }
    refuse(&inputs, &outputs)
}

/// The same of files that no argument names.
pub(crate) fn refuse_overlaps_of(inputs: &[PathBuf], outputs: &[&Path]) -> Result<(), Failure> {
    let inputs: Vec<&Path> = inputs.iter().map(PathBuf::as_path).collect();
    refuse(&inputs, outputs)
}

fn refuse(inputs: &[&Path], outputs: &[&Path]) -> Result<(), Failure> {
    refuse_overlap(inputs, outputs)
        .map_err(|overlap| Failure::usage(overlap.to_string(), overlap.next_step()))
}

fn of_type<T: Clone + Send + Sync + 'static>(matches: &ArgMatches) -> impl Iterator<Item = &T> {
    matches.ids().filter_map(|id| matches.try_get_many::<T>(id.as_str()).ok().flatten()).flatten()
}

#[cfg(test)]
mod tests {
    use std::any::TypeId;

    use clap::CommandFactory;

    use super::*;

    /// An option that writes a file must be known as one, or its input could be overwritten.
    #[test]
    fn every_file_that_is_written_is_an_output() {
        let mut checked = 0;
        check(&crate::args::Cli::command(), &mut checked);
        assert!(checked > 30, "{checked}");
    }

    fn check(command: &Command, checked: &mut usize) {
        command.get_subcommands().for_each(|below| check(below, checked));
        for argument in command.get_arguments() {
            let help = argument.get_help().map(ToString::to_string).unwrap_or_default();
            let is_file =
                argument.get_value_names().is_some_and(|names| names.iter().any(|name| name == "FILE"));
            if is_file && help.starts_with("Write") {
                let kind = argument.get_value_parser().type_id();
                let outputs = [TypeId::of::<OutFile>(), TypeId::of::<OutPlace>(), TypeId::of::<TableFile>()];
                assert!(
                    outputs.iter().any(|output| kind == *output),
                    "{} {}",
                    command.get_name(),
                    argument.get_id()
                );
                *checked += 1;
            }
        }
    }
}
