//! Readings from CSV: what is taken as it is meant, and what is refused, with its line.

use creepage::{DataError, Readings};

fn read(text: &str) -> Result<Readings, DataError> {
    Readings::from_csv("cell.csv", text.as_bytes())
}

#[test]
fn comments_blanks_repeats_and_order() {
    let text = "# load cell 3\n\npass, force_n , sigma_n\n5, 223.3, 2\n1,113.4,1.5\n# a break\n1, 112.0, 1.5\n,,\n7,,\n2.0,152.5,1e0\n";
    let data = read(text).unwrap();
    let rows: Vec<(u64, f64, Option<f64>, u64)> = data
        .readings()
        .iter()
        .map(|r| (r.pass, r.value, r.sigma, r.line))
        .collect();
    assert_eq!(
        rows,
        [
            (5, 223.3, Some(2.0), 4),
            (1, 113.4, Some(1.5), 5),
            (1, 112.0, Some(1.5), 7),
            (2, 152.5, Some(1.0), 10)
        ]
    );
    assert_eq!((data.skipped(), data.last_pass()), (1, 5));
    assert_eq!(data.sigmas().unwrap(), [2.0, 1.5, 1.5, 1.0]);
}

#[test]
fn columns_go_by_the_header_or_by_their_order() {
    let by_name = read("operator,FORCE_N,pass\nA,113.4,1\nB,152.5,2\n").unwrap();
    let by_order = read("1,113.4\n2,152.5\n").unwrap();
    let marked = read("\u{feff}pass,force_n\r\n1,113.4\r\n2,152.5\r\n").unwrap();
    for data in [&by_name, &by_order, &marked] {
        assert_eq!(data.values(), [113.4, 152.5]);
        assert_eq!(data.sigmas(), None);
        assert_eq!(data.last_pass(), 2);
    }
    assert_eq!(read("1,113.4,2\n").unwrap().sigmas().unwrap(), [2.0]);
    // A column of sigmas that nobody filled in.
    assert_eq!(
        read("pass,force_n,sigma_n\n1,113.4,\n2,150,\n").unwrap().sigmas(),
        None
    );
}

#[test]
fn errors_name_the_line() {
    let cases = [
        (
            "pass,force_n\n1,113\n2,many\n",
            "cell.csv:3: force_n: found \"many\"",
        ),
        (
            "pass,force_n\n1,113\n\n-2,150\n",
            "cell.csv:4: pass: found \"-2\"",
        ),
        ("pass,force_n\n0,113\n", "cell.csv:2: pass: found \"0\""),
        ("pass,force_n\n1.5,113\n", "cell.csv:2: pass: found \"1.5\""),
        ("pass,force_n\n,113\n", "cell.csv:2: pass: found \"\""),
        ("pass,force_n\n1,NaN\n", "cell.csv:2: force_n: found \"NaN\""),
        ("pass,force_n\n1,inf\n", "cell.csv:2: force_n: found \"inf\""),
        ("pass,force_n\n1e300,5\n", "cell.csv:2: pass: found \"1e300\""),
        (
            "pass,force_n,sigma_n\n1,5,0\n",
            "cell.csv:2: sigma_n: found \"0\"",
        ),
        (
            "pass,force_n,sigma_n\n1,5,-1\n",
            "cell.csv:2: sigma_n: found \"-1\"",
        ),
        (
            "pass,force_n,sigma_n\n1,5,1\n2,6,\n",
            "cell.csv:3: sigma_n is blank",
        ),
        ("number,force\n1,5\n", "cell.csv:1: no column pass"),
        ("# none\npass,newtons\n1,5\n", "cell.csv:2: no column force_n"),
        ("pass,force_n,pass\n1,5,1\n", "cell.csv:1: a second column pass"),
        ("", "cell.csv: no rows"),
        ("# only this\n\n", "cell.csv: no rows"),
        ("pass,force_n\n", "cell.csv: no rows"),
    ];
    for (text, start) in cases {
        let error = read(text).expect_err(text).to_string();
        assert!(error.starts_with(start), "{text:?}: {error}");
    }
    let error = read("pass,force_n\n1,5\n")
        .unwrap()
        .check_count(2, 3)
        .unwrap_err();
    assert!(
        error
            .to_string()
            .starts_with("cell.csv:2: 1 readings; allowed: at least 3"),
        "{error}"
    );
}

#[test]
fn what_is_no_text_is_an_error() {
    let error = Readings::from_csv("cell.csv", b"pass,force_n\n1,\xff\xfe\n").unwrap_err();
    assert!(matches!(&error, DataError::Line { line: 2, .. }), "{error}");
    let error = Readings::from_csv("cell.csv", b"pass,force_n\n1,\x01\x00\n").unwrap_err();
    assert!(matches!(&error, DataError::NoText { .. }), "{error}");
    let missing = Readings::from_file(std::path::Path::new("no/such/file.csv")).unwrap_err();
    assert!(matches!(missing, DataError::Unreadable { .. }));
}

#[test]
fn what_is_too_large_for_readings_is_not_read() {
    let endless = vec![b'\n'; (64 << 20) + 1];
    let error = Readings::from_csv("endless", &endless).unwrap_err();
    assert!(
        matches!(error, DataError::TooLarge { allowed, .. } if allowed == 64 << 20),
        "{error}"
    );
    let error = Readings::from_csv("empty", &endless[1..]).unwrap_err();
    assert!(matches!(error, DataError::Empty { .. }), "{error}");
    let cell = "n".repeat(1_000_000);
    let error = read(&format!("pass,force_n\n1,{cell}\n"))
        .unwrap_err()
        .to_string();
    assert!(
        error.len() < 300 && error.contains("… (1000000 characters)"),
        "{error:.300}"
    );
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
        let found: Vec<(u64, f64)> = data.readings().iter().map(|r| (r.pass, r.value)).collect();
        proptest::prop_assert_eq!(found, rows);
    }
}
