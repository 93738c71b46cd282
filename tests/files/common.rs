//! A folder of a test's own, commands in it, and what they leave there.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use calamine::{Reader, Xlsx};

use crate::command::words;

/// A scene that is computed within milliseconds.
pub const SCENE: &str = r#"title = "Small"
duct = { length = "20 m", depth = "1.2 m" }
ground = { layers = [{ young_modulus = "300 MPa", poisson_ratio = 0.4 }] }
cable = { weight = "108.8 N/m", axial_stiffness = "8.01e6 N" }
friction = { dynamic_coefficient = 0.25, shape_factor = "7e6 1/m" }
ends = { upstream = "free", downstream = "fixed" }
vehicles = [{ name = "truck", speed = "40 km/h", load = "20 tf" }]
traffic = { passes = 5 }
solver = { method = "quasi-static", node_spacing = "0.5 m", tolerance = 0.5 }
"#;
/// Readings for it.
pub const READINGS: &str = "pass,force_n\n1,110\n2,160\n3,200\n4,220\n5,240\n";
/// What nobody wants to lose.
pub const PRECIOUS: &str = "notes of a whole year\n";
pub const SWEEP: &str = "sweep scene.toml --vary duct.depth=1,2";
pub const MAP: &str = "sweep scene.toml --vary duct.depth=1,2 --vary duct.length=20m,30m";
/// What reads a scene and writes: each command without its output, and the output's ending. OUT is the table of a sweep with a map.
#[rustfmt::skip]
pub const WRITERS: [(&str, &str); 8] = [
    ("run scene.toml --xlsx", "xlsx"),
    ("sweep scene.toml --vary duct.depth=1,2 --out", "xlsx"),
    ("run scene.toml --csv", "csv"),
    ("profile scene.toml --positions 0,1 --csv", "csv"),
    ("calibrate scene.toml --data data.csv --fit dynamic_coefficient --csv", "csv"),
    ("sweep scene.toml --vary duct.depth=1,2 --out", "csv"),
    ("sweep scene.toml --vary duct.depth=1,2 --vary duct.length=20m,30m --out OUT --map", "svg"),
    ("report scene.toml --data data.csv -o", "html"),
];

/// A folder with a scene, readings and a folder.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new(test: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("files").join(test);
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(path.join("sub")).expect("a folder");
        let folder = Self(path);
        folder.write("scene.toml", SCENE);
        folder.write("data.csv", READINGS);
        folder
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).expect("a file");
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn remove(&self, name: &str) {
        let _ = fs::remove_file(self.path(name));
    }

    pub fn command(&self, program: &str, arguments: &[impl AsRef<OsStr>]) -> Command {
        let mut command = Command::new(program);
        command.current_dir(&self.0).args(arguments).stdin(Stdio::null());
        command
    }

    /// The command `creepage` with the words of a line, its output piped.
    pub fn piped(&self, line: &str) -> Command {
        let mut command = self.command(creepage(), &words(line));
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    pub fn creepage(&self, line: &str) -> Output {
        self.piped(line).output().expect("the command starts")
    }

    /// The same after a line of shell, such as one that sets limits.
    pub fn creepage_after(&self, shell: &str, line: &str) -> Output {
        let shell = format!("{shell}\nexec \"$0\" \"$@\"");
        let mut command = self.command("sh", &["-c", &shell, creepage()]);
        command.args(words(line)).output().expect("the shell starts")
    }

    #[track_caller]
    pub fn succeeds(&self, line: &str) -> Output {
        let output = self.creepage(line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", said(&output));
        output
    }

    /// Asserts that the command is refused and changes nothing.
    #[track_caller]
    pub fn refused(&self, line: &str, part: &str) {
        let before = self.contents();
        let output = self.creepage(line);
        assert_eq!(output.status.code(), Some(2), "{line}: {}", said(&output));
        assert!(said(&output).contains(part), "{line}: {}", said(&output));
        assert!(self.contents() == before, "{line} changed a file");
    }

    pub fn mode(&self, name: &str) -> u32 {
        let found = fs::metadata(self.path(name)).expect("a file");
        found.permissions().mode() & 0o7777
    }

    pub fn set_mode(&self, name: &str, mode: u32) {
        fs::set_permissions(self.path(name), fs::Permissions::from_mode(mode)).expect("a mode");
    }

    pub fn link(&self, to: &str, name: &str) {
        std::os::unix::fs::symlink(to, self.path(name)).expect("a link");
    }

    pub fn hard_link(&self, to: &str, name: &str) {
        fs::hard_link(self.path(to), self.path(name)).expect("a hard link");
    }

    /// Everything in the folder by its name: the bytes of files, and where links lead.
    pub fn contents(&self) -> BTreeMap<String, Vec<u8>> {
        let content = |path: &Path| match fs::read_link(path) {
            Ok(link) => format!("-> {}", link.display()).into_bytes(),
            Err(_) if path.is_file() => fs::read(path).expect("a file"),
            Err(_) => b"something else".to_vec(),
        };
        let names = self.names().into_iter();
        names
            .map(|name| (name.clone(), content(&self.path(&name))))
            .collect()
    }

    /// The names in the folder, and in the one within it.
    pub fn names(&self) -> Vec<String> {
        let within = |folder: &Path, begin: &str| -> Vec<String> {
            let entries = fs::read_dir(folder).into_iter().flatten().flatten();
            let name = |entry: fs::DirEntry| entry.file_name().into_string().expect("a name");
            entries.map(|entry| format!("{begin}{}", name(entry))).collect()
        };
        [within(&self.0, ""), within(&self.path("sub"), "sub/")].concat()
    }
}

pub fn creepage() -> &'static str {
    env!("CARGO_BIN_EXE_creepage")
}

pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Asserts that an output with this ending is there as a whole.
#[track_caller]
pub fn assert_complete(content: &[u8], ending: &str) {
    let text = || str::from_utf8(content).expect("UTF-8");
    match ending {
        "csv" => {
            let mut reader = csv::Reader::from_reader(content);
            let rows: Vec<_> = reader.records().map(|row| row.expect("a row")).collect();
            assert!(rows.len() >= 2 && content.ends_with(b"\n"), "{}", text());
        }
        "xlsx" => {
            let mut book = Xlsx::new(std::io::Cursor::new(content)).expect("a workbook");
            assert_eq!(book.sheet_names().last().map(String::as_str), Some("scene"));
            for (name, sheet) in book.worksheets() {
                assert!(sheet.height() >= 2, "{name}");
            }
        }
        "svg" => assert!(text().starts_with("<svg") && text().trim_end().ends_with("</svg>")),
        "html" => assert!(text().starts_with("<!DOCTYPE html>") && text().trim_end().ends_with("</html>")),
        "toml" => drop(creepage::Scene::from_toml("new", text()).expect("a scene")),
        _ => panic!("{ending}"),
    }
}
