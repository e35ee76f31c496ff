// Reports to the service manager (systemd), if it has started this process: the program has started, still runs, or
// ends. Service thread; does nothing without a service manager.
#pragma once
#include <cstdint>

namespace rung::rung_run {

class ServiceManager {
public:
  ServiceManager();

  void ready() const;
  // Called in every turn with the number of steps so far: resets the manager's watchdog twice per watchdog time, but
  // only after new steps. If the scan thread or the service thread stops, the manager ends the process.
  void feed(uint64_t steps, int64_t nowNs);
  void stopping() const;

private:
  int64_t everyNs_ = 0; // half of the watchdog time; 0: no watchdog
  int64_t fedNs_ = 0;
  uint64_t steps_ = 0;
};

} // namespace rung::rung_run
