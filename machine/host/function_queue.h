// The M, S, T, B and H functions that are on their way to a program, and their state for the operator.
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
    bool begun = false; // the program has it; false: it waits for its turn
    bool late = false;  // it takes longer than the timeout of the map
  };
  std::array<Function, kMost> oldest; // the oldest functions
  uint32_t count = 0;                 // number of all functions
  uint32_t lost = 0;                  // lost since the start
};

// Passes functions to a program that expects the handshake of its NC, while HAL only has levels: an edge of a pin
// queues a function, the dialect's handshake passes it to the program, and the acknowledge pin is switched on when the
// program has finished it; it is switched off together with the pin that caused the function.
//
// Functions of one kind and channel begin in their order. What else they wait for is the dialect's rule: a function
// begins as soon as the handshake takes it.

class FunctionQueue {
public:
  static constexpr uint32_t kRoom = 64;

  // The instance outlives the queue; its control has the channels of all sends.
  FunctionQueue(const File& map, rung_instance* instance);

  // In every step: detects edges, and an abort, which empties the queue and ends the functions in progress. `ns`: time
  // since the last call.
  void sample(Pins& pins, int64_t ns) noexcept;
  // Before every slice of the program: begins and ends functions.
  void advance(Pins& pins) noexcept;

  // The program is switched on again. All pins count as 0 before, as at the first start, so a pin that is on is an
  // edge.
  void restart() noexcept;

  // Whether a function is in progress or waits.
  bool busy() const noexcept { return count_ != 0; }
  // Whether a function has not finished within the timeout of the map since it was queued.
  bool late() const noexcept { return late_; }
  // The number of functions that found the queue full, and of those whose code does not fit the dialect's signals. If
  // the level that caused one is still there when the queue has room again, it is passed on then, because a pair of
  // functions that represents a level must end as the level does.
  uint32_t lost() const noexcept { return lost_; }
  FunctionState state() const noexcept;

private:
  struct Call {
    uint32_t send = 0;
    uint32_t code = 0;
    int64_t ageNs = 0;
    bool wanted = true;           // the pin still has the level that caused it
    std::optional<uint32_t> line; // of the handshake, once it has begun
  };

  bool triggered(const Edge& edge, const Pins& pins) const noexcept { return pins[edge.pin].bit == edge.rising; }
  Call callOf(uint32_t send, const Pins& pins) const noexcept;
  bool isLate(const Call& call) const noexcept { return timeoutNs_ != 0 && call.ageNs > timeoutNs_; }
  bool queue(Call call) noexcept; // false: it found the queue full
  void withdraw(uint32_t send, Pins& pins) noexcept;
  void abort() noexcept;
  bool finish(const Call& call, Pins& pins) const noexcept;
  void start(uint32_t index) noexcept;

  rung_instance* instance_;
  std::vector<Send> sends_;
  std::vector<bool> wasTriggered_; // by sends_
  std::vector<bool> owed_;         // by sends_: found the queue full, and its cause is still there
  std::vector<Edge> aborts_;
  std::vector<bool> wasAborted_; // by aborts_
  uint32_t channels_ = 0;        // channels below this number have sends
  int64_t timeoutNs_;            // 0: none
  std::vector<Call> calls_;      // oldest first; room for kRoom
  uint32_t count_ = 0;
  uint32_t lost_ = 0;
  bool late_ = false;
};

} // namespace rung::host
