// See service_manager.h.
#include "machine/rung-run/service_manager.h"

#include <systemd/sd-daemon.h>

namespace rung::rung_run {

ServiceManager::ServiceManager() {
  uint64_t us = 0;
  if (sd_watchdog_enabled(0, &us) > 0) everyNs_ = static_cast<int64_t>(us) * 1000 / 2;
}

void ServiceManager::ready() const { (void)sd_notify(0, "READY=1\nSTATUS=the program is scanned"); }

void ServiceManager::feed(uint64_t steps, int64_t nowNs) {
  if (everyNs_ == 0 || steps == steps_ || nowNs - fedNs_ < everyNs_) return;
  steps_ = steps;
  fedNs_ = nowNs;
  (void)sd_notify(0, "WATCHDOG=1");
}

void ServiceManager::stopping() const { (void)sd_notify(0, "STOPPING=1\nSTATUS=the program is switched off"); }

} // namespace rung::rung_run
