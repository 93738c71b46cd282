//! What README and docs/ show: scenes run, commands work, and print what stands below them.

use std::fs;
use std::path::Path;

use crate::command::{SERIES, UPPER, answer, command, folder, json, list, number, read, words};

/// Blocks of a page with their languages. Fences open and close in turn: every second part is a block, its language in the first line.
fn blocks(page: &str) -> Vec<(&str, &str)> {
    let fences = page.split("```").skip(1).step_by(2);
    fences.filter_map(|block| block.split_once('\n')).collect()
}

/// The scene that the commands of the pages read.
pub const MY_DUCT: &str = "examples/scenes/my-duct.toml";

#[test]
fn the_scene_of_the_pages_runs() {
    let run = json(&format!("run {MY_DUCT}"));
    let last = list(&run["passes"]).last().expect("a pass");
    assert!(number(&last["downstream_force_n"]).abs() > 1.0);
}

/// The commands of the README and of every page of docs/ run, a page in one folder with `my-duct.toml`; a block of `csv`
/// whose first line is `# NAME.csv` is a file there. A block of `text` after a block of `sh` shows lines that its commands
/// print, in their order; a line `...` stands for what is left out. If nothing is shown, a few passes are enough. A block
/// marked `sh slow` is not run.
#[test]
#[ignore = "half a minute: .ci/run runs it"]
fn the_commands_of_the_pages_work_and_print_what_these_show() {
    pages("pages", short);
}

#[test]
#[ignore = "minutes: hundreds of passes that show no more than a few"]
fn the_commands_of_the_pages_with_all_passes() {
    pages("pages_with_all_passes", str::to_owned);
}

fn pages(test: &str, said: impl Fn(&str) -> String) {
    let docs = fs::read_dir("docs").expect("docs/");
    let docs = docs.map(|entry| entry.expect("an entry").path().display().to_string());
    let docs = docs.filter(|page| page.strip_suffix(".md").is_some());
    let mut run = 0;
    for page in docs.chain(["README.md".to_owned()]) {
        let folder = folder(&format!("{test}/{page}"));
        fs::write(folder.join("my-duct.toml"), read(MY_DUCT)).expect("a copy");
        // Commands on files that come with the project find them where they stand.
        for example in [UPPER, MY_DUCT, SERIES] {
            let copy = folder.join(example);
            fs::create_dir_all(copy.parent().expect("a folder")).expect("a folder");
            fs::write(copy, read(example)).expect("a copy");
        }
        run += page_commands(&read(&page), &folder, &said);
    }
    assert!(run >= 50, "{run} commands");
}

/// Runs the commands of one page, and returns how many there are.
fn page_commands(page: &str, folder: &Path, said: &impl Fn(&str) -> String) -> usize {
    let (mut printed, mut run) = (String::new(), 0);
    let blocks = blocks(page);
    for (index, &(language, block)) in blocks.iter().enumerate() {
        match language {
            "sh" => {
                let mut after = blocks[index + 1..].iter().map(|(language, _)| *language);
                let shows = after.find(|language| ["sh", "text"].contains(language)) == Some("text");
                let said = |line: &str| if shows { line.to_owned() } else { said(line) };
                printed = commands(block).map(|line| run_in(folder, &said(line))).collect();
                run += commands(block).count();
            }
            "csv" => {
                let name = block.lines().next().and_then(|line| line.strip_prefix("# "));
                let name = name.and_then(|line| line.split(':').next()).expect("a name");
                fs::write(folder.join(name), block).expect("a file");
            }
            "text" => assert_shows(block.trim_end_matches('\n'), &printed),
            _ => {}
        }
    }
    run
}

/// The same command with twelve passes, where it reads a scene and names no passes itself.
fn short(line: &str) -> String {
    let words = line.split('#').next().unwrap_or_default().trim_end();
    let sceneless = ["new ", "presets", "explain", "schema", "completions"];
    if words.contains("traffic.passes") || sceneless.iter().any(|name| words.starts_with(name)) {
        return words.to_owned();
    }
    // Years count before passes.
    let mut few = words.to_owned();
    for (many, less) in [
        ("--years 20 ", "--days 1 "),
        ("--days 182 ", "--days 2 "),
        ("--days 183 ", "--days 3 "),
        ("--trucks-per-day 800", "--trucks-per-day 20"),
        ("--trucks-per-day 2000", "--trucks-per-day 20"),
    ] {
        few = few.replace(many, less);
    }
    few + " --set traffic.passes=12"
}

/// Lines of a block of `sh` that call the program, without its name.
fn commands(block: &str) -> impl Iterator<Item = &str> {
    let names = ["creepage ", "cargo run --release -- "];
    let command = move |line| names.iter().find_map(|name| str::strip_prefix(line, *name));
    block.lines().filter_map(command)
}

/// What a command of a page prints; it has to succeed. What stands in double quotes is one word.
#[track_caller]
fn run_in(folder: &Path, line: &str) -> String {
    let typed = line.split('#').next().unwrap_or_default().replace('"', "'");
    let mut command = command("");
    let output = command.args(words(&typed)).current_dir(folder).output();
    let (status, said, errors) = answer(output.expect("the command"));
    assert_eq!(status, 0, "creepage {line}: {errors}");
    said
}

/// Every line of `shown` is printed, one after the other; numbers may differ a little from machine to machine.
#[track_caller]
fn assert_shows(shown: &str, printed: &str) {
    let mut lines = printed.lines();
    let mut left_out = true;
    for wanted in shown.lines() {
        if wanted.trim() == "..." {
            left_out = true;
        } else if left_out {
            assert!(lines.any(|line| alike(wanted, line)), "{wanted} {printed}");
            left_out = false;
        } else {
            let line = lines.next().unwrap_or_default();
            assert!(alike(wanted, line), "shown:\n{wanted}\nprinted:\n{line}");
        }
    }
}

/// Whether two lines have the same words, and numbers within 0.2 % or one of their last decimals; milliseconds that something takes, within
/// half of them, for planning is measured.
fn alike(shown: &str, printed: &str) -> bool {
    let [shown, printed] = [shown, printed].map(|line| line.split_whitespace().collect::<Vec<_>>());
    let same = |index: usize| {
        let (a, b) = (shown[index], printed[index]);
        let is_measured = shown.get(index + 1) == Some(&"ms");
        let share = if is_measured { 0.5 } else { 2e-3 };
        match (a.parse::<f64>(), b.parse::<f64>()) {
            (Ok(x), Ok(y)) => (x - y).abs() <= (share * y.abs()).max(1.01 * last_decimal(a)),
            _ => a == b,
        }
    };
    shown.len() == printed.len() && (0..shown.len()).all(same)
}

/// 0.01 for "3.58"; 0 for a whole number or one with an exponent.
fn last_decimal(number: &str) -> f64 {
    match number.split_once('.') {
        Some((_, decimals)) if !decimals.contains('e') => 0.1_f64.powf(decimals.len() as f64),
        _ => 0.0,
    }
}
