//! `creepage completions`: scripts that complete commands and flags in a shell.

use std::io::Write;

use clap_complete::Shell;

use super::failure::Failure;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The script goes to standard output. Shells look for it in a file of theirs, such as
  bash   ~/.local/share/bash-completion/completions/creepage, with the package bash-completion
  zsh    _creepage in a folder of fpath
  fish   ~/.config/fish/completions/creepage.fish

Examples:
  creepage completions bash > ~/.local/share/bash-completion/completions/creepage
  creepage completions powershell > creepage.ps1"
)]
pub struct Arguments {
    /// The shell
    shell: Shell,
}

pub fn execute(arguments: &Arguments, command: &mut clap::Command) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, command, "creepage", &mut script);
    Ok(std::io::stdout().lock().write_all(&script)?)
}
