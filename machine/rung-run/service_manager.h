// The machine's service manager (systemd), where it has started this process: it learns when the program scans, that it
// still does, and that it ends. Of the thread that serves; without a service manager nothing happens.
#pragma once
#include <cstdint>

namespace rung::rung_run {

class ServiceManager {
public:
  ServiceManager();

  void ready() const;
  // In every turn, with the number of steps so far: the manager's watchdog is fed by steps alone, at twice its rate. A
  // thread that scans no more, or one that serves no more, lets it end the process.
  void feed(uint64_t steps, int64_t nowNs);
  void stopping() const;

private:
  int64_t everyNs_ = 0; // half of the watchdog's time; 0: there is none
  int64_t fedNs_ = 0;
  uint64_t steps_ = 0;
};

} // namespace rung::rung_run
