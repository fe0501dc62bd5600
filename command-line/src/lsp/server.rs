//! What the server does with each message.

use super::documents::Documents;
use super::layouts::Layouts;
use super::published::Published;
use super::questions::{Asked, Questions};
use super::root::Root;
use super::transport::{self, Incoming};
use super::uri;
use crate::Status;
use crate::read;
use autogen::lsp::lines::Lines;
use autogen::lsp::protocol::json_rpc::{Error, Id, RequestObject, ResponseObject};
use autogen::lsp::protocol::{
    CompletionOptions, CompletionRequest, Definition, DefinitionRequest, DidChangeTextDocumentParams,
    DidCloseTextDocumentParams, DidOpenTextDocumentParams, DocumentFormattingRequest, ErrorCodes,
    HoverRequest, InitializeRequest, InitializeResult, LspErrorCodes, LspNotificationMethod,
    LspRequestMethod, PositionEncodingKind, PrepareRenamePlaceholder, PrepareRenameRequest,
    ReferencesRequest, RenameOptions, RenameRequest, Request, ServerCapabilities, ServerInfo,
    ShutdownRequest, TextDocumentPositionParams, TextDocumentSyncKind, TextDocumentSyncOptions, TextEdit,
    Uri,
};
use autogen::source::FileId;
use autogen::spec::format::format;
use serde_json::{Value, json};
use std::collections::{BTreeMap, VecDeque};
use std::io::{self, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;

/// What follows from a message.
#[derive(Debug)]
pub enum Next {
    Ready,
    /// What is published may not hold any more.
    Changed,
    Ended(Status),
}

/// How far the client has brought the session.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Stage {
    Begun,
    Running,
    ShutDown,
}

#[derive(Debug)]
pub struct Server<W> {
    output: W,
    stage: Stage,
    documents: Documents,
    /// Those of the workspace.
    folders: Vec<PathBuf>,
    /// The client can be asked to tell of files that change on the disk.
    can_watch: bool,
    layouts: Layouts,
    published: Published,
    questions: Questions,
}

type Answer = Result<Value, Error>;

impl<W: Write> Server<W> {
    pub fn new(output: W) -> Self {
        Self {
            output,
            stage: Stage::Begun,
            documents: Documents::default(),
            folders: Vec::new(),
            can_watch: false,
            layouts: Layouts::default(),
            published: Published::default(),
            questions: Questions::default(),
        }
    }

    /// `waiting` are the messages behind this one: a request that one of them cancels is not begun.
    pub fn take(&mut self, message: Incoming, waiting: &VecDeque<Incoming>) -> io::Result<Next> {
        match message {
            Incoming::Request(request) => self.request(request, waiting),
            Incoming::Wrong(code, why) => {
                self.refuse(Id::Null, error(code, why))?;
                Ok(Next::Ready)
            }
            Incoming::Lost(why) => {
                self.refuse(Id::Null, error(ErrorCodes::ParseError, why))?;
                Ok(Next::Ended(Status::WrongInput))
            }
            Incoming::Answer => Ok(Next::Ready),
            Incoming::End => Ok(Next::Ended(self.end())),
        }
    }

    fn end(&self) -> Status {
        if self.stage == Stage::ShutDown { Status::Done } else { Status::WrongInput }
    }

    fn request(&mut self, request: RequestObject, waiting: &VecDeque<Incoming>) -> io::Result<Next> {
        let (method, id, params) = request.into_parts();
        let params = params.unwrap_or(Value::Null);
        let Some(id) = id else {
            if method == "initialized" && self.stage == Stage::Running && self.can_watch {
                self.send(&watch())?;
            }
            return Ok(self.notified(&method, params));
        };
        if waiting.iter().any(|other| cancels(other, &id)) {
            let cancelled = ErrorCodes::Custom(LspErrorCodes::RequestCancelled.into());
            self.refuse(id, error(cancelled, "cancelled"))?;
            return Ok(Next::Ready);
        }
        let answered = catch_unwind(AssertUnwindSafe(|| self.answer(&method, params)));
        let bug = || Err(error(ErrorCodes::InternalError, "this is a bug in autogen"));
        match answered.unwrap_or_else(|_| bug()) {
            Ok(result) => {
                self.send(&json!({"jsonrpc": "2.0", "id": id, "result": result}))?;
            }
            Err(why) => self.refuse(id, why)?,
        }
        Ok(Next::Ready)
    }

    fn answer(&mut self, method: &str, params: Value) -> Answer {
        let method = LspRequestMethod::from(method);
        match (self.stage, &method) {
            (Stage::Begun, LspRequestMethod::Initialize) => {
                self.stage = Stage::Running;
                self.folders = folders(&params);
                let watched = &params["capabilities"]["workspace"]["didChangeWatchedFiles"];
                self.can_watch = watched["dynamicRegistration"] == true;
                result::<InitializeRequest>(capabilities())
            }
            (Stage::Begun, _) => {
                Err(error(ErrorCodes::ServerNotInitialized, "`initialize` has to be the first request"))
            }
            (Stage::ShutDown, _) => {
                Err(error(ErrorCodes::InvalidRequest, "after `shutdown` only `exit` is allowed"))
            }
            (Stage::Running, LspRequestMethod::Initialize) => {
                Err(error(ErrorCodes::InvalidRequest, "`initialize` was already received"))
            }
            (Stage::Running, LspRequestMethod::Shutdown) => {
                self.stage = Stage::ShutDown;
                result::<ShutdownRequest>(())
            }
            (Stage::Running, _) => self.asked(method, params),
        }
    }

    fn asked(&mut self, method: LspRequestMethod, params: Value) -> Answer {
        match method {
            LspRequestMethod::TextDocumentFormatting => {
                let params = read_params::<DocumentFormattingRequest>(params)?;
                result::<DocumentFormattingRequest>(self.formatted(&params.text_document.uri))
            }
            LspRequestMethod::TextDocumentHover => {
                let params = read_params::<HoverRequest>(params)?;
                let (questions, asked, layouts) = self.at(&params.text_document_position_params);
                result::<HoverRequest>(questions.hover(&asked, layouts))
            }
            LspRequestMethod::TextDocumentDefinition => {
                let params = read_params::<DefinitionRequest>(params)?;
                let (questions, asked, layouts) = self.at(&params.text_document_position_params);
                let found = questions.definition(&asked, layouts);
                result::<DefinitionRequest>(found.map(|found| Definition::from(found).into()))
            }
            LspRequestMethod::TextDocumentReferences => {
                let params = read_params::<ReferencesRequest>(params)?;
                let (questions, asked, layouts) = self.at(&params.text_document_position_params);
                let found = questions.references(&asked, layouts, params.context.include_declaration);
                result::<ReferencesRequest>(Some(found))
            }
            LspRequestMethod::TextDocumentPrepareRename => {
                let params = read_params::<PrepareRenameRequest>(params)?;
                let (questions, asked, layouts) = self.at(&params.text_document_position_params);
                let (range, placeholder) = questions.renamed_at(&asked, layouts).map_err(refused)?;
                let found = PrepareRenamePlaceholder { range, placeholder };
                result::<PrepareRenameRequest>(Some(found.into()))
            }
            LspRequestMethod::TextDocumentRename => {
                let params = read_params::<RenameRequest>(params)?;
                let (questions, asked, layouts) = self.at(&params.text_document_position_params);
                let edit = questions.rename(&asked, layouts, &params.new_name).map_err(refused)?;
                result::<RenameRequest>(Some(edit))
            }
            LspRequestMethod::TextDocumentCompletion => {
                let params = read_params::<CompletionRequest>(params)?;
                let (questions, asked, layouts) = self.at(&params.text_document_position_params);
                result::<CompletionRequest>(Some(questions.completion(&asked, layouts).into()))
            }
            method => {
                let name = String::from(method);
                Err(error(ErrorCodes::MethodNotFound, format!("there is no method `{name}`")))
            }
        }
    }

    fn at<'a>(
        &'a mut self,
        place: &'a TextDocumentPositionParams,
    ) -> (&'a mut Questions, Asked<'a>, &'a mut Layouts) {
        let asked = Asked {
            documents: &self.documents,
            folders: &self.folders,
            uri: &place.text_document.uri,
            position: place.position,
        };
        (&mut self.questions, asked, &mut self.layouts)
    }

    /// Nothing is answered, not even if it is wrong.
    fn notified(&mut self, method: &str, params: Value) -> Next {
        let method = LspNotificationMethod::from(method);
        match (self.stage, method) {
            (_, LspNotificationMethod::Exit) => return Next::Ended(self.end()),
            (Stage::Running, LspNotificationMethod::TextDocumentDidOpen) => {
                let Ok(params) = serde_json::from_value::<DidOpenTextDocumentParams>(params) else {
                    return Next::Ready;
                };
                let opened = params.text_document;
                self.documents.open(opened.uri.clone(), opened.version, opened.text);
                self.note_layout(&opened.uri);
            }
            (Stage::Running, LspNotificationMethod::TextDocumentDidChange) => {
                let Ok(params) = serde_json::from_value::<DidChangeTextDocumentParams>(params) else {
                    return Next::Ready;
                };
                let document = params.text_document;
                let uri = document.text_document_identifier.uri;
                self.documents.change(&uri, document.version, params.content_changes);
            }
            (Stage::Running, LspNotificationMethod::TextDocumentDidClose) => {
                let Ok(params) = serde_json::from_value::<DidCloseTextDocumentParams>(params) else {
                    return Next::Ready;
                };
                if let Some(path) = self.documents.close(&params.text_document.uri) {
                    self.layouts.close(&path);
                }
            }
            // Another file may have changed on the disk.
            (Stage::Running, LspNotificationMethod::TextDocumentDidSave)
            | (Stage::Running, LspNotificationMethod::WorkspaceDidChangeWatchedFiles) => {}
            _ => return Next::Ready,
        }
        self.questions.forget();
        Next::Changed
    }

    /// What a layout names when it is opened is still known when it cannot be read.
    fn note_layout(&mut self, uri: &Uri) {
        let Some((path, document)) = self.documents.get(uri) else { return };
        let Some(text) = document.text.as_deref().filter(|_| path.extension().is_some_and(|e| e == "json"))
        else {
            return;
        };
        if self.layouts.is_layout(path, text) {
            self.layouts.open(path, text);
        }
    }

    /// Checks what is open, and tells the client what is new.
    pub fn publish(&mut self) -> io::Result<()> {
        let mut roots: BTreeMap<Root, Vec<PathBuf>> = BTreeMap::new();
        for (path, document) in self.documents.all() {
            let text = document.text.as_deref().unwrap_or_default();
            for root in Root::all(path, text, &mut self.layouts, &self.folders) {
                roots.entry(root).or_default().push(path.into());
            }
        }
        for message in self.published.renewed(&roots, &self.documents) {
            self.send(&message)?;
        }
        Ok(())
    }

    /// One edit of the whole text; none if it is formatted, nothing of a text with errors.
    fn formatted(&self, uri: &Uri) -> Option<Vec<TextEdit>> {
        let (path, document) = self.documents.get(uri)?;
        let text = document.text.as_ref().filter(|_| path.extension().is_some_and(|e| e == "aut"))?;
        let new_text = format(FileId(0), text).ok()?;
        let edit = TextEdit { range: Lines::new(text).whole(), new_text };
        Some(Some(edit).filter(|edit| edit.new_text != *text).into_iter().collect())
    }

    fn refuse(&mut self, id: Id, why: Error) -> io::Result<()> {
        let response = ResponseObject::from_error(id, why);
        self.send(&serde_json::to_value(response).unwrap_or_default())
    }

    fn send(&mut self, message: &Value) -> io::Result<()> {
        transport::write(&mut self.output, message)
    }
}

fn error(code: ErrorCodes, message: impl Into<String>) -> Error {
    Error { code, message: message.into(), data: None }
}

/// Why something cannot be renamed, for the user.
fn refused(why: String) -> Error {
    error(ErrorCodes::Custom(LspErrorCodes::RequestFailed.into()), why)
}

fn read_params<R: Request>(params: Value) -> Result<R::Params, Error> {
    serde_json::from_value(params).map_err(|why| error(ErrorCodes::InvalidParams, why.to_string()))
}

fn result<R: Request>(result: R::Result) -> Answer {
    serde_json::to_value(result).map_err(|why| error(ErrorCodes::InternalError, why.to_string()))
}

fn cancels(message: &Incoming, id: &Id) -> bool {
    let Incoming::Request(request) = message else { return false };
    let cancelled = request.params().and_then(|params| params.get("id"));
    request.method() == "$/cancelRequest"
        && cancelled.is_some_and(|other| serde_json::to_value(id).is_ok_and(|id| id == *other))
}

/// The folders that the client works in. Of what it says of itself nothing else matters here, so that no mistake
/// in it does.
fn folders(params: &Value) -> Vec<PathBuf> {
    let listed = params["workspaceFolders"].as_array().into_iter().flatten().map(|folder| &folder["uri"]);
    let uris = listed.chain([&params["rootUri"]]).filter_map(Value::as_str);
    uris.filter_map(|text| read::real(&uri::path(&text.into())?)).collect()
}

/// The client is to tell of all files that belong to lines, whoever changes them.
fn watch() -> Value {
    let watchers = json!([{"globPattern": "**/*.{aut,json,test}"}]);
    let registration = json!({
        "id": "files", "method": "workspace/didChangeWatchedFiles", "registerOptions": {"watchers": watchers},
    });
    json!({
        "jsonrpc": "2.0", "id": "watch", "method": "client/registerCapability",
        "params": {"registrations": [registration]},
    })
}

fn capabilities() -> InitializeResult {
    let sync = TextDocumentSyncOptions {
        open_close: Some(true),
        change: Some(TextDocumentSyncKind::Full),
        save: Some(true.into()),
        ..TextDocumentSyncOptions::default()
    };
    let rename = RenameOptions { prepare_provider: Some(true), ..RenameOptions::default() };
    let trigger_characters = Some(vec![".".into(), "\"".into()]);
    let completion = CompletionOptions { trigger_characters, ..CompletionOptions::default() };
    InitializeResult {
        capabilities: ServerCapabilities {
            position_encoding: Some(PositionEncodingKind::UTF16),
            text_document_sync: Some(sync.into()),
            document_formatting_provider: Some(true.into()),
            hover_provider: Some(true.into()),
            definition_provider: Some(true.into()),
            references_provider: Some(true.into()),
            rename_provider: Some(rename.into()),
            completion_provider: Some(completion),
            ..ServerCapabilities::default()
        },
        server_info: Some(ServerInfo {
            name: "autogen".into(),
            version: Some(env!("CARGO_PKG_VERSION").into()),
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::{Incoming, Next, Server};
    use crate::Status;
    use serde_json::{Value, json};
    use std::collections::VecDeque;

    fn message(json: Value) -> Incoming {
        Incoming::Request(serde_json::from_value(json).expect("a request"))
    }

    #[test]
    fn a_request_that_is_cancelled_while_it_waits_is_not_begun() {
        let request = |id| message(json!({"jsonrpc": "2.0", "id": id, "method": "initialize", "params": {}}));
        let cancel =
            |id| message(json!({"jsonrpc": "2.0", "method": "$/cancelRequest", "params": {"id": id}}));
        let mut server = Server::new(Vec::new());
        let waiting = VecDeque::from([cancel(json!(7)), cancel(json!("8"))]);
        for id in [json!(7), json!("8")] {
            server.take(request(id), &waiting).expect("an answer");
        }
        let text = String::from_utf8(std::mem::take(&mut server.output)).expect("text");
        assert_eq!(text.matches("\"code\":-32800").count(), 2, "{text}");
        // Another number, and a text that reads as one.
        server.take(request(json!("7")), &waiting).expect("an answer");
        let text = String::from_utf8(std::mem::take(&mut server.output)).expect("text");
        assert!(text.contains("\"capabilities\""), "{text}");
        let ended = server.take(Incoming::End, &waiting).expect("no answer");
        assert!(matches!(ended, Next::Ended(Status::WrongInput)), "{ended:?}");
    }
}
