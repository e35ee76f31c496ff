// What an operator wants to know of the M, S and T functions that are on their way to a program.
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
    int64_t ageNs = 0;  // since its pin caused it
    bool begun = false; // the program has it; else it waits for its turn
    bool late = false;  // it takes longer than the map's time
  };
  std::array<Function, kMost> oldest; // the first of them
  uint32_t count = 0;                 // of all
  uint32_t lost = 0;                  // since the start
};

// M, S and T functions for programs that expect the handshake of their NC, while HAL has levels: an edge of a pin
// queues a function, the dialect's handshake hands it to the program, and the acknowledge pin comes on when the program
// has finished it; it falls with the pin that caused the function.
//
// Functions of one kind and channel begin in their order. What else they wait for is the dialect's rule: a function
// begins as soon as the handshake takes it.

class FunctionQueue {
public:
  static constexpr uint32_t kRoom = 64;

  // The control of the instance, which outlives the queue, has the channels of all sends.
  FunctionQueue(const File& map, rung_instance* instance);

  // In every call of the scan function: notices edges, and an abort, which empties the queue and ends what the program
  // was doing. `ns`: time since the last call.
  void sample(Pins& pins, int64_t ns) noexcept;
  // Before every slice of the program.
  void advance(Pins& pins) noexcept;

  // The program is switched on anew. All pins count as 0 before, as at the first start: what is on already is an edge.
  void restart() noexcept;

  // A function was handed over, or waits.
  bool busy() const noexcept { return count_ != 0; }
  // One has not been finished within the map's time since it was queued.
  bool late() const noexcept { return late_; }
  // Functions that found the queue full, and those whose code the dialect's signals do not hold. Where the level that
  // caused one is still there when the queue has room, it is handed over then: what a pair of functions makes of a
  // level ends as the level does.
  uint32_t lost() const noexcept { return lost_; }
  FunctionState state() const noexcept;

private:
  struct Call {
    uint32_t send = 0;
    uint32_t code = 0;
    int64_t ageNs = 0;
    bool wanted = true;           // the pin has kept the level that caused it
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
  std::vector<bool> owed_;         // by sends_: it found the queue full, and its cause is still there
  std::vector<Edge> aborts_;
  std::vector<bool> wasAborted_; // by aborts_
  uint32_t channels_ = 0;        // that sends are for: those below this number
  int64_t timeoutNs_;            // 0: none
  std::vector<Call> calls_;      // the oldest first; room for kRoom
  uint32_t count_ = 0;
  uint32_t lost_ = 0;
  bool late_ = false;
};

} // namespace rung::host
