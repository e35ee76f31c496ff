// See messages.h.
#include "machine/control/messages.h"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "machine/control/turn.h"
#include "machine/control/values.h"

namespace rung::control {

using nlohmann::json;

namespace {

constexpr size_t kMostRecent = 200; // messages in an answer without the history

json jsonOf(const History& history, const History::Entry& entry) {
  json out = {{"text", entry.text}, {"came", entry.cameS}, {"on", history.isOn(entry)}};
  out["kind"] = entry.key ? "message" : "event";
  if (entry.wentS) out["went"] = *entry.wentS;
  if (entry.times != 1) out["times"] = entry.times;
  if (entry.cut) out["cut"] = true;
  return out;
}

// The most recent entries, or all if `all` is set; messages that are on are always included.
std::vector<History::Entry> wantedOf(const History& history, bool all) {
  std::vector<History::Entry> wanted;
  size_t recent = 0;
  for (const History::Entry& entry : history.shown())
    if (history.entries().empty() || entry.number < history.entries().front().number) wanted.push_back(entry);
  for (const History::Entry& entry : history.entries()) recent += history.isNew(entry) ? 1 : 0;
  for (const History::Entry& entry : history.entries()) {
    const bool isRecent = history.isNew(entry) && recent-- <= kMostRecent;
    if (all || isRecent || history.isOn(entry)) wanted.push_back(entry);
  }
  return wanted;
}

std::string lineOf(int64_t seconds, const std::string& text) { return dateText(seconds) + " " + text; }

} // namespace

Messages::~Messages() { history_.end(plc_.clock().dateS()); }

json Messages::messages(const Peer& peer, const json& request) {
  const bool all = flagOf(request, "history");
  if (flagOf(request, "follow") && std::ranges::find(following_, peer.number) == following_.end())
    following_.push_back(peer.number);
  json lines = json::array(), entries = json::array(), shown = json::array();
  for (const History::Entry& entry : wantedOf(history_, all)) {
    lines.push_back(lineOf(entry.cameS, entry.text));
    entries.push_back(jsonOf(history_, entry));
  }
  for (const History::Entry& entry : history_.shown()) shown.push_back(entry.text);
  return {{"messages", lines}, {"entries", entries}, {"shown", shown}};
}

void Messages::programRestarted(Sink* sink) {
  for (const std::string& text : history_.goAll(plc_.clock().dateS())) tellFollowers(sink, "gone", text, false);
}

void Messages::work(Sink* sink) {
  passMessages(sink);
  writeHistory(sink);
  log_.tick();
}

void Messages::writeHistory(Sink* sink) {
  const std::string problem = historyFile_ == nullptr ? "" : historyFile_->tick(plc_.clock().dateS());
  if (!problem.empty()) report(problem, sink);
}

void Messages::passMessages(Sink* sink) {
  rung_message_info message{};
  for (int i = 0; i < turn::kMostMessages && plc_.nextMessage(message); ++i) pass(message, sink);
}

void Messages::pass(const rung_message_info& message, Sink* sink) {
  const History::Key key{message.number, message.channel, message.index};
  const int64_t now = plc_.clock().dateS();
  if (message.op == RUNG_MESSAGE_CLEAR) {
    if (const std::string text = history_.go(key, now); !text.empty()) tellFollowers(sink, "gone", text, false);
    return;
  }
  std::string text = std::string("message ") + message.text;
  while (text.ends_with(' ')) text.pop_back(); // after a number without a text
  const bool isNew = log_.line(text);
  const bool isLogged = message.op == RUNG_MESSAGE_LOG;
  if (!isLogged)
    history_.come(key, text, now, !isNew);
  else if (isNew)
    history_.happen(text, now);
  tellFollowers(sink, "message", text, isLogged);
}

void Messages::report(const std::string& text, Sink* sink) {
  if (log_.line(text)) history_.happen(text, plc_.clock().dateS());
  tellFollowers(sink, "message", text, false);
}

// `logged`: a message only for the log, not for the operator.
void Messages::tellFollowers(Sink* sink, const char* event, const std::string& text, bool logged) {
  if (sink == nullptr) return;
  const std::string line = lineOf(plc_.clock().dateS(), text);
  for (const uint32_t peer : following_) sink->send(peer, {{"event", event}, {"text", line}, {"logged", logged}});
}

} // namespace rung::control
