// Reports to the service manager (systemd), if it has started this process: that the program scans, that it still does,
// and that it ends. Service thread; without a service manager nothing happens.
#pragma once
#include <cstdint>

namespace rung::rung_run {

class ServiceManager {
public:
  ServiceManager();

  void ready() const;
  // Called in every turn, with the number of steps so far: only steps feed the manager's watchdog, at twice its rate.
  // If the scan thread or the service thread stops, the manager ends the process.
  void feed(uint64_t steps, int64_t nowNs);
  void stopping() const;

private:
  int64_t everyNs_ = 0; // half of the watchdog's time; 0: there is none
  int64_t fedNs_ = 0;
  uint64_t steps_ = 0;
};

} // namespace rung::rung_run
