//! `creepage completions`: scripts that complete commands and flags in a shell.

use std::env;
use std::fs;
use std::io::Write;
use std::path::PathBuf;

use clap_complete::Shell;

use super::failure::Failure;
use super::shared::Force;
use super::terminal;
use crate::output::{COMPLETIONS, Kind, OutputError};

#[derive(Debug, clap::Args)]
#[command(
    after_help = "With --install the script goes where the shell looks for it by its name:
  bash   $XDG_DATA_HOME/bash-completion/completions/creepage, needs the package bash-completion
  zsh    $XDG_DATA_HOME/zsh/site-functions/_creepage, a folder that has to be in fpath
  fish   $XDG_CONFIG_HOME/fish/completions/creepage.fish
Where they are not set, $XDG_DATA_HOME is ~/.local/share and $XDG_CONFIG_HOME is ~/.config.

Examples:
  creepage completions bash --install
  creepage completions powershell > creepage.ps1"
)]
pub struct Arguments {
    /// The shell
    shell: Shell,
    /// Put the script where the shell finds it: bash, zsh or fish
    #[arg(long)]
    install: bool,
    #[command(flatten)]
    force: Force,
}

pub fn execute(arguments: &Arguments, command: &mut clap::Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, command, "creepage", &mut script);
    let script = marked(&script);
    if !arguments.install {
        return Ok(std::io::stdout().lock().write_all(&script)?);
    }
    let path = place(arguments.shell)?;
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(|source| OutputError::unwritable(&path, source))?;
    }
    let file = arguments.force.files([]).output(&path, Kind::Completions)?;
    file.write(|out| out.write_all(&script))?;
    let mut out = terminal::out();
    writeln!(out, "{} is written", path.display())?;
    if let (Shell::Zsh, Some(folder)) = (arguments.shell, path.parent()) {
        writeln!(
            out,
            "unless its folder is in fpath already, put this line into ~/.zshrc, before compinit:\n  fpath=({} $fpath)",
            folder.display()
        )?;
    }
    Ok(())
}

/// The script with a line by which it is known as ours; zsh reads the first line itself.
fn marked(script: &[u8]) -> Vec<u8> {
    let tag = script.starts_with(b"#compdef");
    let end = script.iter().position(|&byte| byte == b'\n').filter(|_| tag);
    let (first, rest) = script.split_at(end.map_or(0, |end| end + 1));
    [first, COMPLETIONS.as_bytes(), b"\n", rest].concat()
}

/// Where the shell looks for the script by its name.
fn place(shell: Shell) -> Result<PathBuf, Failure> {
    let (variable, below_home, below) = match shell {
        Shell::Bash => (
            "XDG_DATA_HOME",
            ".local/share",
            "bash-completion/completions/creepage",
        ),
        Shell::Zsh => ("XDG_DATA_HOME", ".local/share", "zsh/site-functions/_creepage"),
        Shell::Fish => ("XDG_CONFIG_HOME", ".config", "fish/completions/creepage.fish"),
        other => {
            return Err(Failure::Usage {
                argument: "--install",
                found: other.to_string(),
                allowed: "bash, zsh or fish; other shells read the script from a file of yours".into(),
            });
        }
    };
    // Relative folders are to be left alone (XDG Base Directory Specification).
    let folder = |name: &str| {
        let value = env::var_os(name).map(PathBuf::from);
        value.filter(|folder| folder.is_absolute())
    };
    let base = folder(variable).or_else(|| Some(folder("HOME")?.join(below_home)));
    let base = base.ok_or_else(|| Failure::Usage {
        argument: "--install",
        found: format!("neither {variable} nor HOME"),
        allowed: "one of them, with an absolute path".into(),
    })?;
    Ok(base.join(below))
}
