//! `creepage explore`: a page on this machine, and none other, on which the scene's numbers are sliders and the answer follows the hand.
//!
//! The page asks over HTTP on the loopback address, with a token that only its address holds. Nothing is written to files here.

mod bench;
mod controls;
mod film;
mod question;
mod server;
mod session;

use std::io::Write;
use std::process::{Command, Stdio};

use super::failure::Failure;
use super::shared::TrafficArguments;
use super::{signals, terminal};
use bench::Desk;
use server::Server;
use session::Session;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "The page is served on 127.0.0.1 to whoever has its address, which holds a random token, and to no other machine; it loads nothing and writes no file. It ends with Ctrl-C, or with its button “End”.

Examples:
  creepage explore my-duct.toml
  creepage explore my-duct.toml --years 20 --trucks-per-day 800
  creepage explore my-duct.toml --port 8080 --no-browser"
)]
pub struct Arguments {
    #[command(flatten)]
    scene: TrafficArguments,
    /// Port of the page; a free one if omitted
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// Print the page's address without opening a browser
    #[arg(long)]
    no_browser: bool,
}

pub fn execute(arguments: &Arguments) -> Result<(), Failure> {
    let file = arguments.scene.read()?;
    file.scene()?;
    super::shared::warn_of_slips(&file);
    let server = Server::new(arguments.port, random()?)?;
    let address = server.address();
    signals::leaves("the page answers no more; nothing was written".into());
    signals::listen();
    writeln!(terminal::out(), "{address}")?;
    writeln!(terminal::err(), "the page ends with Ctrl-C or its button “End”")?;
    if !arguments.no_browser {
        open(&address);
    }
    let path = &arguments.scene.file.scene;
    let session = Session {
        file,
        name: terminal::line(&path.file_name().unwrap_or_default().to_string_lossy()),
        overrides: arguments.scene.overrides(),
        nonce: random()?,
        desk: Desk::default(),
    };
    server.serve(move |method, path, body| session.reply(method, path, body));
    Ok(())
}

/// 128 random bits of the system, in hexadecimal digits.
fn random() -> Result<String, Failure> {
    let mut bytes = [0; 16];
    getrandom::fill(&mut bytes).map_err(|error| std::io::Error::other(error.to_string()))?;
    Ok(format!("{:032x}", u128::from_ne_bytes(bytes)))
}

/// Shows the page in the system's browser; if there is none, its address is printed.
fn open(address: &str) {
    let (program, arguments) = match std::env::consts::OS {
        "windows" => ("rundll32", &["url.dll,FileProtocolHandler"][..]),
        "macos" => ("open", &[][..]),
        _ => ("xdg-open", &[][..]),
    };
    let mut browser = Command::new(program);
    browser.args(arguments).arg(address).stdin(Stdio::null());
    let _ = browser.stdout(Stdio::null()).stderr(Stdio::null()).spawn();
}
