// The lines that a host writes, each with its time. What comes again and again is written a few times, and then
// counted.
#pragma once
#include <cstdint>
#include <functional>
#include <list>
#include <string>

#include "rtlib/run/clock.h"

namespace rung::control {

// "2026-11-25 10:52:27", of the place of the machine.
std::string dateText(int64_t seconds);

// For one thread.
class Log {
public:
  using Write = std::function<void(const std::string& line)>;
  // The clock outlives it.
  Log(runtime::Clock& clock, Write write) : clock_(clock), write_(std::move(write)) {}
  ~Log(); // what was counted is written
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;

  // False: it has been written so often within kPauseS that it is counted alone.
  bool line(const std::string& text);
  // Written, however often it comes: what a person does.
  void always(const std::string& text) { write(clock_.dateS(), text); }
  // From time to time: writes how often a line has come that does not come any more, or has been counted for kPauseS.
  void tick() { settle(clock_.dateS()); }

  static constexpr uint32_t kMost = 5;   // times that a line is written
  static constexpr int64_t kPauseS = 10; // in so many seconds

private:
  struct Known {
    std::string text;
    int64_t firstS = 0;
    int64_t lastS = 0;
    uint32_t times = 0;   // since the first
    uint32_t counted = 0; // of these, not written
  };
  void write(int64_t seconds, const std::string& text);
  void settle(int64_t now);
  void writeCount(const Known& known);

  static constexpr size_t kKnown = 64; // texts, those that have come last

  runtime::Clock& clock_;
  Write write_;
  std::list<Known> known_; // the one that has come last is the first
};

} // namespace rung::control
