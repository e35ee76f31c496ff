// Entries and their lines.
#include "machine/control/history.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <exception>
#include <string_view>
#include <utility>

#include "rtlib/load/file.h"
#include "rtlib/run/realtime.h"

namespace rung::control {

using nlohmann::json;

History::Entry* History::find(uint64_t number) {
  const auto found = std::ranges::lower_bound(entries_, number, {}, &Entry::number);
  return found != entries_.end() && found->number == number ? &*found : nullptr;
}

History::Entry* History::lastOf(const Key& key, const std::string& text) {
  const auto found = std::find_if(entries_.rbegin(), entries_.rend(),
                                  [&](const Entry& entry) { return entry.key == key && entry.text == text; });
  return found != entries_.rend() ? &*found : nullptr;
}

History::Entry& History::add(Entry entry) {
  entry.number = ++last_;
  entries_.push_back(std::move(entry));
  if (entries_.size() > kMost) entries_.pop_front();
  changed_ = true;
  return entries_.back();
}

void History::change(Entry& entry) {
  entry.changed = true;
  changed_ = true;
}

void History::come(const Key& key, const std::string& text, int64_t nowS, bool again) {
  const auto on = shown_.find(key);
  if (on != shown_.end() && on->second.text == text) return;
  if (on != shown_.end()) go(key, nowS); // the text has changed
  if (shown_.size() == kMostShown) return;
  Entry* former = again ? lastOf(key, text) : nullptr;
  if (former != nullptr) {
    ++former->times;
    former->wentS.reset();
    change(*former);
  }
  shown_[key] = former != nullptr ? *former : add({.key = key, .text = text, .cameS = nowS});
}

std::string History::go(const Key& key, int64_t nowS) {
  const auto on = shown_.find(key);
  if (on == shown_.end()) return {};
  std::string text = std::move(on->second.text);
  Entry* entry = find(on->second.number);
  shown_.erase(on);
  if (entry == nullptr) return text;
  entry->wentS = nowS;
  change(*entry);
  return text;
}

std::vector<std::string> History::goAll(int64_t nowS) {
  std::vector<std::string> gone;
  while (!shown_.empty()) gone.push_back(go(Key(shown_.begin()->first), nowS));
  return gone;
}

void History::happen(const std::string& text, int64_t nowS) { add({.text = text, .cameS = nowS}); }

void History::end(int64_t nowS) {
  for (const auto& [key, on] : shown_)
    if (Entry* entry = find(on.number)) entry->cut = true;
  goAll(nowS);
}

std::vector<History::Entry> History::shown() const {
  std::vector<Entry> all;
  for (const auto& [key, entry] : shown_) all.push_back(entry);
  return all;
}

bool History::isOn(const Entry& entry) const {
  const auto on = entry.key ? shown_.find(*entry.key) : shown_.end();
  return on != shown_.end() && on->second.number == entry.number;
}

// ---- lines ---------------------------------------------------------------------------------------------------------

namespace {

std::string lineOf(const History::Entry& entry) {
  json line = {{"n", entry.number}, {"came", entry.cameS}, {"text", entry.text}};
  if (entry.key) line["key"] = {std::get<0>(*entry.key), std::get<1>(*entry.key), std::get<2>(*entry.key)};
  if (entry.wentS) line["went"] = *entry.wentS;
  if (entry.times != 1) line["times"] = entry.times;
  if (entry.cut) line["cut"] = true;
  return line.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

// Nothing: the text is not a line of an entry.
std::optional<History::Entry> entryOf(std::string_view text) try {
  const json line = json::parse(text);
  History::Entry entry{
      .number = line.at("n").get<uint64_t>(), .text = line.at("text"), .cameS = line.at("came").get<int64_t>()};
  if (line.contains("key")) entry.key = line["key"].get<History::Key>();
  if (line.contains("went")) entry.wentS = line["went"].get<int64_t>();
  entry.times = line.value("times", uint32_t{1});
  entry.cut = line.value("cut", false);
  entry.changed = false;
  return entry;
} catch (const json::exception&) {
  return std::nullopt;
}

} // namespace

bool History::mayBeWritten(const Entry& entry, int64_t nowS) const {
  constexpr uint32_t kAtOnce = 2; // the appearance and the disappearance
  const int64_t since = nowS - entry.lineS;
  return entry.changed && lines_ < kMostLines && (entry.lines < kAtOnce || since >= kPauseS || since < 0);
}

std::string History::takeLines(int64_t nowS) {
  if (!changed_) return {};
  if (std::exchange(secondS_, nowS) != nowS) lines_ = 0;
  std::string text;
  changed_ = false;
  for (Entry& entry : entries_) {
    if (mayBeWritten(entry, nowS)) {
      text += lineOf(entry);
      entry.changed = false;
      entry.lineS = nowS;
      ++entry.lines;
      ++lines_;
    }
    changed_ = changed_ || entry.changed;
  }
  return text;
}

std::string History::takeAll() {
  std::string text;
  for (Entry& entry : entries_) {
    text += lineOf(entry);
    entry.changed = false;
  }
  changed_ = false;
  return text;
}

bool History::read(const std::string& text) {
  bool good = true;
  std::map<uint64_t, Entry> newest;
  for (size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    std::optional<Entry> entry = end == at ? std::nullopt : entryOf(std::string_view(text).substr(at, end - at));
    if (entry)
      newest.insert_or_assign(entry->number, std::move(*entry));
    else
      good = good && end == at;
  }
  for (auto& [number, entry] : newest) {
    entry.cut = entry.cut || (entry.key && !entry.wentS);
    entries_.push_back(std::move(entry));
    if (entries_.size() > kMost) entries_.pop_front();
    last_ = number;
  }
  first_ = last_ + 1;
  return good;
}

// The thread that writes the file, and the choice between appending and replacing.

HistoryFile::HistoryFile(History& history, std::string path) : history_(history), path_(std::move(path)) {
  read();
  thread_ = std::thread([this] { work(); });
}

HistoryFile::~HistoryFile() {
  wait();
  give(history_.takeAll(), true);
  wait();
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

// An incomplete last line is the result of a crash; the first write removes it.
void HistoryFile::read() {
  std::string text, problem;
  if (!runtime::systemDisk().read(path_, 2 * kMostBytes, text, problem)) return;
  anew_ = true;
  size_ = text.size();
  const bool good = history_.read(text);
  if (problem.empty() && !good && text.ends_with('\n')) problem = "it has lines that do not belong to a history";
  if (!problem.empty()) failed_ = "cannot read " + path_ + ": " + problem;
}

std::string HistoryFile::tick(int64_t nowS) {
  if (busy()) return {};
  const bool fails = !failed_.empty();
  anew_ = anew_ || fails || size_ > kMostBytes;
  const bool isNew = problem_ != failed_;
  problem_ = failed_;
  if (!anew_ || !fails || nowS - triedS_ >= kRetryS || nowS < triedS_) {
    std::string text = anew_ ? history_.takeAll() : history_.takeLines(nowS);
    if (!text.empty()) give(std::move(text), std::exchange(anew_, false));
    triedS_ = nowS;
  }
  if (!isNew) return {};
  return problem_.empty() ? "the history of messages is kept again"
                          : "the history of messages is not kept: " + problem_;
}

bool HistoryFile::busy() const {
  const std::lock_guard lock(mutex_);
  return busy_;
}

void HistoryFile::wait() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return !busy_; });
}

void HistoryFile::give(std::string text, bool replaces) {
  {
    const std::lock_guard lock(mutex_);
    assert(!busy_);
    text_ = std::move(text);
    replaces_ = replaces;
    busy_ = true;
  }
  changed_.notify_all();
}

void HistoryFile::work() {
  runtime::becomeHelper();
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return busy_ || ending_; });
    if (!busy_) return;
    lock.unlock();
    failed_ = write();
    lock.lock();
    busy_ = false;
    changed_.notify_all();
  }
}

// A new file is also written by `replace`, which syncs its directory entry as well.
std::string HistoryFile::write() try {
  if (!replaces_ && size_ != 0) return append();
  std::string error;
  const auto* bytes = reinterpret_cast<const uint8_t*>(text_.data());
  if (runtime::systemDisk().replace(path_, {bytes, text_.size()}, error)) size_ = text_.size();
  return error;
} catch (const std::exception& thrown) { // out of memory
  return thrown.what();
}

std::string HistoryFile::append() {
  runtime::File file = runtime::openDiskFile(path_, O_WRONLY | O_APPEND);
  const bool good = file.ok() && runtime::writeAll(file.fd(), text_) && fdatasync(file.fd()) == 0 && file.close();
  if (!good) return "cannot write " + path_ + ": " + runtime::fileProblem(errno);
  size_ += text_.size();
  return {};
}

} // namespace rung::control
