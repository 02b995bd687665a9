//! What the protocol asks, and the answers of tools.

use std::sync::Arc;

use jostle_io::Files;
use rmcp::model::{
    CallToolRequestParams, CallToolResponse, CallToolResult, ContentBlock, ErrorData,
    Implementation, ListToolsResult, PaginatedRequestParams, ServerCapabilities, ServerConfig,
};
use rmcp::service::RequestContext;
use rmcp::{RoleServer, ServerHandler};
use tokio::sync::Mutex;

use super::tools::{TOOLS, Tool};

const INSTRUCTIONS: &str = "jostle simulates neighbouring buildings that hit each other during an earthquake (seismic pounding). \
Models are TOML files in the folder of this server, or text. Start with explain or schema to learn the keys, write a model, check it, then run it. \
Quantities carry units: \"220 cm/s2\", \"100 mm\". All results are in SI. One record is no basis for design.";

/// Answers requests of one assistant.
pub(super) struct Server {
    /// The folder that may be read.
    files: Files,
    /// One tool works at a time; runs use all processors themselves.
    working: Arc<Mutex<()>>,
}

impl Server {
    pub(super) fn new(files: Files) -> Self {
        Self {
            files,
            working: Arc::default(),
        }
    }
}

impl ServerHandler for Server {
    fn get_info(&self) -> ServerConfig {
        ServerConfig::new(ServerCapabilities::builder().enable_tools().build())
            .with_server_info(Implementation::new("jostle", env!("CARGO_PKG_VERSION")))
            .with_instructions(INSTRUCTIONS)
    }

    async fn list_tools(
        &self,
        _: Option<PaginatedRequestParams>,
        _: RequestContext<RoleServer>,
    ) -> Result<ListToolsResult, ErrorData> {
        let tools = TOOLS.iter().map(Tool::described).collect();
        Ok(ListToolsResult::with_all_items(tools))
    }

    async fn call_tool(
        &self,
        request: CallToolRequestParams,
        context: RequestContext<RoleServer>,
    ) -> Result<CallToolResponse, ErrorData> {
        let Some(tool) = TOOLS.iter().find(|tool| tool.name == request.name) else {
            let known: Vec<&str> = TOOLS.iter().map(|tool| tool.name).collect();
            return Err(ErrorData::invalid_params(
                format!(
                    "there is no tool {:?}; there are {}",
                    request.name,
                    known.join(", ")
                ),
                None,
            ));
        };
        let files = self.files.afresh();
        let arguments = request.arguments.unwrap_or_default();
        let cancelled = context.ct.clone();
        let turn = Arc::clone(&self.working).lock_owned().await;
        let work = tokio::task::spawn_blocking(move || {
            let _turn = turn;
            (tool.call)(&files, arguments.into(), &|| cancelled.is_cancelled())
        });
        let result = match work.await {
            Ok(Ok(text)) => CallToolResult::success(vec![said(&text)]),
            Ok(Err(failure)) => CallToolResult::error(vec![said(&failure.to_string())]),
            Err(error) => CallToolResult::error(vec![said(&format!(
                "jostle failed in {}: {error}; please report it with the model",
                tool.name
            ))]),
        };
        Ok(result.into())
    }
}

/// A text without colours.
fn said(text: &str) -> ContentBlock {
    ContentBlock::text(jostle_run::plain(text).trim_end())
}
