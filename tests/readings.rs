//! Readings from CSV: what is taken as it is meant, and what is refused, with its line.

use creepage::{DataError, ReadOptions, Readings};

fn read(text: &str) -> Result<Readings, DataError> {
    Readings::from_csv("cell.csv", text.as_bytes())
}

#[test]
fn comments_blanks_repeats_and_order() {
    let text = "# load cell 3\n\npass, force_n , sigma_n\n5, 223.3, 2\n1,113.4,1.5\n# a break\n1, 112.0, 1.5\n,,\n7,,\n2.0,152.5,1e0\n";
    let data = read(text).unwrap();
    let rows = data.list.iter().map(|r| (r.pass, r.value, r.sigma, r.line));
    assert!(rows.eq([
        (5, 223.3, Some(2.0), 4),
        (1, 113.4, Some(1.5), 5),
        (1, 112.0, Some(1.5), 7),
        (2, 152.5, Some(1.0), 10)
    ]));
    assert_eq!(data.last_pass(), 5);
    assert_eq!(data.notes, ["1 rows without a force were left out: line 9"]);
}

#[test]
fn a_column_of_sigmas_may_be_of_the_third_column_or_empty() {
    let sigmas = |text: &str| {
        read(text)
            .unwrap()
            .list
            .iter()
            .map(|reading| reading.sigma)
            .collect::<Vec<_>>()
    };
    assert_eq!(sigmas("1,113.4,2\n"), [Some(2.0)]);
    assert_eq!(sigmas("pass,force_n,sigma_n\n1,113.4,\n2,150,\n"), [None; 2]);
}

#[test]
fn what_is_no_text_is_an_error_with_its_line() {
    for (end, at) in [(&b"\xff\xfe\n"[..], 2), (b"\x01\x00\n", 0)] {
        let error = Readings::from_csv("cell.csv", &[b"pass,force_n\n1,", end].concat()).unwrap_err();
        assert!(matches!(&error, DataError::Line { line, .. } if *line == at));
    }
    let missing = Readings::from_file("no/such/file.csv", &ReadOptions::default()).unwrap_err();
    assert!(matches!(missing, DataError::Unreadable { .. }));
}

#[test]
fn what_is_too_large_for_readings_is_not_read() {
    let endless = vec![b'\n'; (64 << 20) + 1];
    let told = |bytes: &[u8]| Readings::from_csv("cell.csv", bytes).unwrap_err().to_string();
    assert!(told(&endless).ends_with("a table of at most 67108864 bytes"));
    let error = told(format!("pass,force_n\n1,{}\n", "n".repeat(1_000_000)).as_bytes());
    assert!(error.len() < 300 && error.contains("… (1000000 characters)"));
}

proptest::proptest! {
    /// Whatever the bytes, the reader answers.
    #[test]
    fn any_bytes_are_answered(bytes in proptest::collection::vec(proptest::num::u8::ANY, 0..200)) {
        let _ = Readings::from_csv("any", &bytes);
    }

    /// What is written is read.
    #[test]
    fn round_trip(rows in proptest::collection::vec((1..1_000_000_u64, -1e6..1e6_f64), 1..30)) {
        let lines: Vec<String> = rows.iter().map(|(pass, force)| format!("{pass},{force}")).collect();
        let data = read(&format!("pass,force_n\n{}", lines.join("\n"))).unwrap();
        let found: Vec<(u64, f64)> = data.list.iter().map(|r| (r.pass, r.value)).collect();
        proptest::prop_assert_eq!(found, rows);
    }
}
