// What a thread of the host is that serves devices beside the scan.
#pragma once
#include <csignal>

#include "rtlib/host/realtime.h"

namespace rung::host_devices {

// Called by the thread: ordinary scheduling, and signals are for the thread that waits for them.
inline void becomeHelper() noexcept {
  sigset_t all;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
  host::runOrdinary();
}

} // namespace rung::host_devices
