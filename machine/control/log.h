// The log of a host: lines with their times. A line that is repeated is written a few times, and then only counted.
#pragma once
#include <cstdint>
#include <functional>
#include <list>
#include <string>

#include "rtlib/run/clock.h"

namespace rung::control {

// "2026-11-25 10:52:27", in local time.
std::string dateText(int64_t seconds);

// Service thread.
class Log {
public:
  using Write = std::function<void(const std::string& line)>;
  // The clock outlives the log.
  Log(runtime::Clock& clock, Write write) : clock_(clock), write_(std::move(write)) {}
  ~Log(); // writes the counts
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  // Writes a line. Returns false if the line was written so often within kPauseS that it is only counted.
  bool line(const std::string& text);
  // Writes a line even if it is repeated: for actions of users.
  void always(const std::string& text) { write(clock_.dateS(), text); }
  // Called in each turn: writes how often a line was counted, when it stops repeating, or after kPauseS.
  void tick() { settle(clock_.dateS()); }

  static constexpr uint32_t kMost = 5;   // how often a line is written
  static constexpr int64_t kPauseS = 10; // within this many seconds

private:
  struct Known {
    std::string text;
    int64_t firstS = 0;
    int64_t lastS = 0;
    uint32_t times = 0;   // repetitions since firstS
    uint32_t counted = 0; // of these, only counted
  };
  void write(int64_t seconds, const std::string& text);
  void settle(int64_t now);
  void writeCount(const Known& known);

  static constexpr size_t kKnown = 64; // number of texts remembered: the most recent ones

  runtime::Clock& clock_;
  Write write_;
  std::list<Known> known_; // most recent first
};

} // namespace rung::control
