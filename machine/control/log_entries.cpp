// See log_entries.h.
#include "machine/control/log_entries.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <nlohmann/json.hpp>

namespace rung::control {

using nlohmann::json;

// ---- one entry -----------------------------------------------------------------------------------------------------

std::string textOf(const LogEntry& entry) {
  if (!entry.by) return entry.text;
  return entry.by->name + " (user " + std::to_string(entry.by->user) + ", process " +
         std::to_string(entry.by->process) + "): " + entry.text;
}

json jsonOf(const LogEntry& entry) {
  json out = {{"n", entry.number},
              {"kind", kLogKinds[static_cast<size_t>(entry.kind)]},
              {"came", entry.cameS},
              {"text", entry.text}};
  if (entry.key) out["key"] = {std::get<0>(*entry.key), std::get<1>(*entry.key), std::get<2>(*entry.key)};
  if (entry.wentS) out["went"] = *entry.wentS;
  if (entry.seenS) out["acknowledged"] = *entry.seenS;
  if (entry.times != 1) out["times"] = entry.times;
  if (entry.cut) out["cut"] = true;
  if (entry.by) out["by"] = {{"name", entry.by->name}, {"user", entry.by->user}, {"process", entry.by->process}};
  if (entry.place) {
    if (entry.place->rung != 0) out["rung"] = entry.place->rung;
    out["file"] = entry.place->file;
    out["line"] = entry.place->line;
  }
  return out;
}

namespace {

// Throws json::exception, or std::out_of_range for a kind that this version does not have. Files of messages that
// hosts kept before there were kinds have none.
LogKind kindOf(const json& line) {
  if (!line.contains("kind")) return line.contains("key") ? LogKind::Message : LogKind::Report;
  const std::string name = line.at("kind").get<std::string>();
  const auto* known = std::ranges::find(kLogKinds, name);
  if (known == std::end(kLogKinds)) throw std::out_of_range(name);
  return static_cast<LogKind>(known - std::begin(kLogKinds));
}

std::string lineOf(const LogEntry& entry) {
  return jsonOf(entry).dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

// Nothing: the text is not a line of a log.
std::optional<LogEntry> logEntryOf(std::string_view text) try {
  constexpr uint64_t kMostNumber = uint64_t{1} << 53;
  const json line = json::parse(text);
  LogEntry entry{.kind = kindOf(line), .text = line.at("text").get<std::string>()};
  entry.number = line.at("n").get<uint64_t>();
  if (entry.number == 0 || entry.number > kMostNumber) return std::nullopt;
  entry.cameS = line.at("came").get<int64_t>();
  if (line.contains("key")) entry.key = line["key"].get<LogEntry::Key>();
  if (line.contains("went")) entry.wentS = line["went"].get<int64_t>();
  if (line.contains("acknowledged")) entry.seenS = line["acknowledged"].get<int64_t>();
  if (line.contains("by"))
    entry.by = {.name = line["by"].at("name").get<std::string>(),
                .user = line["by"].at("user").get<uid_t>(),
                .process = line["by"].at("process").get<pid_t>()};
  if (line.contains("file"))
    entry.place = {.rung = line.value("rung", uint32_t{0}),
                   .file = line["file"].get<std::string>(),
                   .line = line.value("line", uint32_t{0})};
  entry.times = line.value("times", uint32_t{1});
  entry.cut = line.value("cut", false);
  entry.changed = false;
  return entry;
} catch (const std::exception&) {
  return std::nullopt;
}

// Cuts a text between two characters of UTF-8.
void cut(std::string& text) {
  constexpr std::string_view kCut = "…";
  if (text.size() <= LogEntries::kMostText) return;
  size_t end = LogEntries::kMostText - kCut.size();
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  text.replace(end, std::string::npos, kCut);
}

} // namespace

std::vector<size_t> readLogLines(std::string_view text, std::map<uint64_t, LogEntry>& entries) {
  std::vector<size_t> wrong;
  size_t number = 0;
  for (size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    ++number;
    if (end == at) continue;
    if (std::optional<LogEntry> entry = logEntryOf(text.substr(at, end - at)))
      entries.insert_or_assign(entry->number, std::move(*entry));
    else
      wrong.push_back(number);
  }
  return wrong;
}

// ---- all of them ---------------------------------------------------------------------------------------------------

LogEntry* LogEntries::find(uint64_t number) {
  const auto found = std::ranges::lower_bound(entries_, number, {}, &LogEntry::number);
  return found != entries_.end() && found->number == number ? &*found : nullptr;
}

LogEntry* LogEntries::lastOf(const LogEntry& like) {
  const auto found = std::find_if(entries_.rbegin(), entries_.rend(), [&](const LogEntry& entry) {
    return entry.kind == like.kind && entry.key == like.key && entry.text == like.text;
  });
  return found != entries_.rend() ? &*found : nullptr;
}

LogEntry& LogEntries::add(LogEntry entry) {
  entry.number = ++last_;
  entries_.push_back(std::move(entry));
  while (entries_.size() > kMost + shown_.size()) drop();
  change(entries_.back());
  return entries_.back();
}

// Drops the oldest entry that is on disk, or the oldest one if none is, but none of a message that is on.
void LogEntries::drop() {
  const auto isWritten = [&](const LogEntry& entry) { return !entry.changed && !isOn(entry); };
  auto oldest = std::ranges::find_if(entries_, isWritten);
  if (oldest == entries_.end()) {
    oldest = std::ranges::find_if(entries_, [&](const LogEntry& entry) { return !isOn(entry); });
    ++lost_;
  }
  entries_.erase(oldest);
}

void LogEntries::change(LogEntry& entry) {
  entry.version = ++version_;
  entry.changed = true;
  changed_ = true;
}

void LogEntries::come(const Key& key, const std::string& text, int64_t nowS, bool again) {
  LogEntry entry{.kind = LogKind::Message, .text = text, .key = key};
  cut(entry.text);
  entry.cameS = nowS;
  if (const auto on = shown_.find(key); on != shown_.end()) {
    if (find(on->second)->text == entry.text) return;
    go(key, nowS); // the text has changed
  }
  if (shown_.size() == kMostShown) return;
  LogEntry* former = again ? lastOf(entry) : nullptr;
  if (former != nullptr) {
    ++former->times;
    former->wentS.reset();
    former->seenS.reset();
    change(*former);
  }
  shown_[key] = former != nullptr ? former->number : add(std::move(entry)).number;
}

std::string LogEntries::go(const Key& key, int64_t nowS) {
  const auto on = shown_.find(key);
  if (on == shown_.end()) return {};
  LogEntry& gone = *find(on->second);
  shown_.erase(on);
  gone.wentS = nowS;
  change(gone);
  return gone.text;
}

std::vector<std::string> LogEntries::goAll(int64_t nowS) {
  std::vector<std::string> gone;
  while (!shown_.empty()) gone.push_back(go(Key(shown_.begin()->first), nowS));
  return gone;
}

void LogEntries::happen(LogEntry entry, int64_t nowS, bool again) {
  cut(entry.text);
  entry.cameS = nowS;
  if (LogEntry* former = again ? lastOf(entry) : nullptr) {
    ++former->times;
    change(*former);
  } else {
    add(std::move(entry));
  }
}

std::vector<std::string> LogEntries::acknowledge(int64_t nowS) {
  std::vector<std::string> texts;
  for (const auto& [key, number] : shown_) {
    LogEntry& on = *find(number);
    if (on.seenS) continue;
    on.seenS = nowS;
    change(on);
    texts.push_back(on.text);
  }
  return texts;
}

void LogEntries::end(int64_t nowS) {
  for (const auto& [key, number] : shown_) find(number)->cut = true;
  goAll(nowS);
}

std::vector<LogEntry> LogEntries::shown() const {
  std::vector<LogEntry> all;
  for (const LogEntry& entry : entries_)
    if (isOn(entry)) all.push_back(entry);
  std::ranges::sort(all, {}, &LogEntry::key);
  return all;
}

bool LogEntries::isOn(const LogEntry& entry) const {
  const auto on = entry.key ? shown_.find(*entry.key) : shown_.end();
  return on != shown_.end() && on->second == entry.number;
}

uint64_t LogEntries::takeLost() { return std::exchange(lost_, 0); }

// ---- lines ---------------------------------------------------------------------------------------------------------

bool LogEntries::mayBeWritten(const LogEntry& entry, int64_t nowS) {
  constexpr uint32_t kAtOnce = 2; // the appearance and the disappearance
  const int64_t since = nowS - entry.lineS;
  return entry.lines < kAtOnce || since >= kPauseS || since < 0;
}

void LogEntries::take(LogEntry& entry, bool isDue, Lines& lines) {
  if (isDue && std::exchange(entry.changed, false))
    lines.changed += lineOf(entry);
  else if (isOn(entry))
    lines.others += lineOf(entry);
}

LogEntries::Lines LogEntries::takeLines(int64_t nowS) {
  if (!changed_) return {};
  if (std::exchange(secondS_, nowS) != nowS) lines_ = 0;
  Lines lines;
  changed_ = false;
  for (LogEntry& entry : entries_) {
    const bool isDue = entry.changed && lines_ < kMostLines && mayBeWritten(entry, nowS);
    take(entry, isDue, lines);
    changed_ = changed_ || entry.changed;
    if (!isDue) continue;
    entry.lineS = nowS;
    ++entry.lines;
    ++lines_;
  }
  return lines;
}

LogEntries::Lines LogEntries::takeAll() {
  Lines lines;
  for (LogEntry& entry : entries_) take(entry, true, lines);
  changed_ = false;
  return lines;
}

size_t LogEntries::read(std::string_view text) {
  std::map<uint64_t, LogEntry> newest;
  const size_t wrong = readLogLines(text, newest).size();
  for (auto& [number, entry] : newest) {
    entry.cut = entry.cut || (entry.key && !entry.wentS);
    entries_.push_back(std::move(entry));
    if (entries_.size() > kMost) entries_.pop_front();
    last_ = number;
  }
  first_ = last_ + 1;
  return wrong;
}

} // namespace rung::control
