//! The workbench as it is started: what is printed, what it answers, how it ends.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::process::{Child, Command, Stdio};

use hexbench_model::terms;

use crate::support::{hexbench, hexbench_in, root};

/// A workbench; ended with the test.
pub(crate) struct Workbench {
    child: Child,
    pub(crate) address: String,
    pub(crate) token: String,
}

impl Drop for Workbench {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Started in an empty folder, with files of a case.
pub(crate) fn start(folder: &std::path::Path) -> Workbench {
    let case = root().join("data/cases/mujoco-foundation");
    let files = ["hexapod.toml", "measurements.csv"].map(|name| case.join(name));
    let child = Command::new(env!("CARGO_BIN_EXE_hexbench"))
        .current_dir(folder)
        .arg("workbench")
        .args(files)
        .arg("--holdout")
        .arg(case.join("holdout.csv"))
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    Workbench::of(child)
}

impl Workbench {
    /// Where it listens, as it says on the standard output that is read here.
    pub(crate) fn of(mut child: Child) -> Self {
        let lines = BufReader::new(child.stdout.as_mut().unwrap()).lines().map(Result::unwrap);
        let url = lines.map(|line| line.trim().to_owned()).find(|line| line.starts_with("http://")).unwrap();
        let (address, token) = url.strip_prefix("http://").unwrap().split_once("/#token=").unwrap();
        Self { address: address.to_owned(), token: token.to_owned(), child }
    }

    /// Status and body.
    pub(crate) fn ask(&self, line: &str, body: &str) -> (u16, serde_json::Value) {
        let mut stream = TcpStream::connect(&self.address).unwrap();
        let head = [
            format!("{line} HTTP/1.1"),
            format!("Host: {}", self.address),
            format!("Authorization: Bearer {}", self.token),
            format!("Content-Length: {}", body.len()),
            "Content-Type: application/json\r\nConnection: close\r\n\r\n".to_owned(),
        ];
        stream.write_all((head.join("\r\n") + body).as_bytes()).unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        let (head, body) = answer.split_once("\r\n\r\n").unwrap();
        (head[9..12].parse().unwrap(), serde_json::from_str(body).unwrap_or_default())
    }
}

#[test]
fn the_files_of_the_command_line_are_on_the_bench_and_yield_to_the_right_term() {
    let folder = tempfile::tempdir().unwrap();
    let workbench = start(folder.path());
    assert_eq!(workbench.ask("GET /", "").0, 200);
    let (status, catalogue) = workbench.ask("GET /api/catalogue", "");
    let ids: Vec<&str> =
        catalogue["terms"].as_array().unwrap().iter().map(|t| t["id"].as_str().unwrap()).collect();
    assert_eq!((status, ids), (200, terms::catalogue().iter().map(|t| t.info().id).collect()));
    let (status, opened) = workbench.ask("POST /api/benches", r#"{"from":"given"}"#);
    assert_eq!(status, 201, "{opened}");
    let path = format!("POST /api/benches/{}/view", opened["id"].as_str().unwrap());
    let (status, view) = workbench.ask(&path, r#"{"terms":["base-compliance"]}"#);
    assert_eq!(status, 200, "{view}");
    let noise = |view: &serde_json::Value| view["times_noise"].as_f64().unwrap();
    assert!(
        noise(&opened["view"]) > 1.4 && noise(&view) < 1.2,
        "{} {}",
        noise(&opened["view"]),
        noise(&view)
    );
    assert_eq!(folder.path().read_dir().unwrap().count(), 0, "nothing is written");
}

/// What the command reads, its page reads too.
#[test]
fn a_table_that_is_no_plain_text_is_on_the_bench() {
    let folder = tempfile::tempdir().unwrap();
    let case = root().join("data/cases/mujoco-foundation");
    let text = std::fs::read_to_string(case.join("measurements.csv")).unwrap();
    let utf16: Vec<u8> =
        std::iter::once(0xfeff).chain(text.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    let table = folder.path().join("measurements.csv");
    std::fs::write(&table, utf16).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_hexbench"));
    command.arg("workbench").arg(case.join("hexapod.toml")).arg(&table);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let workbench = Workbench::of(child);
    let (status, opened) = workbench.ask("POST /api/benches", r#"{"from":"given"}"#);
    assert_eq!(status, 201, "{opened}");
    let plain = start(folder.path());
    let (_, as_text) = plain.ask("POST /api/benches", r#"{"from":"given"}"#);
    let stiffnesses = |opened: &serde_json::Value| opened["view"]["parameters"].clone();
    assert!(stiffnesses(&opened).is_array(), "{opened}");
    assert_eq!(stiffnesses(&opened), stiffnesses(&as_text));
}

#[cfg(unix)]
#[test]
fn it_ends_well_when_asked_to() {
    for signal in ["-INT", "-TERM"] {
        let folder = tempfile::tempdir().unwrap();
        let mut workbench = start(folder.path());
        let open = TcpStream::connect(&workbench.address).unwrap();
        let kill = format!("kill {signal} {}", workbench.child.id());
        assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
        assert_eq!(workbench.child.wait().unwrap().code(), Some(0), "{signal}");
        let mut stderr = String::new();
        workbench.child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
        assert_eq!(stderr, "");
        drop(open);
    }
}

#[test]
fn a_port_that_is_taken_exits_with_5_and_the_next_step() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    let output = hexbench().args(["workbench", "--port", &port]).output().unwrap();
    assert_eq!(output.status.code(), Some(5));
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(stderr.contains(&format!("port {port}")) && stderr.contains("next: "), "{stderr}");
}

#[test]
fn files_that_cannot_be_used_are_told_before_anything_is_served() {
    let code = |files: &[&str]| {
        hexbench_in("mujoco-clean").arg("workbench").args(files).output().unwrap().status.code()
    };
    assert_eq!(code(&["hexapod.toml"]), Some(2));
    assert_eq!(code(&["--holdout", "holdout.csv"]), Some(2));
    assert_eq!(code(&["hexapod.toml", "hexapod.toml"]), Some(3));
    assert_eq!(code(&["hexapod.toml", "absent.csv"]), Some(5));
}
