//! Where the bytes of an output go, and which outputs would destroy something.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

use thiserror::Error;

/// Most links that are followed from a name to what it stands for; the limit of Linux.
const MOST_LINKS: usize = 40;

/// What an output is written to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Destination {
    /// Standard output: `-`, `/dev/stdout`, and whatever else leads there.
    StandardOutput,
    /// A device, a pipe or an open descriptor: it receives bytes and is never replaced.
    Stream(PathBuf),
    /// A file at the end of all links, in a folder that exists; it is replaced as a whole.
    File(PathBuf),
}

impl Destination {
    /// What a path stands for; the file itself need not exist.
    ///
    /// # Errors
    /// A folder that does not exist, a folder in place of a file, links that lead in a circle.
    pub fn of(path: &Path) -> io::Result<Self> {
        if path.as_os_str() == "-" {
            return Ok(Self::StandardOutput);
        }
        if path.as_os_str().as_encoded_bytes().ends_with(b"/") {
            return Err(is_folder());
        }
        let place = end_of_links(path)?;
        if is_standard_output(&place) {
            return Ok(Self::StandardOutput);
        }
        match fs::metadata(&place) {
            Ok(found) if found.is_dir() => Err(is_folder()),
            Ok(found) if !found.is_file() || is_descriptor(&place) => Ok(Self::Stream(place)),
            _ => Ok(Self::File(place)),
        }
    }
}

fn is_folder() -> io::Error {
    io::Error::new(io::ErrorKind::IsADirectory, "this is a folder, not a file")
}

/// What is wrong with a file in the place of a folder.
pub fn is_file(path: &Path) -> io::Error {
    io::Error::new(io::ErrorKind::NotADirectory, format!("{} is a file, not a folder", path.display()))
}

/// Two names of one thing in the arguments of a command, one of which is written.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Overlap {
    /// An output that is an input.
    #[error("{} is an input of this command and would be overwritten{}", output.display(), also(output, input))]
    Input {
        /// The output, as it was named.
        output: PathBuf,
        /// The input, as it was named.
        input: PathBuf,
    },
    /// Two outputs in one place.
    #[error("two outputs go to {}{}: only one would remain", first.display(), also(first, second))]
    Outputs {
        /// The first, as it was named.
        first: PathBuf,
        /// The second, as it was named.
        second: PathBuf,
    },
}

impl Overlap {
    /// What to do about it.
    pub fn next_step(&self) -> &'static str {
        match self {
            Self::Input { .. } => "Name another file for the output.",
            Self::Outputs { .. } => "Name a separate file for each output.",
        }
    }
}

fn also(one: &Path, other: &Path) -> String {
    if one == other { String::new() } else { format!(" (as {})", other.display()) }
}

/// Refuses outputs that are inputs, and outputs in one place: by device and inode, through links and relative paths.
///
/// # Errors
/// [`Overlap`], the first there is.
///
/// # Example
/// ```
/// # use std::path::Path;
/// # use hexbench_core::files::refuse_overlap;
/// assert!(refuse_overlap(&[], &[Path::new("a.json"), Path::new("a.html")]).is_ok());
/// assert!(refuse_overlap(&[], &[Path::new("a.json"), Path::new("./a.json")]).is_err());
/// ```
pub fn refuse_overlap(inputs: &[&Path], outputs: &[&Path]) -> Result<(), Overlap> {
    let places: Vec<_> = outputs.iter().map(|path| Place::of(path)).collect();
    for (output, place) in outputs.iter().zip(&places).filter(|(_, place)| !place.is_sink()) {
        if let Some(input) = inputs.iter().find(|input| Place::of_input(input) == *place) {
            return Err(Overlap::Input { output: output.to_path_buf(), input: input.to_path_buf() });
        }
    }
    for (k, place) in places.iter().enumerate().filter(|(_, place)| !place.is_sink()) {
        if let Some(later) = places[k + 1..].iter().position(|other| other == place) {
            let [first, second] = [k, k + 1 + later].map(|k| outputs[k].to_path_buf());
            return Err(Overlap::Outputs { first, second });
        }
    }
    Ok(())
}

/// What makes two names the same.
#[derive(Debug, PartialEq, Eq)]
enum Place {
    /// Device and inode.
    Node([u64; 2]),
    /// A file that is not there yet, or one of a system without inodes.
    Name(PathBuf),
    /// A device that keeps nothing, such as a terminal or `/dev/null`.
    Sink,
}

impl Place {
    /// What an output goes to.
    fn of(path: &Path) -> Self {
        match Destination::of(path) {
            Ok(Destination::StandardOutput) => fs::metadata("/dev/stdout")
                .map_or(Self::Name("-".into()), |found| Self::of_node("-".into(), &found)),
            Ok(Destination::Stream(place) | Destination::File(place)) => Self::of_input(&place),
            Err(_) => Self::of_input(path),
        }
    }

    fn of_input(path: &Path) -> Self {
        let name =
            || path.canonicalize().or_else(|_| std::path::absolute(path)).unwrap_or_else(|_| path.to_owned());
        match fs::metadata(path) {
            Ok(found) => Self::of_node(name(), &found),
            Err(_) => Self::Name(name()),
        }
    }

    #[cfg(unix)]
    fn of_node(_: PathBuf, found: &Metadata) -> Self {
        use std::os::unix::fs::{FileTypeExt, MetadataExt};
        if found.file_type().is_char_device() { Self::Sink } else { Self::Node([found.dev(), found.ino()]) }
    }

    #[cfg(not(unix))]
    fn of_node(name: PathBuf, _: &Metadata) -> Self {
        Self::Name(name)
    }

    fn is_sink(&self) -> bool {
        *self == Self::Sink
    }
}

/// The folder of a path; a bare name lies in the current one.
pub(super) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Follows links, also those that lead to what does not exist yet. A link to an open descriptor is not followed further: what it
/// names may have another name by now, or none.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        let Some(name) = path.file_name() else { return path.canonicalize() };
        let folder = folder_of(&path).canonicalize().map_err(|cause| of_folder(folder_of(&path), cause))?;
        if !folder.is_dir() {
            return Err(is_file(folder_of(&path)));
        }
        let place = folder.join(name);
        match fs::read_link(&place) {
            Ok(target) if !is_descriptor(&place) => path = folder.join(target),
            _ => return Ok(place),
        }
    }
    Err(io::Error::other("symbolic links form a loop"))
}

fn of_folder(folder: &Path, cause: io::Error) -> io::Error {
    match cause.kind() {
        kind @ io::ErrorKind::NotFound => {
            io::Error::new(kind, format!("there is no folder {}", folder.display()))
        }
        _ => cause,
    }
}

fn is_descriptor(place: &Path) -> bool {
    place.starts_with("/proc") || place.starts_with("/dev/fd")
}

fn is_standard_output(place: &Path) -> bool {
    let own = format!("/proc/{}/fd/1", std::process::id());
    place == Path::new("/dev/fd/1") || place == Path::new(&own)
}
