// The language server: requests and notifications of an editor, by the protocol of the same name, version 3.17.
#pragma once
#include <map>
#include <set>
#include <string>

#include "tools/lsp/features.h"
#include "tools/lsp/transport.h"
#include "tools/lsp/workspace.h"

namespace rung::lsp {

class Server {
public:
  Server(Transport& transport, std::string version) : transport_(transport), version_(std::move(version)) {}
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  // Until the editor says `exit` or is gone. The exit status of the protocol: 0 after `shutdown`, otherwise 1.
  int run();

private:
  using Handler = json (Server::*)(const json& params);
  struct Method {
    std::string_view name;
    Handler handler;
  };
  static const Method kRequests[];
  static const Method kNotifications[];

  void take(const std::string& message);
  void serve(const json& message);
  json answer(const std::string& method, const json& params);
  void notice(const std::string& method, const json& params);
  void send(const json& message);

  json initialize(const json& params);
  json shutdown(const json& params);
  json opened(const json& params);
  json changed(const json& params);
  json closed(const json& params);
  json saved(const json& params);

  json hoverAt(const json& params) { return hover(placeOf(params)); }
  json definitionAt(const json& params) { return definition(placeOf(params)); }
  json referencesAt(const json& params);
  json highlightsAt(const json& params) { return highlights(placeOf(params)); }
  json prepareRenameAt(const json& params) { return prepareRename(placeOf(params)); }
  json renameAt(const json& params);
  json completionAt(const json& params) { return completion(placeOf(params)); }
  json symbolsIn(const json& params);
  json symbolsOfAll(const json& params);
  json foldsIn(const json& params);
  json tokensIn(const json& params);
  json formatted(const json& params);
  json actionsAt(const json& params);
  json lensesIn(const json& params);
  json hintsIn(const json& params);

  // Throw RequestError for a file that no program has.
  Place placeOf(const json& params);
  std::pair<Program&, FileId> fileOf(const json& params);
  // The beginning and the end of its `range`.
  std::pair<Place, SourcePos> spanOf(const json& params);

  // Checks programs of open files while the editor says nothing.
  void checkWhileIdle();
  void publish(Program& program);

  Transport& transport_;
  std::string version_;
  Unit unit_ = Unit::Utf16;
  Workspace workspace_;
  std::map<std::string, json> versions_;               // of open files, by their paths
  std::set<std::string> unchecked_;                    // paths of open files
  std::map<std::string, uint64_t> published_;          // checks of a program, by its path
  std::map<std::string, std::set<std::string>> shown_; // files that have diagnostics of a program, by its path
  bool isInitialized_ = false;
  bool isShutDown_ = false;
  bool isOver_ = false;
};

} // namespace rung::lsp
