// Whether a thread enters the kernel: Linux's dispatch of system calls to the process itself (prctl(2)). Calls by way
// of the vDSO, such as reading the clock, are none.
#pragma once
#include <sys/prctl.h>

#include <csignal>
#include <optional>

namespace {

thread_local volatile char systemCallsTrap = 0; // the kernel reads it at each call: 1 raises SIGSYS instead
thread_local volatile std::sig_atomic_t trapped = 0;

// The first system call of `work`, which is not carried out, is counted; nothing where the kernel cannot do that.
template <class F>
std::optional<int> systemCallsOf(F&& work) {
  struct sigaction action{};
  struct sigaction before{};
  action.sa_handler = [](int) {
    systemCallsTrap = 0; // else returning from here would be the next one
    trapped = trapped + 1;
  };
  sigaction(SIGSYS, &action, &before);
  trapped = 0;
  const bool can = prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_ON, 0, 0, &systemCallsTrap) == 0;
  systemCallsTrap = can ? 1 : 0;
  work();
  systemCallsTrap = 0;
  if (can) prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_OFF, 0, 0, 0);
  sigaction(SIGSYS, &before, nullptr);
  return can ? std::optional<int>(trapped) : std::nullopt;
}

} // namespace
