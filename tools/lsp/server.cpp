// See server.h.
#include "tools/lsp/server.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "tools/lsp/uri.h"

namespace rung::lsp {
namespace {

json errorAnswer(const json& id, ErrorCode code, const std::string& text) {
  return {{"jsonrpc", "2.0"}, {"id", id}, {"error", {{"code", static_cast<int>(code)}, {"message", text}}}};
}

std::string textIn(const json& object, const char* key) {
  const json& value = memberOf(object, key);
  if (!value.is_string()) throw RequestError(ErrorCode::InvalidParams, std::string(key) + " must be a text");
  return value.get<std::string>();
}

std::string pathIn(const json& params) { return pathOf(textIn(memberOf(params, "textDocument"), "uri")); }

// The first unit of the editor's list that the server has; UTF-16 if the editor has no list.
Unit unitFrom(const json& params) {
  const json none = json::array();
  const json& list = params.is_object() && params.contains("/capabilities/general/positionEncodings"_json_pointer)
                         ? params.at("/capabilities/general/positionEncodings"_json_pointer)
                         : none;
  for (const json& one : list) {
    if (one == "utf-8") return Unit::Utf8;
    if (one == "utf-16") return Unit::Utf16;
    if (one == "utf-32") return Unit::Utf32;
  }
  return Unit::Utf16;
}

const char* nameOf(Unit unit) {
  switch (unit) {
  case Unit::Utf8: return "utf-8";
  case Unit::Utf16: return "utf-16";
  case Unit::Utf32: break;
  }
  return "utf-32";
}

} // namespace

const Server::Method Server::kRequests[] = {
    {"initialize", [](Server& server, const json& params) { return server.initialize(params); }},
    {"shutdown", [](Server& server, const json&) { return server.shutdown(); }},
    {"textDocument/hover", [](Server& server, const json& params) { return hover(server.placeOf(params)); }},
    {"textDocument/definition", [](Server& server, const json& params) { return definition(server.placeOf(params)); }},
    {"textDocument/references",
     [](Server& server, const json& params) {
       return references(server.placeOf(params), memberOf(params, "context").value("includeDeclaration", true));
     }},
    {"textDocument/documentHighlight",
     [](Server& server, const json& params) { return highlights(server.placeOf(params)); }},
    {"textDocument/prepareRename",
     [](Server& server, const json& params) { return prepareRename(server.placeOf(params)); }},
    {"textDocument/rename",
     [](Server& server, const json& params) { return rename(server.placeOf(params), textIn(params, "newName")); }},
    {"textDocument/completion", [](Server& server, const json& params) { return completion(server.placeOf(params)); }},
    {"textDocument/documentSymbol",
     [](Server& server, const json& params) { return server.ofFile(params, documentSymbols); }},
    {"workspace/symbol",
     [](Server& server, const json& params) { return server.symbolsOfAll(textIn(params, "query")); }},
    {"textDocument/foldingRange",
     [](Server& server, const json& params) { return server.ofFile(params, foldingRanges); }},
    {"textDocument/semanticTokens/full",
     [](Server& server, const json& params) { return server.ofFile(params, semanticTokens); }},
    {"textDocument/formatting", [](Server& server, const json& params) { return server.ofFile(params, formatting); }},
    {"textDocument/codeLens", [](Server& server, const json& params) { return server.ofFile(params, codeLenses); }},
    {"textDocument/codeAction", [](Server& server, const json& params) { return server.ofSpan(params, codeActions); }},
    {"textDocument/inlayHint", [](Server& server, const json& params) { return server.ofSpan(params, inlayHints); }},
};

const Server::Notice Server::kNotices[] = {
    {"textDocument/didOpen", [](Server& server, const json& params) { server.opened(params); }},
    {"textDocument/didChange", [](Server& server, const json& params) { server.changed(params); }},
    {"textDocument/didClose", [](Server& server, const json& params) { server.closed(params); }},
    {"textDocument/didSave", [](Server& server, const json&) { server.checkAll(); }},
    {"workspace/didChangeWatchedFiles", [](Server& server, const json&) { server.checkAll(); }},
};

int Server::run() {
  while (!isOver_) {
    checkWhileIdle();
    const std::optional<std::string> message = transport_.read();
    if (!message) return 1;
    take(*message);
  }
  return isShutDown_ ? 0 : 1;
}

void Server::take(const std::string& message) {
  const json parsed = json::parse(message, nullptr, false);
  if (parsed.is_discarded()) return send(errorAnswer(nullptr, ErrorCode::ParseError, "the message is not JSON"));
  if (!parsed.is_object() || !parsed.contains("method") || !parsed["method"].is_string()) {
    if (!parsed.is_object() || !parsed.contains("id") || parsed.contains("method")) // otherwise an answer
      send(errorAnswer(nullptr, ErrorCode::InvalidRequest, "the message has no method"));
    return;
  }
  serve(parsed);
}

void Server::serve(const json& message) {
  const auto method = message["method"].get<std::string>();
  const json params = message.value("params", json());
  if (!message.contains("id")) return notice(method, params);
  const json& id = message["id"];
  try {
    send({{"jsonrpc", "2.0"}, {"id", id}, {"result", answer(method, params)}});
  } catch (const RequestError& error) {
    send(errorAnswer(id, error.code(), error.what()));
  } catch (const json::exception& error) {
    send(errorAnswer(id, ErrorCode::InvalidParams, error.what()));
  }
}

json Server::answer(const std::string& method, const json& params) {
  const auto found = std::ranges::find(kRequests, method, &Method::name);
  if (found == std::end(kRequests)) throw RequestError(ErrorCode::MethodNotFound, "unknown method " + method);
  if (isShutDown_) throw RequestError(ErrorCode::InvalidRequest, "the server was shut down");
  if (isInitialized_ == (method == "initialize"))
    throw RequestError(isInitialized_ ? ErrorCode::InvalidRequest : ErrorCode::NotInitialized,
                       isInitialized_ ? "the server is initialized" : "the first request must be initialize");
  return found->answer(*this, params);
}

// Notifications have no answer that could say what is wrong with them.
void Server::notice(const std::string& method, const json& params) {
  if (method == "exit") {
    isOver_ = true;
    return;
  }
  const auto found = std::ranges::find(kNotices, method, &Notice::name);
  if (found == std::end(kNotices) || !isInitialized_) return;
  try {
    found->take(*this, params);
  } catch (const RequestError&) {
  } catch (const json::exception&) {
  }
}

void Server::send(const json& message) {
  if (!transport_.write(message.dump(-1, ' ', false, json::error_handler_t::replace))) isOver_ = true;
}

json Server::initialize(const json& params) {
  unit_ = unitFrom(params);
  isInitialized_ = true;
  return {{"serverInfo", {{"name", "rungc lsp"}, {"version", version_}}},
          {"capabilities",
           {{"positionEncoding", nameOf(unit_)},
            {"textDocumentSync", {{"openClose", true}, {"change", 2}, {"save", true}}},
            {"hoverProvider", true},
            {"definitionProvider", true},
            {"referencesProvider", true},
            {"documentHighlightProvider", true},
            {"renameProvider", {{"prepareProvider", true}}},
            {"completionProvider", {{"triggerCharacters", {"[", "(", "{", "/", "@"}}}},
            {"documentSymbolProvider", true},
            {"workspaceSymbolProvider", true},
            {"foldingRangeProvider", true},
            {"semanticTokensProvider", {{"legend", semanticLegend()}, {"full", true}}},
            {"documentFormattingProvider", true},
            {"codeLensProvider", json::object()},
            {"inlayHintProvider", true},
            {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}}}}};
}

json Server::shutdown() {
  isShutDown_ = true;
  return nullptr;
}

void Server::opened(const json& params) {
  const json& document = memberOf(params, "textDocument");
  const std::string path = pathOf(textIn(document, "uri"));
  workspace_.open(path, textIn(document, "text"));
  versions_[path] = document.value("version", json());
  checkAll();
}

void Server::changed(const json& params) {
  const std::string path = pathIn(params);
  if (workspace_.textOf(path) == nullptr) throw RequestError(ErrorCode::InvalidParams, path + " is not open");
  versions_[path] = memberOf(params, "textDocument").value("version", json());
  for (const json& change : memberOf(params, "contentChanges")) {
    const std::string text = textIn(change, "text");
    if (!change.contains("range"))
      workspace_.open(path, text);
    else
      workspace_.change(path, rangeFrom(change["range"]), text, unit_);
  }
  checkAll();
}

void Server::closed(const json& params) {
  const std::string path = pathIn(params);
  workspace_.close(path);
  versions_.erase(path);
  checkAll();
}

// Files on the disk are others, or open texts are.
void Server::checkAll() {
  workspace_.changed();
  for (std::string& path : workspace_.openPaths()) unchecked_.insert(std::move(path));
}

std::pair<Program&, FileId> Server::fileOf(const json& params) {
  const std::string path = pathIn(params);
  Program& program = workspace_.programOf(path);
  const std::optional<FileId> file = program.fileOf(path);
  if (!file) throw RequestError(ErrorCode::RequestFailed, path + " is not a source of a program");
  return {program, *file};
}

Place Server::placeOf(const json& params) {
  const auto [program, file] = fileOf(params);
  return {program, file, posOf(program.sources(), file, positionFrom(memberOf(params, "position")), unit_), unit_};
}

json Server::ofFile(const json& params, json (*answer)(Program&, FileId, Unit)) {
  const auto [program, file] = fileOf(params);
  return answer(program, file, unit_);
}

json Server::ofSpan(const json& params, json (*answer)(const Place& begin, SourcePos end)) {
  const Range range = rangeFrom(memberOf(params, "range"));
  const auto [program, file] = fileOf(params);
  const SourceManager& sources = program.sources();
  return answer({program, file, posOf(sources, file, range.begin, unit_), unit_},
                posOf(sources, file, range.end, unit_));
}

json Server::symbolsOfAll(const std::string& query) {
  std::set<const Program*> seen;
  json list = json::array();
  for (const std::string& path : workspace_.openPaths()) {
    Program& program = workspace_.programOf(path);
    if (!seen.insert(&program).second) continue;
    for (json& symbol : workspaceSymbols(program, query, unit_)) list.push_back(std::move(symbol));
  }
  return list;
}

void Server::checkWhileIdle() {
  while (!unchecked_.empty() && !isOver_ && !transport_.hasInput()) {
    const std::string path = std::move(unchecked_.extract(unchecked_.begin()).value());
    if (workspace_.textOf(path) != nullptr) publish(workspace_.programOf(path));
  }
}

void Server::publish(Program& program) {
  if (std::exchange(published_[program.path()], program.checks()) == program.checks()) return;
  std::set<std::string>& shown = shown_[program.path()];
  std::map<std::string, json> now = diagnosticsOf(program, unit_);
  for (const std::string& path : shown) now.emplace(path, json::array());
  for (auto& [path, list] : now) {
    if (list.empty() && !shown.contains(path) && workspace_.textOf(path) == nullptr) continue;
    if (list.empty())
      shown.erase(path);
    else
      shown.insert(path);
    json params{{"uri", uriOf(path)}, {"diagnostics", std::move(list)}};
    if (const auto version = versions_.find(path); version != versions_.end()) params["version"] = version->second;
    send({{"jsonrpc", "2.0"}, {"method", "textDocument/publishDiagnostics"}, {"params", std::move(params)}});
  }
}

} // namespace rung::lsp
