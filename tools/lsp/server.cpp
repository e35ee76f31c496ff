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

const json& member(const json& object, const char* key) {
  const auto found = object.is_object() ? object.find(key) : object.end();
  if (!object.is_object() || found == object.end())
    throw RequestError(ErrorCode::InvalidParams, std::string("there is no ") + key);
  return *found;
}

std::string textIn(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_string()) throw RequestError(ErrorCode::InvalidParams, std::string(key) + " must be a text");
  return value.get<std::string>();
}

std::string pathIn(const json& params) { return pathOf(textIn(member(params, "textDocument"), "uri")); }

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
    {"initialize", &Server::initialize},
    {"shutdown", &Server::shutdown},
    {"textDocument/hover", &Server::hoverAt},
    {"textDocument/definition", &Server::definitionAt},
    {"textDocument/references", &Server::referencesAt},
    {"textDocument/documentHighlight", &Server::highlightsAt},
    {"textDocument/prepareRename", &Server::prepareRenameAt},
    {"textDocument/rename", &Server::renameAt},
    {"textDocument/completion", &Server::completionAt},
    {"textDocument/documentSymbol", &Server::symbolsIn},
    {"workspace/symbol", &Server::symbolsOfAll},
    {"textDocument/foldingRange", &Server::foldsIn},
    {"textDocument/semanticTokens/full", &Server::tokensIn},
    {"textDocument/formatting", &Server::formatted},
    {"textDocument/codeAction", &Server::actionsAt},
    {"textDocument/codeLens", &Server::lensesIn},
    {"textDocument/inlayHint", &Server::hintsIn},
};

const Server::Method Server::kNotifications[] = {
    {"textDocument/didOpen", &Server::opened},           {"textDocument/didChange", &Server::changed},
    {"textDocument/didClose", &Server::closed},          {"textDocument/didSave", &Server::saved},
    {"workspace/didChangeWatchedFiles", &Server::saved},
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
  if (found == std::end(kRequests)) throw RequestError(ErrorCode::MethodNotFound, "there is no method " + method);
  if (isShutDown_) throw RequestError(ErrorCode::InvalidRequest, "the server was shut down");
  if (isInitialized_ == (method == "initialize"))
    throw RequestError(isInitialized_ ? ErrorCode::InvalidRequest : ErrorCode::NotInitialized,
                       isInitialized_ ? "the server is initialized" : "the first request must be initialize");
  return (this->*found->handler)(params);
}

// Notifications have no answer that could say what is wrong with them.
void Server::notice(const std::string& method, const json& params) {
  if (method == "exit") {
    isOver_ = true;
    return;
  }
  const auto found = std::ranges::find(kNotifications, method, &Method::name);
  if (found == std::end(kNotifications) || !isInitialized_) return;
  try {
    (this->*found->handler)(params);
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

json Server::shutdown(const json& /*params*/) {
  isShutDown_ = true;
  return nullptr;
}

json Server::opened(const json& params) {
  const json& document = member(params, "textDocument");
  const std::string path = pathOf(textIn(document, "uri"));
  workspace_.open(path, textIn(document, "text"));
  versions_[path] = document.value("version", json());
  return saved(params);
}

json Server::changed(const json& params) {
  const std::string path = pathIn(params);
  if (workspace_.textOf(path) == nullptr) throw RequestError(ErrorCode::InvalidParams, path + " is not open");
  versions_[path] = member(params, "textDocument").value("version", json());
  for (const json& change : member(params, "contentChanges")) {
    const std::string text = textIn(change, "text");
    if (!change.contains("range"))
      workspace_.open(path, text);
    else
      workspace_.change(path, rangeFrom(change["range"]), text, unit_);
  }
  return saved(params);
}

json Server::closed(const json& params) {
  const std::string path = pathIn(params);
  workspace_.close(path);
  versions_.erase(path);
  return saved(params);
}

// Files on the disk are others, or open texts are.
json Server::saved(const json& /*params*/) {
  workspace_.changed();
  for (std::string& path : workspace_.openPaths()) unchecked_.insert(std::move(path));
  return nullptr;
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
  return {program, file, posOf(program.sources(), file, positionFrom(member(params, "position")), unit_), unit_};
}

json Server::referencesAt(const json& params) {
  const json& context = member(params, "context");
  return references(placeOf(params), context.value("includeDeclaration", true));
}

json Server::renameAt(const json& params) { return rename(placeOf(params), textIn(params, "newName")); }

json Server::symbolsIn(const json& params) {
  const auto [program, file] = fileOf(params);
  return documentSymbols(program, file, unit_);
}

json Server::symbolsOfAll(const json& params) {
  const std::string query = textIn(params, "query");
  std::set<const Program*> seen;
  json list = json::array();
  for (const std::string& path : workspace_.openPaths()) {
    Program& program = workspace_.programOf(path);
    if (!seen.insert(&program).second) continue;
    for (json& symbol : workspaceSymbols(program, query, unit_)) list.push_back(std::move(symbol));
  }
  return list;
}

json Server::foldsIn(const json& params) {
  const auto [program, file] = fileOf(params);
  return foldingRanges(program, file);
}

json Server::tokensIn(const json& params) {
  const auto [program, file] = fileOf(params);
  return semanticTokens(program, file, unit_);
}

json Server::formatted(const json& params) {
  const auto [program, file] = fileOf(params);
  return formatting(program, file, unit_);
}

std::pair<Place, SourcePos> Server::spanOf(const json& params) {
  const Range range = rangeFrom(member(params, "range"));
  const auto [program, file] = fileOf(params);
  const SourceManager& sources = program.sources();
  return {{program, file, posOf(sources, file, range.begin, unit_), unit_}, posOf(sources, file, range.end, unit_)};
}

json Server::actionsAt(const json& params) {
  const auto [begin, end] = spanOf(params);
  return codeActions(begin, end);
}

json Server::hintsIn(const json& params) {
  const auto [begin, end] = spanOf(params);
  return inlayHints(begin, end);
}

json Server::lensesIn(const json& params) {
  const auto [program, file] = fileOf(params);
  return codeLenses(program, file, unit_);
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
