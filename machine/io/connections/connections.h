// All connections of a mapping file, each served on a thread of its own.
#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "machine/host/mapping_file.h"
#include "machine/host/pin_cell.h"
#include "machine/io/connections/exchange.h"
#include "machine/io/connections/service.h"

namespace rung::io {

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
