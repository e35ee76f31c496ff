// See messages.h.
#include "machine/control/messages.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "machine/control/plc_access.h"
#include "machine/control/turn.h"
#include "machine/control/values.h"

namespace rung::control {

using nlohmann::json;

namespace {

constexpr size_t kMostRecent = 200; // messages in an answer without the history

// Whether `messages` shows entries of this kind: what the operator sees, and what the program adds to the log.
bool isMessage(LogKind kind) { return kind <= LogKind::Report; }

json jsonOf(const LogEntries& log, const LogEntry& entry) {
  json out = control::jsonOf(entry);
  if (entry.key) out["on"] = log.isOn(entry);
  return out;
}

// The most recent messages, or all if `all` is set; those that are on are always included.
std::vector<LogEntry> wantedOf(const LogEntries& log, bool all) {
  std::vector<LogEntry> wanted;
  size_t recent = 0;
  for (const LogEntry& entry : log.entries()) recent += isMessage(entry.kind) && log.isNew(entry) ? 1 : 0;
  for (const LogEntry& entry : log.entries()) {
    if (!isMessage(entry.kind)) continue;
    const bool isRecent = log.isNew(entry) && recent-- <= kMostRecent;
    if (all || isRecent || log.isOn(entry)) wanted.push_back(entry);
  }
  return wanted;
}

std::string lineOf(int64_t seconds, const std::string& text) { return dateText(seconds) + " " + text; }

LogKind kindOf(host::Report::Kind kind) {
  switch (kind) {
  case host::Report::Kind::Fault: return LogKind::Fault;
  case host::Report::Kind::Restart: return LogKind::Restart;
  case host::Report::Kind::Other: break;
  }
  return LogKind::Report;
}

} // namespace

Messages::~Messages() { log_.end(); }

void Messages::gone(const Peer& peer) {
  std::erase(following_, peer.number);
  followingLog_.erase(peer.number);
}

// ---- requests ------------------------------------------------------------------------------------------------------

json Messages::messages(const Peer& peer, const json& request) {
  const bool all = flagOf(request, "history");
  if (flagOf(request, "follow") && std::ranges::find(following_, peer.number) == following_.end())
    following_.push_back(peer.number);
  json lines = json::array(), entries = json::array(), shown = json::array();
  for (const LogEntry& entry : wantedOf(log_.entries(), all)) {
    lines.push_back(lineOf(entry.cameS, entry.text));
    entries.push_back(jsonOf(log_.entries(), entry));
  }
  for (const LogEntry& entry : log_.entries().shown()) shown.push_back(entry.text);
  return {{"messages", lines}, {"entries", entries}, {"shown", shown}};
}

json Messages::acknowledge(const Peer& peer, const json&) {
  const std::vector<std::string> texts = log_.acknowledge();
  if (!texts.empty())
    log_.always({.kind = LogKind::Acknowledge, .text = "acknowledge " + joined(texts, ", "), .by = personOf(peer)});
  return {{"acknowledged", texts}};
}

json Messages::log(const Peer& peer, const json& request) {
  const LogEntries& log = log_.entries();
  if (flagOf(request, "follow")) followingLog_[peer.number] = log.version();
  json entries = json::array();
  for (const LogEntry& entry : log.entries()) entries.push_back(jsonOf(log, entry));
  json answer = {{"entries", entries}};
  if (log_.file() == nullptr) return answer;
  answer["file"] = log_.file()->path();
  if (!log_.file()->problem().empty()) answer["problem"] = log_.file()->problem();
  return answer;
}

// ---- turns ---------------------------------------------------------------------------------------------------------

void Messages::programRestarted(Sink* sink) {
  for (const std::string& text : log_.goAll()) tellFollowers(sink, "gone", text, false);
}

void Messages::work(Sink* sink) {
  passMessages(sink);
  if (const std::string problem = log_.tick(); !problem.empty()) report(problem, sink);
  if (sink != nullptr) sendEntries(*sink);
}

void Messages::passMessages(Sink* sink) {
  rung_message_info message{};
  for (int i = 0; i < turn::kMostMessages && plc_.nextMessage(message); ++i) pass(message, sink);
}

void Messages::pass(const rung_message_info& message, Sink* sink) {
  const LogEntry::Key key{message.number, message.channel, message.index};
  if (message.op == RUNG_MESSAGE_CLEAR) {
    if (const std::string text = log_.go(key); !text.empty()) tellFollowers(sink, "gone", text, false);
    return;
  }
  std::string text = std::string("message ") + message.text;
  while (text.ends_with(' ')) text.pop_back(); // after a number without a text
  const bool isLogged = message.op == RUNG_MESSAGE_LOG;
  if (isLogged)
    log_.add({.kind = LogKind::Note, .text = text});
  else
    log_.come(key, text);
  tellFollowers(sink, "message", text, isLogged);
}

void Messages::report(const host::Report& report, Sink* sink) {
  LogEntry entry{.kind = kindOf(report.kind), .text = report.text};
  if (report.kind == host::Report::Kind::Fault)
    entry.place = {.rung = report.rung, .file = report.file, .line = report.line};
  log_.add(std::move(entry));
  tellFollowers(sink, "message", report.text, false);
}

// `logged`: a message only for the log, not for the operator.
void Messages::tellFollowers(Sink* sink, const char* event, const std::string& text, bool logged) {
  if (sink == nullptr) return;
  const std::string line = lineOf(plc_.clock().dateS(), text);
  for (const uint32_t peer : following_) sink->send(peer, {{"event", event}, {"text", line}, {"logged", logged}});
}

// Sends the entries that are new or have changed, in the order of the changes.
void Messages::sendEntries(Sink& sink) {
  const LogEntries& log = log_.entries();
  for (auto& [peer, version] : followingLog_) {
    if (version == log.version()) continue;
    std::vector<const LogEntry*> changed;
    for (const LogEntry& entry : log.entries())
      if (entry.version > version) changed.push_back(&entry);
    std::ranges::sort(changed, {}, &LogEntry::version);
    for (const LogEntry* entry : changed) sink.send(peer, {{"event", "log"}, {"entry", jsonOf(log, *entry)}});
    version = log.version();
  }
}

} // namespace rung::control
