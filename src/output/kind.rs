//! What a file is, by how it begins.

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    not(all(feature = "cli", feature = "plot")),
    allow(dead_code, reason = "without all features not every kind is written")
)]
pub enum Kind {
    Passes,
    Motion,
    Fit,
    Sweep,
    Figure,
    Page,
    /// Workbooks of Excel.
    #[cfg(feature = "xlsx")]
    RunBook,
    #[cfg(feature = "xlsx")]
    SweepBook,
    /// A new scene: never replaced but by force, for it is its author's work.
    Scene,
}

/// Kinds that are recognised by the beginning of a file.
const RECOGNISED: [Kind; 5] = [Kind::Passes, Kind::Motion, Kind::Fit, Kind::Sweep, Kind::Figure];
/// What the head of a page of ours holds.
pub const GENERATOR: &str = "<meta name=\"generator\" content=\"creepage";
/// Where the name of a ZIP archive's first part stands.
#[cfg(feature = "xlsx")]
const NAME: usize = 30;
/// Bytes at the beginning of most files that show their kind.
const HEAD: u64 = 1 << 16;

impl Kind {
    fn noun(self) -> &'static str {
        match self {
            Self::Passes => "table of `creepage run`",
            Self::Motion => "table of `creepage profile`",
            Self::Fit => "table of `creepage calibrate`",
            Self::Sweep => "table of `creepage sweep`",
            Self::Figure => "SVG figure",
            Self::Page => "page of `creepage report`",
            #[cfg(feature = "xlsx")]
            Self::RunBook => "workbook of `creepage run` as it wrote it",
            #[cfg(feature = "xlsx")]
            Self::SweepBook => "workbook of `creepage sweep` as it wrote it",
            Self::Scene => "empty file",
        }
    }

    /// What may be replaced, in words.
    pub fn older(self) -> String {
        let older = if self == Self::Scene { "an" } else { "an older" };
        format!("{older} {}", self.noun())
    }

    /// Columns that every table of this kind has.
    fn columns(self) -> &'static str {
        match self {
            Self::Passes => "pass downstream_force_n downstream_peak_n upstream_force_n upstream_peak_n",
            Self::Motion => "position_m longitudinal_m vertical_m longitudinal_velocity_m_per_s",
            Self::Fit => "pass force_n fitted_n residual_n",
            Self::Sweep => "downstream_force_n upstream_force_n error_estimate status error",
            _ => "",
        }
    }

    /// The name by which a workbook of this kind is known.
    #[cfg(feature = "xlsx")]
    pub fn mark(self) -> Option<&'static str> {
        match self {
            Self::RunBook => Some("creepage_run"),
            Self::SweepBook => Some("creepage_sweep"),
            _ => None,
        }
    }

    /// Bytes at the beginning of a file that show its kind: of a workbook, all.
    pub fn head(self) -> u64 {
        match self {
            #[cfg(feature = "xlsx")]
            Self::RunBook | Self::SweepBook => u64::MAX,
            _ => HEAD,
        }
    }

    /// Whether a file that begins with `head` is of this kind.
    pub fn is_kind_of(self, head: &[u8]) -> bool {
        match self {
            Self::Figure => begins(head, b"<svg"),
            Self::Page => {
                begins(head, b"<!doctype html") && String::from_utf8_lossy(head).contains(GENERATOR)
            }
            #[cfg(feature = "xlsx")]
            Self::RunBook | Self::SweepBook => self.mark().is_some_and(|mark| is_own_book(head, mark)),
            Self::Scene => false,
            Self::Passes | Self::Motion | Self::Fit | Self::Sweep => {
                let line = head.split(|&byte| byte == b'\n').next().unwrap_or_default();
                let line = String::from_utf8_lossy(line);
                let found: Vec<&str> = line.trim_end().split(',').collect();
                self.columns().split(' ').all(|column| found.contains(&column))
            }
        }
    }
}

/// What a file looks like that begins with `head`.
pub fn described(head: &[u8]) -> String {
    match RECOGNISED.into_iter().find(|kind| kind.is_kind_of(head)) {
        Some(Kind::Figure) => format!("an {}", Kind::Figure.noun()),
        Some(kind) => format!("a {}", kind.noun()),
        None => something_else(head).to_owned(),
    }
}

/// Whether a workbook holds our name, and its parts lie as we write them: programs that save it put them in another order, and what they
/// have saved is somebody's work.
#[cfg(feature = "xlsx")]
fn is_own_book(bytes: &[u8], mark: &str) -> bool {
    use calamine::{Reader, Xlsx};

    let order = ["[Content_Types].xml", "xl/theme/theme1.xml", "xl/workbook.xml"];
    let places = order.map(|part| place(bytes, part).unwrap_or(usize::MAX));
    let is_as_written = places[0] == NAME && places.is_sorted();
    let names = || Xlsx::new(std::io::Cursor::new(bytes)).map(|book| book.defined_names().to_vec());
    is_as_written && names().is_ok_and(|names| names.iter().any(|(name, _)| name == mark))
}

/// Where a text stands for the first time.
fn place(bytes: &[u8], text: &str) -> Option<usize> {
    bytes
        .windows(text.len())
        .position(|window| window == text.as_bytes())
}

fn something_else(head: &[u8]) -> &'static str {
    if head.starts_with(b"PK\x03\x04") {
        let is_workbook = place(head, "xl/").is_some();
        return if is_workbook {
            "an Excel workbook"
        } else {
            "a ZIP archive"
        };
    }
    if begins(head, b"<!doctype html") || begins(head, b"<html") {
        return "a page of HTML";
    }
    // The head may end within a letter.
    let text = match str::from_utf8(head) {
        Ok(text) => text,
        Err(error) if error.error_len().is_none() => {
            str::from_utf8(&head[..error.valid_up_to()]).unwrap_or_default()
        }
        Err(_) => return "binary data",
    };
    if text.contains('\0') {
        return "binary data";
    }
    let lines = text.lines().map(str::trim);
    let mut lines = lines.filter(|line| !line.is_empty() && !line.starts_with('#'));
    let is_of_a_scene = |line: &str| line.starts_with("[duct]") || line.starts_with("[[vehicles]]");
    if lines.clone().any(is_of_a_scene) {
        return "a scene";
    }
    if lines.next().is_some_and(|line| line.contains([',', ';', '\t'])) {
        return "a table of something else";
    }
    "a text"
}

fn begins(head: &[u8], with: &[u8]) -> bool {
    let head = head.trim_ascii_start();
    head.get(..with.len())
        .is_some_and(|start| start.eq_ignore_ascii_case(with))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_looks_alike_is_told_apart() {
        let cases: [(&[u8], &str); 10] = [
            (b"pass,force_n\n1,2\n", "a table of something else"),
            (b"pass;force\n1;2\n", "a table of something else"),
            (b"# note\n[duct]\nlength = 1\n", "a scene"),
            (b"dear diary\n", "a text"),
            (b"\0\x01", "binary data"),
            (b"\xff\xfe", "binary data"),
            (b"<svg xmlns", "an SVG figure"),
            (b"<!DOCTYPE html><title>else</title>", "a page of HTML"),
            ("caf\u{e9}".as_bytes().split_at(4).0, "a text"),
            (
                b"pass,force_n,fitted_n,residual_n\n",
                "a table of `creepage calibrate`",
            ),
        ];
        for (head, found) in cases {
            assert_eq!(described(head), found, "{}", String::from_utf8_lossy(head));
        }
        assert!(!Kind::Page.is_kind_of(b"<!DOCTYPE html><title>else</title>"));
        // Readings are no fit, and a table of a sweep is none of a run.
        assert!(!Kind::Fit.is_kind_of(b"pass,force_n,sigma_n\n"));
        assert!(
            !Kind::Passes
                .is_kind_of(b"duct.depth,downstream_force_n,upstream_force_n,error_estimate,status,error\n")
        );
        assert!(!Kind::Scene.is_kind_of(b"[duct]\n"));
    }
}
