// The values of the pins of one connection between the thread that scans and the thread that serves the connection. A
// scan sees the values of one moment of the other side. Neither thread waits for the other, so the scan thread decides
// by itself when a connection counts as lost.
#pragma once
#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "machine/host/mapping_file.h"
#include "machine/host/pin_cell.h"
#include "machine/io/connections/triple_buffer.h"

namespace rung::io {

// Of a connection, as host::ConnectedPin; a number holds the value of a pin of every type.
struct ExchangedPin {
  host::ConnectedPin place;
  host::PinType type = host::PinType::Bit;
};

class Exchange {
public:
  Exchange(const host::File& map, const host::Connection& connection);

  // In the order of the map.
  const std::vector<ExchangedPin>& inputs() const noexcept { return inputs_; }
  const std::vector<ExchangedPin>& outputs() const noexcept { return outputs_; }
  int64_t timeoutNs() const noexcept { return timeoutNs_; }

  // ---- the scan thread; `pins` are the cells of File::pins

  // Before a step: the newest inputs, or their safe values where the other side has been silent for its time. `nowNs`
  // is of the monotonic clock.
  void readInputs(const host::PinCell* pins, int64_t nowNs) noexcept;
  // After a step, and before the first one.
  void writeOutputs(const host::PinCell* pins) noexcept;

  // ---- the thread of the connection

  // The other side was there at `nowNs`, and these are the inputs now.
  void publish(std::span<const double> inputs, int64_t nowNs) noexcept;
  // The newest outputs, until the next call.
  const std::vector<double>& newestOutputs() noexcept;

  // ---- any thread

  bool isAlive() const noexcept { return alive_.load(std::memory_order_relaxed); }
  uint64_t losses() const noexcept { return losses_.load(std::memory_order_relaxed); }
  uint64_t exchanges() const noexcept { return exchanges_.load(std::memory_order_relaxed); }

private:
  struct Heard {
    std::vector<double> values;
    int64_t atNs = 0;
    bool ever = false;
  };
  void setInputs(const host::PinCell* pins, bool alive) noexcept;

  std::vector<ExchangedPin> inputs_, outputs_;
  std::optional<uint32_t> statusPin_;
  int64_t timeoutNs_;
  TripleBuffer<Heard> heard_;
  TripleBuffer<std::vector<double>> said_;
  std::atomic<bool> alive_{false};
  std::atomic<uint64_t> losses_{0}, exchanges_{0};
};

} // namespace rung::io
