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
  struct Method {
    std::string_view name;
    json (*answer)(Server& server, const json& params);
  };
  struct Notice {
    std::string_view name;
    void (*take)(Server& server, const json& params);
  };
  static const Method kRequests[];
  static const Notice kNotices[];

  void take(const std::string& message);
  void serve(const json& message);
  json answer(const std::string& method, const json& params);
  void notice(const std::string& method, const json& params);
  void send(const json& message);

  json initialize(const json& params);
  json shutdown();
  json symbolsOfAll(const std::string& query);
  void opened(const json& params);
  void changed(const json& params);
  void closed(const json& params);
  void checkAll();

  // Throw RequestError for a file that no program has.
  Place placeOf(const json& params);
  std::pair<Program&, FileId> fileOf(const json& params);
  json ofFile(const json& params, json (*answer)(Program& program, FileId file, Unit unit));
  // With the beginning and the end of its `range`.
  json ofSpan(const json& params, json (*answer)(const Place& begin, SourcePos end));

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
