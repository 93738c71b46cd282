//! Time from the change of a slider to the answer that its new curve is drawn from: drafts of `creepage explore` with one thread. The browser
//! adds some 10 ms for drawing.

use std::cell::Cell;
use std::io::{Read, Write};
use std::net::TcpStream;

use criterion::{Criterion, criterion_group, criterion_main};

#[path = "../tests/explore/server.rs"]
#[allow(dead_code, reason = "the tests need more of it")]
mod server;

use server::Explored;

/// Two lanes over a layered road, 20 years of 800 vehicles a day.
const LANES: [&str; 8] = [
    "duct.length=300 m",
    r#"ground.layers=[{ thickness = "50 mm", young_modulus = "4000 MPa", poisson_ratio = 0.35 }, { young_modulus = "800 MPa", poisson_ratio = 0.4 }]"#,
    r#"vehicles=[{ name = "truck", load = "20 tf", speed = "40 km/h" }, { name = "oncoming", load = "20 tf", speed = "40 km/h", direction = "reverse", lateral_offset = "3.5 m" }]"#,
    "traffic.per_day=800",
    "traffic.years=20",
    "friction.dynamic_coefficient=0.25",
    "ends.upstream=free",
    "ends.downstream=fixed",
];

/// The bytes of an answer.
fn post(explored: &Explored, question: &str) -> usize {
    let mut stream = TcpStream::connect(("127.0.0.1", explored.port)).expect("a connection");
    let (port, token, length) = (explored.port, &explored.token, question.len());
    let head = format!("POST /answer?token={token} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nConnection: close");
    let request = format!("{head}\r\nContent-Length: {length}\r\n\r\n{question}");
    stream.write_all(request.as_bytes()).expect("a question");
    let mut answer = Vec::new();
    stream.read_to_end(&mut answer).expect("an answer");
    assert!(
        answer.starts_with(b"HTTP/1.1 200"),
        "{}",
        String::from_utf8_lossy(&answer)
    );
    answer.len()
}

fn explore(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("explore");
    group.sample_size(20);
    let set: Vec<String> = LANES.iter().map(|set| format!("--set={set}")).collect();
    let lanes: Vec<&str> = set.iter().map(String::as_str).collect();
    for (name, more) in [("30 m, one lane", &[][..]), ("300 m, two lanes", &lanes[..])] {
        let explored = Explored::new(&[more, &["--threads", "1"]].concat());
        // Another friction every time, as a hand moves it.
        let turned = Cell::new(0_u32);
        group.bench_function(name, |bencher| {
            bencher.iter(|| {
                turned.set((turned.get() + 7) % 100);
                let friction = 0.2 + 0.001 * f64::from(turned.get());
                let set = format!("{{\"friction.dynamic_coefficient\": {friction}}}");
                post(&explored, &format!("{{\"set\": {set}, \"tolerance\": 0.05}}"))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, explore);
criterion_main!(benches);
