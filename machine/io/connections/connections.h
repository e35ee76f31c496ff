// Serves one connection on a thread of its own.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "machine/host/mapping_file.h"
#include "machine/host/pins.h"
#include "rtlib/core/handover.h"

namespace rung::io {

class Service {
public:
  virtual ~Service() = default;
  // Runs on that thread until `ending` is true; then sends the newest outputs a last time, if the other side is
  // connected.
  virtual void run(const std::atomic<bool>& ending) noexcept = 0;

  // The current problem, for users; "": none. Any thread except the scan thread.
  std::string problem() const {
    const std::lock_guard lock(mutex_);
    return problem_;
  }

protected:
  void setProblem(std::string text) {
    const std::lock_guard lock(mutex_);
    problem_ = std::move(text);
  }

private:
  mutable std::mutex mutex_;
  std::string problem_;
};

// The values of one connection's pins, exchanged between the scan thread and the thread of the connection. All inputs
// of a scan are from the same moment. Neither thread waits for the other, so the scan thread itself decides when a
// connection is lost.

// A pin of a connection; values of all types are exchanged as numbers of type double.
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

  // ---- scan thread; `pins` are the cells of File::pins

  // To be called before a step: sets the newest inputs, or their safe values if the other side has been silent for the
  // timeout. `nowNs`: time of the monotonic clock.
  void readInputs(const host::PinCell* pins, int64_t nowNs) noexcept;
  // To be called after each step, and before the first one.
  void writeOutputs(const host::PinCell* pins) noexcept;

  // ---- thread of the connection

  // The other side was connected at `nowNs` and has sent these inputs.
  void publish(std::span<const double> inputs, int64_t nowNs) noexcept;
  // The newest outputs; valid until the next call.
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
  core::Newest<Heard> heard_;
  core::Newest<std::vector<double>> said_;
  std::atomic<bool> alive_{false};
  std::atomic<uint64_t> losses_{0}, exchanges_{0};
};

// All connections of a mapping file, each served on a thread of its own.

struct Figures {
  std::string title; // "modbus-server 127.0.0.1:502"
  bool alive = false;
  uint64_t exchanges = 0; // number of received sets of inputs
  uint64_t losses = 0;    // number of times the connection was lost
  std::string problem;    // the current problem; "": none
};

class Connections {
public:
  // Servers listen, and memory is shared, from now on. Throws std::runtime_error if that is not possible.
  explicit Connections(const host::File& map);
  ~Connections() { end(); }
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;

  // Reports for the operator before the start.
  const std::vector<std::string>& warnings() const { return warnings_; }
  // To be called after the first `writeOutputs`.
  void start();
  // To be called after the last `writeOutputs`, whose outputs are still sent.
  void end();

  // Scan thread, before and after each step; `pins` are the cells of File::pins, `nowNs` is time of the monotonic
  // clock.
  void readInputs(const host::PinCell* pins, int64_t nowNs) noexcept;
  void writeOutputs(const host::PinCell* pins) noexcept;

  // Service thread: reports connections lost or restored since the last call.
  void report(const std::function<void(const std::string&)>& print);
  std::vector<Figures> figures() const;

private:
  struct Served {
    Served(const host::File& map, const host::Connection& connection);

    std::string title;
    Exchange exchange;
    std::unique_ptr<Service> service;
    std::thread thread;
    bool reported = false;  // value of `alive` when last reported
    bool explained = false; // its problem has been reported since then
  };

  std::vector<std::string> warnings_;
  std::list<Served> served_;
  std::atomic<bool> ending_{false};
};

} // namespace rung::io
