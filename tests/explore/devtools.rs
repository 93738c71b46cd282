//! Chromium over its DevTools protocol: messages of JSON in frames of a WebSocket (RFC 6455).

use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

const PATIENCE: Duration = Duration::from_secs(60);
pub const PHONE: u32 = 390;
pub const DESK: u32 = 1200;
/// Least contrast of text (WCAG 2.1, success criterion 1.4.3).
pub const MIN_CONTRAST: f64 = 4.5;
/// The contrast of two colours, in JavaScript.
pub const CONTRAST_OF: &str = r"
  const channels = (colour) => colour.match(/[\d.]+/g).map(Number);
  const luminance = (colour) => channels(colour).slice(0, 3).map((c) => c / 255)
    .map((c) => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
    .reduce((sum, c, k) => sum + [0.2126, 0.7152, 0.0722][k] * c, 0);
  const contrast = (one, other) => {
    const [low, high] = [luminance(one), luminance(other)].sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
  };";
/// A key for the handshake; any 16 bytes will do.
const KEY: &str = "AAAAAAAAAAAAAAAAAAAAAA==";

pub struct Browser {
    child: Child,
    stream: TcpStream,
    /// Of the page; none before it is found.
    session: String,
    count: u64,
    events: Vec<Value>,
}

impl Browser {
    /// A browser with one empty page of this width, by day or night, and a folder of its own in which its profile lies.
    pub fn open(name: &str, width: u32, dark: bool) -> (Self, PathBuf) {
        static COUNT: AtomicUsize = AtomicUsize::new(0);
        let number = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("{name}/{}-{number}", std::process::id());
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        fs::create_dir_all(&folder).expect("a folder");
        let mut browser = Self::start(&folder);
        browser.screen(width, dark);
        (browser, folder)
    }

    /// A screen of this width, by day or night.
    pub fn screen(&mut self, width: u32, dark: bool) {
        let size = json!({ "width": width, "height": 900, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", &size);
        self.media("prefers-color-scheme", if dark { "dark" } else { "light" });
    }

    fn start(folder: &Path) -> Self {
        let program = std::env::var("CHROMIUM").unwrap_or_else(|_| "chromium".into());
        let options = "--headless=new --no-sandbox --disable-gpu --no-first-run --remote-debugging-port=0";
        let mut child = Command::new(&program)
            .args(options.split(' '))
            .arg(format!("--user-data-dir={}", folder.join("profile").display()))
            .arg("about:blank")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap_or_else(|error| panic!("{program} does not start: {error}"));
        let mut errors = BufReader::new(child.stderr.take().expect("its errors")).lines();
        let address = errors.find_map(|line| {
            let line = line.ok()?;
            line.split_once("ws://127.0.0.1:")
                .map(|(_, address)| address.to_owned())
        });
        // It waits for no reader of what it says later.
        std::thread::spawn(move || errors.for_each(drop));
        let address = address.expect("an address of the browser");
        let (port, path) = address.split_once('/').expect("a path");
        let port: u16 = port.parse().expect("a port");
        let mut stream = TcpStream::connect(("127.0.0.1", port)).expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a timeout");
        let head = format!(
            "GET /{path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
             Sec-WebSocket-Key: {KEY}\r\nSec-WebSocket-Version: 13\r\n\r\n"
        );
        stream.write_all(head.as_bytes()).expect("a handshake");
        let mut reply = Vec::new();
        while !reply.ends_with(b"\r\n\r\n") {
            reply.extend_from_slice(&bytes(&mut stream, 1));
        }
        let session = String::new();
        let mut browser = Self {
            child,
            stream,
            session,
            count: 0,
            events: Vec::new(),
        };
        let targets = browser.call("Target.getTargets", &json!({}));
        let mut targets = targets["targetInfos"].as_array().expect("a list").iter();
        let page = targets.find(|target| target["type"] == "page").expect("a page");
        let page = json!({ "targetId": page["targetId"], "flatten": true });
        let attached = browser.call("Target.attachToTarget", &page);
        attached["sessionId"]
            .as_str()
            .expect("a session")
            .clone_into(&mut browser.session);
        for domain in ["Page", "Runtime", "Log"] {
            browser.call(&format!("{domain}.enable"), &json!({}));
        }
        browser
    }

    /// Calls a method of the protocol; its result.
    pub fn call(&mut self, method: &str, parameters: &Value) -> Value {
        self.count += 1;
        let mut message = json!({ "id": self.count, "method": method, "params": parameters });
        // Downloads are the browser's.
        if !self.session.is_empty() && !method.starts_with("Browser.") {
            message["sessionId"] = self.session.as_str().into();
        }
        let message = message.to_string();
        let length = message.len();
        // One frame of text, masked with zeros.
        let mut frame = vec![0x81, 0x80 | 127];
        frame.extend_from_slice(&(length as u64).to_be_bytes());
        frame.extend_from_slice(&[0; 4]);
        frame.extend_from_slice(message.as_bytes());
        self.stream.write_all(&frame).expect("a message");
        loop {
            let message = self.message();
            if message["id"] == self.count {
                assert!(message["error"].is_null(), "{method}: {message}");
                return message["result"].clone();
            }
            self.events.push(message);
        }
    }

    fn message(&mut self) -> Value {
        let mut text = Vec::new();
        loop {
            let head = bytes(&mut self.stream, 2);
            let short = head[1] & 127;
            let long = bytes(&mut self.stream, [0, 2, 8][short.saturating_sub(125) as usize]);
            let length = long
                .iter()
                .fold(0, |length, byte| length << 8 | usize::from(*byte));
            let length = if long.is_empty() {
                usize::from(short)
            } else {
                length
            };
            text.extend_from_slice(&bytes(&mut self.stream, length));
            if head[0] & 0x80 != 0 {
                return serde_json::from_slice(&text).expect("JSON");
            }
        }
    }

    /// The value of an expression of JavaScript in the page.
    pub fn value(&mut self, expression: &str) -> Value {
        let parameters = json!({ "expression": expression, "returnByValue": true, "awaitPromise": true });
        let found = self.call("Runtime.evaluate", &parameters);
        assert!(found["exceptionDetails"].is_null(), "{expression}: {found}");
        found["result"]["value"].clone()
    }

    /// Presses a key and lets it go.
    pub fn key(&mut self, key: &str) {
        let (code, text) = match key {
            "ArrowLeft" => (37, ""),
            "ArrowRight" => (39, ""),
            "Enter" => (13, "\r"),
            _ => panic!("a key without a code: {key}"),
        };
        for kind in ["keyDown", "keyUp"] {
            let text = if kind == "keyDown" { text } else { "" };
            let event =
                json!({ "type": kind, "key": key, "code": key, "windowsVirtualKeyCode": code, "text": text });
            self.call("Input.dispatchKeyEvent", &event);
        }
    }

    /// Goes to an address, and waits until this holds there.
    pub fn go(&mut self, address: &str, is_there: &str) {
        self.call("Page.navigate", &json!({ "url": address }));
        self.wait(is_there);
    }

    pub fn wait(&mut self, expression: &str) {
        let begun = Instant::now();
        while self.value(&format!("Boolean({expression})")) != json!(true) {
            let is_late = begun.elapsed() > PATIENCE;
            assert!(
                !is_late,
                "never: {expression}; {}",
                self.value("document.body.innerText")
            );
            thread::sleep(Duration::from_millis(30));
        }
    }

    /// What a reader prefers.
    pub fn media(&mut self, name: &str, value: &str) {
        let feature = json!({ "features": [{ "name": name, "value": value }] });
        self.call("Emulation.setEmulatedMedia", &feature);
    }

    /// Errors that were thrown, and what stands on the console, since the last call.
    pub fn complaints(&mut self) -> Vec<Value> {
        let kinds = "Runtime.exceptionThrown Runtime.consoleAPICalled Log.entryAdded";
        let is_complaint = |event: &Value| kinds.split(' ').any(|kind| event["method"] == kind);
        // That a question is refused is what a page is told.
        let is_refusal = |event: &Value| event.to_string().contains("422");
        let events = std::mem::take(&mut self.events);
        let is_wrong = |event: &Value| is_complaint(event) && !is_refusal(event);
        events.into_iter().filter(is_wrong).collect()
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn bytes(stream: &mut TcpStream, count: usize) -> Vec<u8> {
    let mut bytes = vec![0; count];
    stream.read_exact(&mut bytes).expect("an answer of the browser");
    bytes
}
