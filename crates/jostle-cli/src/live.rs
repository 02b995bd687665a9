//! `jostle live`: a page that runs the model at every change.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::Ordering;
use std::time::Duration;

use jostle_io::{FileError, read_file};
use jostle_live::{Engine, Server};
use jostle_run::{EXAMPLE, FileKind};

use crate::failure::Failure;
use crate::replace::Target;
use crate::stop::stop_on_interrupt;
use crate::terminal;

/// Time without an open page after which the program ends.
const PATIENCE: Duration = Duration::from_secs(30 * 60);

#[derive(Debug, clap::Args)]
pub(crate) struct LiveArgs {
    /// Model file (TOML or JSON), or the name of a built-in example; without it, the built-in "paper"
    model: Option<PathBuf>,
    /// Do not open the browser
    #[arg(long)]
    no_open: bool,
    /// Port on this machine; 0 uses any free port
    #[arg(long, default_value_t = 0)]
    port: u16,
    /// Write the page with its engine to this file and exit; the page works offline and without jostle
    #[arg(long, value_name = "FILE", conflicts_with_all = ["no_open", "port"])]
    export: Option<PathBuf>,
    /// Engine for the exported page, as packaging/wasm writes it; by default jostle.wasm.gz next to the program
    #[arg(long, value_name = "FILE", requires = "export")]
    module: Option<PathBuf>,
    /// Replace a file that jostle did not write
    #[arg(long, requires = "export")]
    force: bool,
}

pub(crate) fn live(args: &LiveArgs) -> Result<(), Failure> {
    let engine = Engine::open(args.model.as_deref().unwrap_or(Path::new(EXAMPLE)))?;
    if let Some(path) = &args.export {
        let target = Target::new(path, FileKind::LIVE_PAGE, args.force)?;
        let module = module(args.module.as_deref())?;
        let page = jostle_live::export(&engine, &module);
        target.write(&page.map_err(|error| Failure::Input(error.to_string()))?)?;
        return Ok(());
    }
    let server =
        Server::start(engine, args.port).map_err(|error| Failure::Input(error.to_string()))?;
    let address = server.address();
    terminal::print(&format!("{address}\n"))?;
    terminal::remark(
        "Press Ctrl-C to end. The page opens only on this machine, and only with this address.",
    );
    if !args.no_open && !open_browser(&address) {
        terminal::remark("No browser could be opened; open the address above yourself.");
    }
    let stop = stop_on_interrupt();
    server.wait(&|| stop.load(Ordering::Relaxed), PATIENCE);
    Ok(())
}

/// Name of the engine of exported pages.
const MODULE: &str = "jostle.wasm.gz";
/// Its largest size \[bytes\].
const LARGEST_MODULE: usize = 64 << 20;

/// The engine of exported pages: the file that was asked for, or the one beside the program.
pub(crate) fn module(asked: Option<&Path>) -> Result<Vec<u8>, Failure> {
    if let Some(path) = asked {
        return read_file(path, LARGEST_MODULE)
            .map_err(|error| Failure::Input(format!("--module: {} {error}", path.display())));
    }
    let program = std::env::current_exe().and_then(|path| path.canonicalize());
    let beside = program.map(|path| path.with_file_name(MODULE));
    let read = beside.map_err(FileError::from);
    let read = read.and_then(|path| read_file(&path, LARGEST_MODULE));
    read.map_err(|error| {
        Failure::Input(format!(
            "--export needs the engine as WebAssembly, and {MODULE} beside the program {error}\n\
             take it from the archive of a release, or build it in a copy of the source with packaging/wasm; \
             name it with --module FILE"
        ))
    })
}

/// Opens the address in the default browser; `false` if there is no way to try.
fn open_browser(address: &str) -> bool {
    let (program, arguments): (&str, &[&str]) = if cfg!(target_os = "windows") {
        ("rundll32", &["url.dll,FileProtocolHandler"])
    } else if cfg!(target_os = "macos") {
        ("open", &[])
    } else {
        ("xdg-open", &[])
    };
    let mut command = Command::new(program);
    command.args(arguments).arg(address);
    command
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null());
    command.spawn().is_ok()
}
