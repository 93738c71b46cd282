//! A process of `creepage explore`, and requests to it.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread;
use std::time::{Duration, Instant};

const UPPER: &str = "examples/scenes/full-scale-upper.toml";
/// A draft of it takes a tenth of a second.
pub const PATIENCE: Duration = Duration::from_secs(60);

pub fn creepage(arguments: &[&str]) -> Command {
    let mut command = Command::new(assert_cmd::cargo::cargo_bin!("creepage"));
    command
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .stdin(Stdio::null());
    command
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
        let mut command = creepage(&arguments);
        command.stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().expect("the command starts");
        let mut line = String::new();
        let out = child.stdout.take().expect("its output");
        BufReader::new(out).read_line(&mut line).expect("an address");
        let address = line.trim().strip_prefix("http://127.0.0.1:");
        let address = address.expect("an address of this machine");
        let (port, token) = address.split_once("/?token=").expect("a token");
        let is_hexadecimal = token.bytes().all(|byte| byte.is_ascii_hexdigit());
        assert!(token.len() == 32 && is_hexadecimal, "{token}");
        let (port, token) = (port.parse().expect("a port"), token.to_owned());
        Self { child, port, token }
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
