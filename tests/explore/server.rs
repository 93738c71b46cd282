//! A process of `creepage explore`, and requests to it.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, ExitStatus, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

pub const UPPER: &str = "examples/scenes/full-scale-upper.toml";
/// A draft of it takes a tenth of a second.
const PATIENCE: Duration = Duration::from_secs(60);

pub fn creepage(arguments: &[&str]) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("creepage"));
    command
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .stdin(Stdio::null());
    command
}

pub fn output(arguments: &[&str]) -> Output {
    creepage(arguments).output().expect("the command starts")
}

/// A process of `creepage explore`, which is ended with its test.
pub struct Explored {
    pub child: Child,
    pub port: u16,
    pub token: String,
}

impl Explored {
    pub fn new(more: &[&str]) -> Self {
        let arguments = [&["explore", UPPER, "--no-browser"], more].concat();
        let mut child = creepage(&arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("the command starts");
        let mut line = String::new();
        let out = child.stdout.take().expect("its output");
        BufReader::new(out).read_line(&mut line).expect("an address");
        let address = line
            .trim()
            .strip_prefix("http://127.0.0.1:")
            .expect("an address of this machine");
        let (port, token) = address.split_once("/?token=").expect("a token");
        assert!(
            token.len() == 32 && token.bytes().all(|byte| byte.is_ascii_hexdigit()),
            "{token}"
        );
        let (port, token) = (port.parse().expect("a port"), token.to_owned());
        Self { child, port, token }
    }

    pub fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a timeout");
        stream
    }

    /// Sends `bytes` and reads status, head and body of the reply.
    pub fn raw(&self, bytes: &[u8]) -> (u16, String, String) {
        let mut stream = self.connect();
        // A server that refuses a request may close before all of it is sent.
        let _ = stream.write_all(bytes);
        replied(stream)
    }

    pub fn request(&self, method: &str, path: &str, headers: &[String], body: &str) -> (u16, String, String) {
        let host = format!("Host: 127.0.0.1:{}", self.port);
        let headers = if headers.is_empty() { &[host][..] } else { headers };
        let (headers, length) = (headers.join("\r\n"), body.len());
        let head = format!(
            "{method} {path} HTTP/1.1\r\n{headers}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n"
        );
        self.raw(&[head.as_bytes(), body.as_bytes()].concat())
    }

    pub fn post(&self, path: &str, question: &Value) -> (u16, String) {
        let path = format!("{path}?token={}", self.token);
        let (status, _, body) = self.request("POST", &path, &[], &question.to_string());
        (status, body)
    }

    /// The answer to a question that has one.
    pub fn answer(&self, question: &Value) -> Value {
        let (status, body) = self.post("/answer", question);
        assert_eq!(status, 200, "{question}: {body}");
        serde_json::from_str(&body).expect("JSON")
    }

    /// Asserts that it still answers a small question.
    pub fn still_answers(&self, after: &str) {
        let (begun, few) = (
            Instant::now(),
            json!({ "set": { "traffic.passes": 2 }, "tolerance": 0.05 }),
        );
        let answer = self.answer(&few);
        assert_eq!(
            answer["passes"].as_array().map(Vec::len),
            Some(2),
            "after {after}"
        );
        assert!(begun.elapsed() < PATIENCE, "after {after}: {:?}", begun.elapsed());
    }

    pub fn ended(&mut self) -> ExitStatus {
        let begun = Instant::now();
        while begun.elapsed() < PATIENCE {
            if let Some(status) = self.child.try_wait().expect("its status") {
                return status;
            }
            thread::sleep(Duration::from_millis(10));
        }
        panic!("it does not end")
    }
}

impl Drop for Explored {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub fn replied(mut stream: TcpStream) -> (u16, String, String) {
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let (head, body) = text.split_once("\r\n\r\n").unwrap_or((&text, ""));
    let status = head.split(' ').nth(1).and_then(|status| status.parse().ok());
    (status.unwrap_or(0), head.to_owned(), body.to_owned())
}
