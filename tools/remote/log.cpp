// Lines and their repetitions (see log.h).
#include "tools/remote/log.h"

#include <algorithm>
#include <ctime>
#include <iterator>

namespace rung::remote {

std::string dateText(int64_t seconds) {
  const auto time = static_cast<std::time_t>(seconds);
  std::tm parts{};
  localtime_r(&time, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S", &parts);
  return text;
}

namespace {

// What is quoted makes no lines of its own, and does nothing to a terminal.
std::string inOneLine(const std::string& text) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7F)
      out += c;
    else
      out.append("\\x") += {kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return out;
}

} // namespace

void Log::write(int64_t seconds, const std::string& text) { write_(dateText(seconds) + " " + inOneLine(text)); }

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

} // namespace rung::remote
