//! Good inputs made bad: a few changes of letters, words, lines and numbers, the same for the same seed.

use fastrand::Rng;

/// What is put in place of a number.
const NUMBERS: &str = "0 -0 -1 1 0.5 nan inf -inf 1e400 -1e400 1e-400 1e308 0x1f 1_000 1,5 .5 5. 1.2.3 +3 99999999999999999999999 \
    18446744073709551615 1e9999999999";
/// What is put anywhere, `|` between.
const WORDS: &str = "\"|'|\"\"\"|'''|[|]|[[|]]|{|}|=|,|.|#|\n|\r\n|\t| |\\|\\u0000|\u{feff}|\u{1b}[2J|“|”|名|µ|²|%|:|(|)|true|1979-05-27|\
    preset = \"t-25\"\n|[duct]\n|[[vehicles]]\n|spring|normal(1, 2)|fixed|m";

fn one_of<'t>(random: &mut Rng, list: &'t str, separator: char) -> &'t str {
    let all: Vec<&str> = list.split(separator).collect();
    random.choice(all).unwrap_or_default()
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
    let word = one_of(random, WORDS, '|');
    match random.u8(0..9) {
        0 => {
            let letter = random.char(..).to_string();
            spliced(random, text, 0, &letter)
        }
        1 => {
            let length = random.usize(1..8);
            spliced(random, text, length, "")
        }
        2 => spliced(random, text, 0, word),
        3 => {
            let length = random.usize(1..6);
            spliced(random, text, length, word)
        }
        4 | 5 => {
            let by = one_of(random, NUMBERS, ' ');
            let is_number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-');
            exchanged(random, text, is_number, |_, _| by)
        }
        // One word for another of the same text.
        6 => {
            let is_word = |c: char| !c.is_whitespace() && !matches!(c, '=' | ',' | '{' | '}' | '[' | ']');
            exchanged(random, text, is_word, |random, words| {
                random.choice(words).copied().unwrap_or_default()
            })
        }
        7 => other_line(random, text, others),
        _ => {
            let many = word.repeat(random.usize(1..200));
            spliced(random, text, 0, &many)
        }
    }
}

/// Replaces so many letters somewhere.
fn spliced(random: &mut Rng, text: &str, length: usize, by: &str) -> String {
    let ends: Vec<usize> = (0..=text.len()).filter(|at| text.is_char_boundary(*at)).collect();
    let start = random.usize(0..ends.len());
    let end = (start + length).min(ends.len() - 1);
    let (start, end) = (ends[start], ends[end]);
    format!("{}{by}{}", &text[..start], &text[end..])
}

/// Exchanges one stretch of letters that belong to a word.
fn exchanged<'t>(
    random: &mut Rng,
    text: &'t str,
    belongs: impl Fn(char) -> bool,
    by: impl FnOnce(&mut Rng, &[&'t str]) -> &'t str,
) -> String {
    let words: Vec<&str> = text
        .split(|c| !belongs(c))
        .filter(|word| !word.is_empty())
        .collect();
    let Some(word) = random.choice(&words) else {
        return text.to_owned();
    };
    let start = word.as_ptr() as usize - text.as_ptr() as usize;
    let by = by(random, &words);
    format!("{}{by}{}", &text[..start], &text[start + word.len()..])
}

/// Leaves a line out, doubles it, or puts one of another input in.
fn other_line(random: &mut Rng, text: &str, others: &[String]) -> String {
    let mut lines: Vec<&str> = text.lines().collect();
    if lines.is_empty() {
        return text.to_owned();
    }
    let at = random.usize(0..lines.len());
    let other = random.choice(others).map_or("", String::as_str);
    match (random.u8(0..3), random.choice(other.lines().collect::<Vec<_>>())) {
        (0, _) => drop(lines.remove(at)),
        (1, _) => lines.insert(random.usize(0..=lines.len()), lines[at]),
        (_, line) => lines[at] = line.unwrap_or(lines[at]),
    }
    lines.join("\n") + "\n"
}
