//! `creepage explore`: its answers are those of `run`, and no request that is not the page's stops it from answering.

#![cfg(all(feature = "explore", unix))]

mod server;

use std::fs;
use std::io::{Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::process::Command;
use std::thread;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use crate::command::{UPPER, answer, folder, list, number, numbers, read};
use crate::scenes::assert_near;
use server::{Explored, PATIENCE, creepage};

impl Explored {
    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(("127.0.0.1", self.port)).expect("a connection");
        stream.set_read_timeout(Some(PATIENCE)).expect("a timeout");
        stream
    }

    /// Sends `bytes` and reads status, head and body of the reply.
    fn raw(&self, bytes: &[u8]) -> (u16, String, String) {
        let mut stream = self.connect();
        // A server that refuses a request may close before all of it is sent.
        let _ = stream.write_all(bytes);
        replied(stream)
    }

    fn request(&self, method: &str, path: &str, headers: &[String], body: &str) -> (u16, String, String) {
        let host = format!("Host: 127.0.0.1:{}", self.port);
        let headers = if headers.is_empty() { &[host][..] } else { headers };
        let (headers, length) = (headers.join("\r\n"), body.len());
        let head = format!(
            "{method} {path} HTTP/1.1\r\n{headers}\r\nConnection: close\r\nContent-Length: {length}\r\n\r\n"
        );
        self.raw(&[head.as_bytes(), body.as_bytes()].concat())
    }

    fn post(&self, path: &str, question: &Value) -> (u16, String) {
        let path = format!("{path}?token={}", self.token);
        let (status, _, body) = self.request("POST", &path, &[], &question.to_string());
        (status, body)
    }

    /// The answer to a question that has one.
    fn answer(&self, question: &Value) -> Value {
        let (status, body) = self.post("/answer", question);
        assert_eq!(status, 200, "{question}: {body}");
        serde_json::from_str(&body).expect("JSON")
    }

    /// Asserts that it still answers a small question.
    fn still_answers(&self, after: &str) {
        let begun = Instant::now();
        let passes = self.answer(&few())["passes"].as_array().map(Vec::len);
        assert_eq!(passes, Some(2), "after {after}");
        assert!(begun.elapsed() < PATIENCE, "after {after}");
    }
}

/// Asks for two passes.
fn few() -> Value {
    json!({ "set": { "traffic.passes": 2 }, "tolerance": 0.05 })
}

fn replied(mut stream: TcpStream) -> (u16, String, String) {
    let mut bytes = Vec::new();
    let _ = stream.read_to_end(&mut bytes);
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let (head, body) = text.split_once("\r\n\r\n").unwrap_or((&text, ""));
    let status = head.split(' ').nth(1).and_then(|status| status.parse().ok());
    (status.unwrap_or(0), head.to_owned(), body.to_owned())
}

#[test]
fn an_answer_is_that_of_run_with_words() {
    let explored = Explored::new(&["--set", "traffic.passes=20"]);
    let set = json!({ "friction.dynamic_coefficient": 0.3, "ends.upstream.spring": "2 MN/m", "duct.depth": "1.5 m" });
    let limits = json!({ "force": ["downstream=100 N"], "movement": ["5 mm"] });
    let answer = explored.answer(&json!({ "set": set, "tolerance": 0.05, "limits": limits }));
    let run = crate::command::json(
        "run UPPER --set traffic.passes=20 --set friction.dynamic_coefficient=0.3 --set 'ends.upstream.spring=2 MN/m' \
         --set 'duct.depth=1.5 m' --set solver.tolerance=0.05 --limit-force 'downstream=100 N' --limit-movement '5 mm'",
    );
    for (field, value) in run.as_object().expect("an object") {
        assert_eq!(answer[field], *value, "{field}");
    }
    let verdicts = answer["headline"]["verdicts"].as_array().expect("verdicts");
    let kept: Vec<_> = verdicts.iter().map(|verdict| verdict[1].as_bool()).collect();
    assert_eq!(kept, [Some(true), Some(false), Some(true)], "{verdicts:?}");
    let sentences = answer["headline"]["sentences"].as_str().expect("sentences");
    assert!(sentences.contains("downstream end"), "{sentences}");
}

#[test]
fn what_is_refused_has_the_words_of_the_command_line_and_its_key() {
    let explored = Explored::new(&[]);
    for (key, value) in [
        ("duct.depth", "1 mm"),
        ("duct.depth", "NaN m"),
        ("friction.dynamic_coefficient", "inf"),
        ("duct.depht", "1 m"),
        ("restraints", "[{ position = \"40 m\", stiffness = \"1 MN/m\" }]"),
        ("ground.model", "burmester"),
        ("solver.method", "dynamic"),
        ("duct.length", "1 m\nduct.depth"),
        ("heat", "{ expansion = \"17e-6 1/K\", daily_swing = \"20 K\" }"),
    ] {
        let (status, body) = explored.post("/answer", &json!({ "set": { key: value } }));
        let refusal: Value = serde_json::from_str(&body).expect("JSON");
        let run = creepage(&["run", UPPER, &format!("--set={key}={value}")]).output();
        let run = answer(run.expect("the command starts"));
        assert_eq!((status, run.0), (422, 2), "{key}={value}: {body}");
        let message = refusal["message"].as_str().expect("a message");
        let message = message.replace(['\u{1b}', '\r'], "\u{fffd}");
        assert!(run.2.trim_end().ends_with(message.trim_end()), "{message}");
        let found = refusal["key"].as_str().expect("a key");
        assert!(found.starts_with(key) || key == "heat", "{key}: {found}");
    }
    // A file of the user's is not for the page to choose.
    let password = json!({ "set": { "traffic.histogram": "/etc/passwd" } });
    let (status, body) = explored.post("/answer", &password);
    assert!(status == 422 && !body.contains("root:"), "{body}");
    explored.still_answers("refusals");
}

#[test]
fn only_this_page_with_its_token_is_answered() {
    let explored = Explored::new(&[]);
    let (port, token) = (explored.port, &explored.token);
    let own = format!("Host: 127.0.0.1:{port}");
    let path = format!("/answer?token={token}");
    let asks = |path: &str, headers: &[&str]| {
        let headers: Vec<String> = headers.iter().map(|header| (*header).to_owned()).collect();
        explored.request("POST", path, &headers, &few().to_string()).0
    };
    let origin = |of: &str| asks(&path, &[&own, &format!("Origin: {of}")]);
    assert_eq!(asks(&path, &[&own]), 200);
    assert_eq!(asks(&path, &[&format!("Host: localhost:{port}")]), 200);
    assert_eq!(origin(&format!("http://127.0.0.1:{port}")), 200);
    let longer = format!("127.0.0.1.example.org:{port}");
    for host in ["example.org", &longer, "127.0.0.1:1", ""] {
        assert_eq!(asks(&path, &[&format!("Host: {host}")]), 403, "{host}");
    }
    for headers in [&["X-Host: none"][..], &[&own, &own]] {
        assert_eq!(asks(&path, headers), 403);
    }
    let secure = format!("https://127.0.0.1:{port}");
    for of in ["https://example.org", "null", "http://127.0.0.1", &secure] {
        assert_eq!(origin(of), 403, "{of}");
    }
    let wrong = "?token=0123456789abcdef0123456789abcdef".to_owned();
    let [longer, twice] = [
        format!("?token={token}0"),
        format!("?token={token}&token={token}"),
    ];
    for query in [String::new(), "?token=".to_owned(), wrong, longer, twice] {
        assert_eq!(asks(&format!("/answer{query}"), &[&own]), 403, "{query}");
        let page = explored.request("GET", &format!("/{query}"), &[], "");
        assert_eq!(page.0, 403, "{query}");
    }
    explored.still_answers("others");
}

#[test]
fn hostile_requests_are_refused_and_leave_it_answering() {
    let explored = Explored::new(&[]);
    let (port, token) = (explored.port, &explored.token);
    let path = format!("/answer?token={token}");
    let files = "/../../etc/passwd /%2e%2e/%2e%2e/etc/passwd //etc/passwd /answer".split(' ');
    let others = [("POST", "/"), ("DELETE", "/")].into_iter();
    for (method, path) in files.map(|path| ("GET", path)).chain(others) {
        let (status, head, body) = explored.request(method, &format!("{path}?token={token}"), &[], "");
        assert!(
            status == 404 && !body.contains("root:"),
            "{method} {path}: {status} {body}"
        );
        assert!(head.to_lowercase().contains("x-frame-options: deny"), "{head}");
    }
    let nested = "[".repeat(100_000);
    for body in [
        "",
        "{",
        r#"{"set": {"duct.depth": NaN}}"#,
        r#"{"tolerance": 1e999}"#,
        r#"{"files": []}"#,
        "\u{0}",
        &nested,
    ] {
        assert_eq!(explored.request("POST", &path, &[], body).0, 400, "{body:.80}");
    }
    for body in [
        r#"{"set": {"duct": [1, {"a": 2}]}}"#,
        r#"{"set": {"": 1}}"#,
        r#"{"tolerance": -1}"#,
        r#"{"limits": {"force": ["2 m"]}}"#,
        r#"{"limits": {"force": ["20 m=2 kN"]}}"#,
    ] {
        assert_eq!(explored.request("POST", &path, &[], body).0, 422, "{body}");
    }
    // No HTTP, headers without end, a body of 10 MB with and without its length.
    let headers = format!("GET / HTTP/1.1\r\n{}", "X: y\r\n".repeat(10_000));
    for bytes in [
        &b"\x16\x03\x01 hello\r\n\r\n"[..],
        b"GET\r\n\r\n",
        b"\r\n\r\n",
        b"POST / HTTP/9.9\r\n\r\n",
        headers.as_bytes(),
    ] {
        let mut stream = explored.connect();
        stream.write_all(bytes).expect("something to refuse");
        let _ = stream.shutdown(Shutdown::Write);
        assert_ne!(replied(stream).0, 200);
    }
    let large = " ".repeat(10 << 20);
    assert_eq!(explored.request("POST", &path, &[], &large).0, 413);
    let head = format!("POST {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close");
    let length = large.len();
    let chunked = format!("{head}\r\nTransfer-Encoding: chunked\r\n\r\n{length:x}\r\n{large}\r\n0\r\n\r\n");
    assert_eq!(explored.raw(chunked.as_bytes()).0, 413);
    explored.still_answers("hostile requests");
}

#[test]
fn two_hundred_slow_ones_and_two_hundred_at_once_leave_it_answering() {
    let explored = Explored::new(&[]);
    // Bodies that never come, with and without the token, and heads that never end.
    let path = format!("/answer?token={}", explored.token);
    let heads = ["/answer", &path].map(|path| {
        let host = format!("Host: 127.0.0.1:{}", explored.port);
        format!("POST {path} HTTP/1.1\r\n{host}\r\nContent-Length: 900000\r\n\r\n{{")
    });
    let slow: Vec<TcpStream> = (0..200)
        .map(|k| {
            let mut stream = explored.connect();
            let head = &heads[k % 2];
            let sent = if k % 3 == 0 { &head[..20] } else { head };
            stream.write_all(sent.as_bytes()).expect("a beginning");
            stream
        })
        .collect();
    explored.still_answers("slow bodies");
    thread::scope(|scope| {
        for _ in 0..200 {
            scope.spawn(|| {
                let (status, _) = explored.post("/answer", &few());
                // The newest stops the others.
                assert!([200, 409].contains(&status), "{status}");
            });
        }
    });
    explored.still_answers("two hundred at once");
    drop(slow);
    explored.still_answers("slow ones that leave");
}

#[test]
fn a_newer_question_stops_the_one_under_way() {
    let explored = Explored::new(&[]);
    let long = json!({ "set": { "traffic.passes": 1_000_000, "solver.method": "quasi-static" } });
    thread::scope(|scope| {
        let older = scope.spawn(|| explored.post("/answer", &long).0);
        thread::sleep(Duration::from_millis(300));
        assert!(!older.is_finished());
        explored.still_answers("a newer question");
        assert_eq!(older.join().expect("a status"), 409);
    });
}

#[test]
fn a_saved_scene_is_the_one_that_was_asked_about() {
    let explored = Explored::new(&["--set", "traffic.passes=30"]);
    let overrides = [
        "traffic.passes=30",
        "duct.depth=0.9 m",
        "ends.downstream.spring=3 MN/m",
        "restraints=[{ position = \"12 m\", stiffness = \"1 MN/m\", holds = \"2 kN\" }]",
    ];
    let expected = crate::scenes::upper(&overrides);
    let keys = overrides[1..].iter().filter_map(|set| set.split_once('='));
    let asked: serde_json::Map<_, _> = keys.map(|(key, value)| (key.to_owned(), value.into())).collect();
    let (status, text) = explored.post("/scene", &json!({ "set": asked }));
    assert_eq!(status, 200, "{text}");
    assert_eq!(crate::scenes::scene_of(&text, &[]), expected);
    // What stands in the comments at its head cannot end them.
    let (_, text) = explored.post("/scene", &json!({ "set": { "title": "\"a\\nduct = 1\"" } }));
    let comments = text.lines().take_while(|line| line.starts_with('#'));
    assert!(comments.count() >= 3, "{text}");
    crate::scenes::scene_of(&text, &[]);
}

/// The first pass against an independent computation (102.08 N on the fixed end), friction within its limits, and the duct slipping
/// forward over a longer stretch than backward while the vehicle is above it (Kashiro et al., section 2.3).
#[test]
fn the_pass_that_is_shown_is_the_one_that_is_computed() {
    let explored = Explored::new(&[]);
    let pass = |first: bool| -> Value {
        let (status, body) = explored.post("/pass", &json!({ "tolerance": 0.05, "first": first }));
        assert_eq!(status, 200, "{body}");
        serde_json::from_str(&body).expect("JSON")
    };
    let first = pass(true);
    let force = 0.1 * numbers(&first["after_decinewtons"]).last().expect("a force");
    assert_near(force, 102.08, 0.02, ());
    let before = numbers(&first["before_decinewtons"]);
    assert!(before.iter().all(|force| *force == 0.0));
    let later = pass(false);
    assert!(first["pass"] == 1 && later["pass"] == 201);
    // Levelled off: the pass leaves what it found.
    let [before, after] =
        ["before_decinewtons", "after_decinewtons"].map(|when| numbers(&later[when]).pop().expect("a force"));
    assert_near(after, before, 0.01, ());
    for film in [&first, &later] {
        let pictures = film["pictures"].as_array().expect("pictures");
        assert!(pictures.len() > 100);
        let shares = |picture: &Value| numbers(&picture["friction_percent"]);
        let mut shares = pictures.iter().flat_map(shares);
        assert!(shares.all(|share| share.abs() <= 100.0));
        let places = pictures.iter().map(|picture| number(&picture["vehicle_m"]));
        assert!(places.is_sorted_by(|a, b| a < b));
    }
    let middle = |picture: &&Value| (number(&picture["vehicle_m"]) - 15.0).abs() < 0.2;
    let picture = list(&later["pictures"]).iter().find(middle).expect("a picture");
    let shares = numbers(&picture["friction_percent"]);
    let slips = |at: f64| shares.iter().filter(|share| **share == at).count();
    let (forward, backward) = (slips(100.0), slips(-100.0));
    assert!(forward > 2 * backward && backward > 5, "{forward} {backward}");
}

#[test]
fn it_ends_by_its_button_or_by_ctrl_c_and_leaves_no_file() {
    let mut explored = Explored::new(&[]);
    explored.still_answers("its beginning");
    assert_eq!(explored.post("/end", &json!({})).0, 205);
    assert_eq!(explored.ended().code(), Some(0));

    let mut explored = Explored::new(&[]);
    let id = explored.child.id().to_string();
    let sent = Command::new("kill").args(["-INT", &id]).status();
    assert!(sent.expect("kill").success());
    assert_eq!(explored.ended().code(), Some(130));

    // A port that is taken.
    let folder = folder("explore");
    fs::write(folder.join("scene.toml"), read(UPPER)).expect("a scene");
    let taken = TcpListener::bind("127.0.0.1:0").expect("a port");
    let port = format!("--port={}", taken.local_addr().expect("its address").port());
    let mut refused = creepage(&["explore", "scene.toml", "--no-browser", &port]);
    let (status, _, words) = answer(refused.current_dir(&folder).output().expect("an answer"));
    assert!(status == 2 && words.contains("--port: found"), "{words}");
    let left: Vec<_> = fs::read_dir(&folder).expect("the folder").collect();
    assert_eq!(left.len(), 1, "{left:?}");
}
