//! Good inputs made bad: a few changes of letters, words, lines and numbers, the same for the same seed.

use fastrand::Rng;

/// What is put in place of a number.
const NUMBERS: &str = "0 -0 -1 1 0.5 nan inf -inf 1e400 -1e400 1e-400 1e308 0x1f 1_000 1,5 .5 5. 1.2.3 +3 99999999999999999999999 \
    18446744073709551615 1e9999999999";
/// What is put anywhere, `|` between.
const WORDS: &str = "\"|'|\"\"\"|'''|[|]|[[|]]|{|}|=|,|.|#|\n|\r\n|\t| |\\|\\u0000|\u{feff}|\u{1b}[2J|“|”|名|µ|²|%|:|(|)|true|1979-05-27|\
    preset = \"t-25\"\n|[duct]\n|[[vehicles]]\n|spring|normal(1, 2)|fixed|m";

fn word(random: &mut Rng) -> &'static str {
    random
        .choice(WORDS.split('|').collect::<Vec<_>>())
        .unwrap_or_default()
}

/// One to four changes of `text`; `others` lend their lines.
pub fn mutated(random: &mut Rng, text: &str, others: &[String]) -> String {
    let mut text = text.to_owned();
    for _ in 0..random.usize(1..=4) {
        text = changed(random, &text, others);
    }
    text
}

fn changed(random: &mut Rng, text: &str, others: &[String]) -> String {
    match random.u8(0..9) {
        0 => {
            let letter = random.char(..).to_string();
            spliced(random, text, 0, &letter)
        }
        1 => {
            let length = random.usize(1..8);
            spliced(random, text, length, "")
        }
        2 => {
            let word = word(random);
            spliced(random, text, 0, word)
        }
        3 => {
            let (length, word) = (random.usize(1..6), word(random));
            spliced(random, text, length, word)
        }
        4 | 5 => other_number(random, text),
        6 => other_value(random, text),
        7 => other_line(random, text, others),
        _ => {
            let many = word(random).repeat(random.usize(1..200));
            spliced(random, text, 0, &many)
        }
    }
}

/// Replaces about `length` bytes somewhere.
fn spliced(random: &mut Rng, text: &str, length: usize, by: &str) -> String {
    let mut start = random.usize(0..=text.len());
    while !text.is_char_boundary(start) {
        start -= 1;
    }
    let mut end = (start + length).min(text.len());
    while !text.is_char_boundary(end) {
        end += 1;
    }
    format!("{}{by}{}", &text[..start], &text[end..])
}

fn other_number(random: &mut Rng, text: &str) -> String {
    let numbers: Vec<(usize, usize)> = words(text, |c| c.is_ascii_digit() || matches!(c, '.' | '-'));
    let Some(&(start, end)) = random.choice(&numbers) else {
        return text.to_owned();
    };
    let by = random
        .choice(NUMBERS.split(' ').collect::<Vec<_>>())
        .unwrap_or_default();
    format!("{}{by}{}", &text[..start], &text[end..])
}

/// Exchanges one word for another of the same text.
fn other_value(random: &mut Rng, text: &str) -> String {
    let all = words(text, |c| {
        !c.is_whitespace() && !matches!(c, '=' | ',' | '{' | '}' | '[' | ']')
    });
    let (Some(&(start, end)), Some(&(from, to))) = (random.choice(&all), random.choice(&all)) else {
        return text.to_owned();
    };
    format!("{}{}{}", &text[..start], &text[from..to], &text[end..])
}

/// Leaves a line out, doubles it, or puts one of another input in.
fn other_line(random: &mut Rng, text: &str, others: &[String]) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    if lines.is_empty() {
        return text.to_owned();
    }
    let at = random.usize(0..lines.len());
    match random.u8(0..3) {
        0 => {
            lines.remove(at);
        }
        1 => lines.insert(random.usize(0..=lines.len()), lines[at]),
        _ => {
            let other = random.choice(others).map_or("", String::as_str);
            if let Some(line) = random.choice(&other.lines().collect::<Vec<_>>()) {
                lines[at] = line;
            }
        }
    }
    lines.join("\n") + "\n"
}

/// Stretches of letters that belong to a word.
fn words(text: &str, belongs: impl Fn(char) -> bool) -> Vec<(usize, usize)> {
    let mut words = Vec::new();
    let mut start = None;
    for (at, c) in text.char_indices() {
        match (belongs(c), start) {
            (true, None) => start = Some(at),
            (false, Some(from)) => {
                words.push((from, at));
                start = None;
            }
            _ => {}
        }
    }
    words.extend(start.map(|from| (from, text.len())));
    words
}
