// The M, S, T, B and H functions that are in progress or queued for a program, and their state for the operator.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "machine/host/mapping_file.h"
#include "machine/host/pins.h"
#include "rung/runtime.h"

namespace rung::host {

struct FunctionState {
  static constexpr uint32_t kMost = 8;
  struct Function {
    rung_function_kind kind = RUNG_FUNCTION_M;
    uint32_t channel = 0; // from 0
    uint32_t code = 0;
    int64_t ageNs = 0;  // since the edge of its pin
    bool begun = false; // passed to the program; false: queued
    bool late = false;  // exceeds the timeout of the map
  };
  std::array<Function, kMost> oldest; // the oldest functions
  uint32_t count = 0;                 // number of all functions
  uint32_t lost = 0;                  // lost since the start
};

// Passes functions to a program that expects the handshake of its NC, while HAL only has levels: an edge of a pin
// queues a function, the dialect's handshake passes it to the program, and the acknowledge pin is switched on when the
// program has finished it; it is switched off together with the pin that caused the function.
//
// Functions of one kind and channel begin in the order of their edges. All other conditions are those of the dialect: a
// function begins as soon as the handshake accepts it.

class FunctionQueue {
public:
  static constexpr uint32_t kRoom = 64;

  // The instance must outlive the queue; its control must have the channels of all sends.
  FunctionQueue(const File& map, rung_instance* instance);

  // Scan thread, in every step: detects edges, and an abort, which empties the queue and ends the functions in
  // progress. `ns`: time since the last call.
  void sample(Pins& pins, int64_t ns) noexcept;
  // Scan thread, in every step while a fault has stopped the program: functions still wait.
  void age(int64_t ns) noexcept;
  // Scan thread, before every slice of the program: begins and ends functions.
  void advance(Pins& pins) noexcept;

  // The program is switched on again. All pins count as 0 before, as at the first start, so a pin that is on is an
  // edge.
  void restart() noexcept;

  // Whether a function is in progress or queued.
  bool busy() const noexcept { return count_ != 0; }
  // Whether a function has not finished within the timeout of the map since it was queued.
  bool late() const noexcept { return late_; }
  // Number of functions lost because the queue was full or because their code does not fit the dialect's signals. If
  // the level that caused one is still present when the queue has room again, the function is passed on then, because a
  // pair of functions that represents a level must end as the level does.
  uint32_t lost() const noexcept { return lost_; }
  FunctionState state() const noexcept;

private:
  struct Call {
    uint32_t send = 0;
    uint32_t code = 0;
    int64_t ageNs = 0;
    bool wanted = true;             // the pin still has the level that caused the function
    std::optional<uint32_t> handle; // handle of the handshake, once it has begun
  };

  bool triggered(const Edge& edge, const Pins& pins) const noexcept { return pins[edge.pin].bit == edge.rising; }
  Call callOf(uint32_t send, const Pins& pins) const noexcept;
  bool isLate(const Call& call) const noexcept { return timeoutNs_ != 0 && call.ageNs > timeoutNs_; }
  bool queue(Call call) noexcept; // false: the queue is full
  void withdraw(uint32_t send, Pins& pins) noexcept;
  void abort() noexcept;
  bool finish(const Call& call, Pins& pins) const noexcept;
  void start(uint32_t index) noexcept;

  rung_instance* instance_;
  std::vector<Send> sends_;
  std::vector<bool> wasTriggered_; // indexed as sends_
  std::vector<bool> owed_;         // indexed as sends_: the queue was full, and the cause is still present
  std::vector<Edge> aborts_;
  std::vector<bool> wasAborted_; // indexed as aborts_
  uint32_t channels_ = 0;        // channels below this number have sends
  int64_t timeoutNs_;            // 0: no timeout
  std::vector<Call> calls_;      // oldest first; room for kRoom
  uint32_t count_ = 0;
  uint32_t lost_ = 0;
  bool late_ = false;
};

} // namespace rung::host
