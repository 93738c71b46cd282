//! A table in any form is read to the numbers that were written, or refused, never to others.

use creepage_tables::{Layout, Name, Options, Table};
use proptest::prelude::*;

fn unit(word: &str) -> Option<&'static str> {
    ["N", "kN", "mm"]
        .into_iter()
        .find(|unit| unit.eq_ignore_ascii_case(word))
}

const fn layout(missing: fn(&[Name]) -> Option<&'static str>) -> Layout {
    Layout {
        kinds: &[],
        measured: None,
        missing,
        is_number: |_| true,
        unnamed: &[],
        unit,
        si: |_, _, _| Err(String::new()),
        most: 1 << 20,
        allowed: "a table",
    }
}

/// A number in thousandths as people write it: with this decimal sign, and one between thousands if any.
fn written(thousandths: i64, decimal: char, thousands: Option<char>, decimals: usize) -> String {
    let sign = if thousandths < 0 { "-" } else { "" };
    let (whole, rest) = (thousandths.abs() / 1000, thousandths.abs() % 1000);
    let mut digits = whole.to_string();
    if let Some(mark) = thousands {
        let mut at = digits.len();
        while at > 3 {
            at -= 3;
            digits.insert(at, mark);
        }
    }
    let rest = &format!("{rest:03}")[..decimals];
    if decimals == 0 {
        format!("{sign}{digits}")
    } else {
        format!("{sign}{digits}{decimal}{rest}")
    }
}

fn encoded(text: &str, encoding: u8) -> Vec<u8> {
    match encoding {
        0 => text.as_bytes().to_vec(),
        1 => [b"\xef\xbb\xbf", text.as_bytes()].concat(),
        2 => [0xfeff]
            .into_iter()
            .chain(text.encode_utf16())
            .flat_map(u16::to_le_bytes)
            .collect(),
        3 => text.encode_utf16().flat_map(u16::to_be_bytes).collect(),
        _ => encoding_rs::SHIFT_JIS.encode(text).0.into_owned(),
    }
}

/// Forces in the second column.
const FORCES: Layout =
    layout(|names| (names.len() < 2 || !names[1].text.starts_with("荷重")).then_some("荷重"));

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn numbers_are_those_that_were_written_or_none(
        values in proptest::collection::vec(-9_999_999_i64..9_999_999, 2..12),
        separator in prop::sample::select(vec![",", ";", "\t", "|"]),
        is_comma in any::<bool>(),
        has_thousands in any::<bool>(),
        decimals in 0..=3_usize,
        quoted in any::<bool>(),
        preamble in any::<bool>(),
        unit_at in 0..3_u8,
        encoding in 0..5_u8,
    ) {
        let (decimal, group) = if is_comma { (',', '.') } else { ('.', ',') };
        // Who separates by commas has no points between thousands.
        let has_thousands = has_thousands && !(is_comma && separator == ",");
        let cells: Vec<String> =
            values.iter().map(|&value| written(value, decimal, has_thousands.then_some(group), decimals)).collect();
        let is_cut = |cell: &String| cell.contains(separator);
        let quote = quoted || cells.iter().any(is_cut);
        let head = ["荷重", "荷重 [kN]", "荷重"][unit_at as usize];
        let units = if unit_at == 2 { format!("-{separator}kN\n") } else { String::new() };
        let rows: Vec<String> = cells.iter().zip(1..).map(|(cell, pass)| {
            if quote { format!("{pass}{separator}\"{cell}\"\n") } else { format!("{pass}{separator}{cell}\n") }
        }).collect();
        let above = if preamble { "Logger 7\n" } else { "" };
        let text = format!("{above}回数{separator}{head}\n{units}{}", rows.concat());
        let table = Table::read("t", &encoded(&text, encoding), &Options::default(), &FORCES);
        // What is refused is never misread.
        let Ok(table) = table else { return Ok(()) };
        prop_assert_eq!(table.rows.len(), values.len(), "{}", text);
        prop_assert_eq!(table.names[1].unit.as_deref(), (unit_at > 0).then_some("kN"));
        let scale = 10_i64.pow(3 - decimals as u32);
        for (row, value) in table.rows.iter().zip(&values) {
            let right = (value / scale * scale) as f64 / 1000.0;
            if let Ok(Some((digits, unit))) = table.quantity(row, 1, 1) {
                let found: f64 = digits.parse().unwrap();
                prop_assert!((found - right).abs() < 1e-9, "{} for {} in {}", found, right, text);
                prop_assert_eq!(unit, if unit_at > 0 { "kN" } else { "" });
            }
        }
    }
}

/// Nearly every such form is read: what is refused can be read in two ways.
#[test]
fn forms_that_can_be_read_in_one_way_are_read() {
    for (text, right) in [
        ("n;v\n1;94,125\n2;1.234,5\n", 94.125),
        ("n;v\n1;94.125\n2;94.5\n", 94.125),
        ("n,v\n1,94.125\n2,95.250\n", 94.125),
        ("n\tv\n1\t0,125\n2\t94,250\n", 0.125),
        ("n;v\n1;1.234.567\n2;1.234\n", 1_234_567.0),
    ] {
        const LAYOUT: Layout = layout(|_| None);
        let table = Table::read("t", text.as_bytes(), &Options::default(), &LAYOUT).expect(text);
        let (digits, unit) = table.quantity(&table.rows[0], 1, 1).expect(text).expect(text);
        assert_eq!((digits.parse(), unit), (Ok(right), ""), "{text}");
    }
}
