//! The word someone probably meant.

use std::cmp::Reverse;

/// The one of `known` nearest to `word`, if one is near enough to be suggested.
pub fn nearest<'k>(word: &str, known: impl IntoIterator<Item = &'k str>) -> Option<&'k str> {
    let plain = |text: &str| -> Vec<char> {
        text.chars()
            .flat_map(char::to_lowercase)
            .map(|c| if matches!(c, '_' | ' ') { '-' } else { c })
            .collect()
    };
    let word = plain(word);
    let mut best = None;
    for candidate in known {
        let letters = plain(candidate);
        let (short, long) = if word.len() < letters.len() {
            (&word, &letters)
        } else {
            (&letters, &word)
        };
        let allowed = (long.len() / 3).max(1);
        let distance = if short.len() >= 3 && short.len() < long.len() && long.starts_with(short) {
            1
        } else if long.len() - short.len() > allowed {
            continue;
        } else {
            distance(&word, &letters)
        };
        // A single letter that differs altogether is no near miss.
        if distance <= allowed && distance < long.len() {
            let same = word.iter().zip(&letters).take_while(|(a, b)| a == b).count();
            // Of equally near words the one that begins alike.
            let rank = (distance, Reverse(same));
            if best.is_none_or(|(least, _)| rank < least) {
                best = Some((rank, candidate));
            }
        }
    }
    best.map(|(_, candidate)| candidate)
}

/// Letters to insert, remove, replace or exchange with their neighbour (optimal string alignment).
fn distance(a: &[char], b: &[char]) -> usize {
    let mut before: Vec<usize> = Vec::new();
    let mut above: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1; b.len() + 1];
        for j in 0..b.len() {
            row[j + 1] = (above[j] + usize::from(a[i] != b[j]))
                .min(above[j + 1] + 1)
                .min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                row[j + 1] = row[j + 1].min(before[j - 1] + 1);
            }
        }
        before = std::mem::replace(&mut above, row);
    }
    above[b.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn near_misses_are_found_and_others_are_not() {
        let known = ["length", "depth", "lateral_offset"];
        assert_eq!(nearest("lenght", known), Some("length"));
        assert_eq!(nearest("Depth", known), Some("depth"));
        assert_eq!(nearest("lateral-offset", known), Some("lateral_offset"));
        assert_eq!(nearest("lateral", known), Some("lateral_offset"));
        assert_eq!(nearest("lwa", ["low", "law"]), Some("law"));
        assert_eq!(nearest("Mpa", ["Pa", "MPa"]), Some("MPa"));
        assert_eq!(nearest("kg/m", ["kN/m", "kgf/m"]), Some("kgf/m"));
        assert_eq!(nearest("colour", known), None);
        assert_eq!(nearest("", known), None);
        assert_eq!(nearest("z", ["x", "y"]), None);
        assert_eq!(nearest("長さ", known), None);
    }
}
