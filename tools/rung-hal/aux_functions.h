// Auxiliary functions (M, S, T) for programs that expect a code with a strobe and answer "finished", while HAL has
// levels: an edge of a pin queues a code; one function at a time goes through
//   code, strobe := 1 -> program: done = 1 -> strobe := 0 -> program: done = 0 -> code := 0 -> acknowledge pin := 1
// and the acknowledge pin falls with the pin that caused the function. One at a time, because the dialects' "finished"
// is common to all kinds of functions.
#pragma once
#include <cstdint>
#include <vector>

#include "rtlib/core/memory.h"
#include "tools/rung-hal/binding.h"
#include "tools/rung-hal/pin_cell.h"

namespace rung::hal {

class AuxFunctions {
public:
  static constexpr uint32_t kQueue = 64;

  AuxFunctions(std::vector<MapSend> sends, std::vector<Channel> channels);

  // In every call of the scan function: notices edges.
  void sample(const PinCell* pins) noexcept;
  // Before every slice of the program.
  void advance(const rt::Memory& memory, const PinCell* pins) noexcept;

  // Functions that found the queue full.
  uint32_t lost() const noexcept { return lost_; }

private:
  enum class Phase : uint8_t { Idle, Strobe, Release };
  struct Request {
    uint32_t send = 0;
    int32_t code = 0;
  };

  void queue(Request request) noexcept;
  bool triggered(const MapSend& send, const PinCell* pins) const noexcept { return *pins[send.pin].bit == send.rising; }

  std::vector<MapSend> sends_;
  std::vector<Channel> channels_;
  std::vector<bool> wasTriggered_;
  std::vector<Request> requests_; // ring
  uint32_t first_ = 0;
  uint32_t count_ = 0;
  uint32_t lost_ = 0;
  Phase phase_ = Phase::Idle;
  Request current_;
};

} // namespace rung::hal
