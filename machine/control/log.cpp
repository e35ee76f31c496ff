// Lines and their repetitions (see log.h).
#include "machine/control/log.h"

#include <algorithm>
#include <ctime>
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

bool Log::line(const std::string& text) {
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
