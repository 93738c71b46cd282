//! Numbers as other programs and other countries write them.

/// A text in the spelling of a scene, where what was meant has no other reading: full-width characters become those of ASCII, a factor of a
/// power of ten becomes an exponent, and groups of three digits are joined. Whether it is a quantity then, is to be seen.
pub fn respelled(text: &str) -> String {
    let plain = with_exponent(&in_ascii(text));
    let chars: Vec<char> = plain.chars().collect();
    let digit = |at: usize| chars.get(at).is_some_and(char::is_ascii_digit);
    let parts = |at: usize| {
        let is_mark = chars[at].is_whitespace() || matches!(chars[at], '\'' | '’' | '_');
        let three = (1..=3).all(|more| digit(at + more)) && !digit(at + 4);
        is_mark && at > 0 && digit(at - 1) && three
    };
    (0..chars.len())
        .filter(|&at| !parts(at))
        .map(|at| chars[at])
        .collect()
}

/// Full-width characters as those of ASCII, and raised digits behind `^`.
fn in_ascii(text: &str) -> String {
    const RAISED: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻";
    let mut plain = String::new();
    let mut raised = false;
    for c in text.chars() {
        let was_raised = std::mem::replace(&mut raised, RAISED.contains(c));
        if raised && !was_raised {
            plain.push('^');
        }
        plain.push(match (c, RAISED.chars().position(|known| known == c)) {
            (_, Some(at)) => b"0123456789-"[at].into(),
            ('\u{ff01}'..='\u{ff5e}', _) => char::from_u32(u32::from(c) - 0xfee0).unwrap_or(c),
            _ => c,
        });
    }
    plain
}

/// `7.4 x 10^6 1/m` as `7.4e6 1/m`.
fn with_exponent(text: &str) -> String {
    let parted = || {
        let (number, power) = text.split_once(['x', 'X', '×', '*', '·'])?;
        let power = power.trim_start().strip_prefix("10")?;
        let exponent = power.strip_prefix('^').or_else(|| power.strip_prefix("**"))?;
        Some(format!("{}e{exponent}", number.trim_end()))
    };
    parted().unwrap_or_else(|| text.to_owned())
}

#[cfg(test)]
mod tests {
    use super::respelled;

    #[test]
    fn numbers_of_other_programs_are_understood() {
        for (text, plain) in [
            ("１．５ m", "1.5 m"),
            ("3 000 MPa", "3000 MPa"),
            ("3 000 000 N", "3000000 N"),
            ("3'000 MPa", "3000 MPa"),
            ("7.4 x 10^6 1/m", "7.4e6 1/m"),
            ("7.4*10^6 1/m", "7.4e6 1/m"),
            ("7.4·10⁶ m⁻¹", "7.4e6 m^-1"),
            ("1.7×10⁻⁵ 1/K", "1.7e-5 1/K"),
            ("2 x 10**6 N", "2e6 N"),
        ] {
            assert_eq!(respelled(text), plain);
        }
        // What has another reading, or none, stays.
        for text in ["1 2 m", "1 0000 m", "7.4 x 106 1/m", "1.5 m", "2e7 1/m", "x"] {
            assert_eq!(respelled(text), text);
        }
    }
}
