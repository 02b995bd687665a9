//! `jostle mcp`: jostle as tools of an assistant, by the Model Context Protocol over standard input and output.

mod arguments;
mod explain;
mod server;
mod study;
mod tools;

use std::path::Path;

use jostle_io::Files;
use rmcp::ServiceExt;
use rmcp::service::ServerInitializeError;
use rmcp::transport::async_rw::AsyncRwTransport;

use crate::failure::Failure;
use server::Server;

#[derive(Debug, clap::Args)]
#[command(
    after_help = "Tools: check, run, gap, study, explain, schema. They read files of this folder only and write no files.\n\
                  The assistant starts this command; its settings give the command and the folder."
)]
pub(crate) struct McpArgs {}

/// Answers requests until standard input ends.
pub(crate) fn mcp(_: &McpArgs) -> Result<(), Failure> {
    let problem = |error: &dyn std::fmt::Display| Failure::Analysis(format!("mcp: {error}"));
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .map_err(|error| problem(&error))?;
    let files = Files::beside(Path::new("")).confined(&[]);
    let served = runtime.block_on(async {
        let transport = AsyncRwTransport::new_server(tokio::io::stdin(), tokio::io::stdout());
        match Server::new(files).serve(transport).await {
            Ok(service) => service.waiting().await.map(drop).map_err(|e| problem(&e)),
            // Nobody spoke, or the other side went away.
            Err(ServerInitializeError::ConnectionClosed(_)) => Ok(()),
            Err(error) => Err(Failure::Input(format!(
                "mcp: {error}; standard input speaks the Model Context Protocol, one message of JSON-RPC a line"
            ))),
        }
    });
    // A run that is still going has nobody to tell.
    runtime.shutdown_background();
    served
}
