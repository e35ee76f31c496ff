// Lines and their repetitions (see log.h).
#include "machine/control/log.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <iterator>

#include "rtlib/text/controls.h"

namespace rung::control {

std::string dateText(int64_t seconds) {
  const auto time = static_cast<std::time_t>(seconds);
  std::tm parts{};
  localtime_r(&time, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &parts);
  return text;
}

void Log::write(int64_t seconds, const std::string& line) {
  write_(dateText(seconds) + " " + text::withoutControls(line));
}

Log::~Log() {
  for (const Known& known : known_) writeCount(known);
}

void Log::keep(const std::string& path, uint64_t mostBytes) {
  file_ = std::make_unique<LogFile>(entries_, std::filesystem::absolute(path).string(), mostBytes);
}

void Log::keepBeside(const std::string& retained, uint64_t mostBytes) {
  keep(retained + ".log", mostBytes);
  const std::string former = retained + ".messages";
  if (std::filesystem::exists(former))
    always(former + ", the messages of an earlier version, is not continued; `rungctl log FILE` shows it");
}

bool Log::add(LogEntry entry) {
  const bool isNew = writeRepeated(textOf(entry));
  entries_.happen(std::move(entry), clock_.dateS(), !isNew);
  return isNew;
}

void Log::always(LogEntry entry) {
  const int64_t now = clock_.dateS();
  write(now, textOf(entry));
  entries_.happen(std::move(entry), now);
}

bool Log::come(const LogEntry::Key& key, const std::string& text) {
  const bool isNew = writeRepeated(text);
  entries_.come(key, text, clock_.dateS(), !isNew);
  return isNew;
}

std::string Log::tick() {
  const int64_t now = clock_.dateS();
  settle(now);
  return file_ == nullptr ? "" : file_->tick(now);
}

// Returns false if the line is only counted.
bool Log::writeRepeated(const std::string& text) {
  const int64_t now = clock_.dateS();
  settle(now);
  auto known = std::ranges::find(known_, text, &Known::text);
  if (known == known_.end()) {
    if (known_.size() == kKnown) {
      writeCount(known_.back());
      known_.pop_back();
    }
    known = known_.insert(known_.begin(), {.text = text, .firstS = now});
  } else {
    known_.splice(known_.begin(), known_, known);
  }
  known->lastS = now;
  if (++known->times > kMost) return ++known->counted, false;
  write(now, text);
  return true;
}

void Log::settle(int64_t now) {
  for (auto known = known_.begin(); known != known_.end();) {
    const bool over = now - known->firstS >= kPauseS || now < known->firstS;
    if (over) writeCount(*known);
    known = over ? known_.erase(known) : std::next(known);
  }
}

void Log::writeCount(const Known& known) {
  if (known.counted == 0) return;
  write(known.lastS,
        known.text + " (" + std::to_string(known.counted) + " times more since " + dateText(known.firstS) + ")");
}

} // namespace rung::control
