// What serves one connection, on a thread of its own.
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
  // On its thread, until `ending`; then the newest outputs go to the other side a last time, where it is there.
  virtual void run(const std::atomic<bool>& ending) noexcept = 0;

  // What has last gone wrong, for people; "" while nothing has. Any thread but the scan's.
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

// The values of the pins of one connection between the thread that scans and the thread that serves the connection. A
// scan sees the values of one moment of the other side. Neither thread waits for the other, so the scan thread decides
// by itself when a connection counts as lost.

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
  core::Newest<Heard> heard_;
  core::Newest<std::vector<double>> said_;
  std::atomic<bool> alive_{false};
  std::atomic<uint64_t> losses_{0}, exchanges_{0};
};

// All connections of a mapping file, each served on a thread of its own.

struct Figures {
  std::string title; // "modbus-server 127.0.0.1:502"
  bool alive = false;
  uint64_t exchanges = 0; // in which inputs came
  uint64_t losses = 0;    // how often it has been lost
  std::string problem;    // the last one; "" while there is none
};

class Connections {
public:
  // Servers listen, and memory is shared, from now on. Throws std::runtime_error where that cannot be.
  explicit Connections(const host::File& map);
  ~Connections() { end(); }
  Connections(const Connections&) = delete;
  Connections& operator=(const Connections&) = delete;

  // What an operator should know before it begins.
  const std::vector<std::string>& warnings() const { return warnings_; }
  // After the first `writeOutputs`.
  void start();
  // After the last one, which goes to the other sides.
  void end();

  // The thread that scans, before and after each step; `pins` are the cells of File::pins, `nowNs` of the monotonic
  // clock.
  void readInputs(const host::PinCell* pins, int64_t nowNs) noexcept;
  void writeOutputs(const host::PinCell* pins) noexcept;

  // For the thread that serves the host: what has been lost, or has come back, since the last call.
  void report(const std::function<void(const std::string&)>& print);
  std::vector<Figures> figures() const;

private:
  struct Served {
    Served(const host::File& map, const host::Connection& connection);

    std::string title;
    Exchange exchange;
    std::unique_ptr<Service> service;
    std::thread thread;
    bool reported = false;  // alive, the last time
    bool explained = false; // a problem has been reported since
  };

  std::vector<std::string> warnings_;
  std::list<Served> served_;
  std::atomic<bool> ending_{false};
};

} // namespace rung::io
