// Whether a thread enters the kernel: Linux's dispatch of system calls to the process itself (prctl(2)). Calls by way
// of the vDSO, such as reading the clock, are none.
#pragma once
#include <sys/prctl.h>

#include <csignal>
#include <optional>

#include "tests/support/sanitized.h"

namespace {

thread_local volatile char systemCallsTrap = 0; // the kernel reads it at each call: 1 raises SIGSYS instead
thread_local volatile std::sig_atomic_t trapped = 0;
thread_local volatile std::sig_atomic_t lastTrapped = 0; // its number

// While this object lives, the thread that made it has its system calls trapped between `enter` and `exit`; neither is
// a system call itself. The first call in between is not carried out but counted, and ends the trap.
class SystemCallTrap {
public:
  SystemCallTrap() {
    struct sigaction action{};
    action.sa_flags = SA_SIGINFO;
    action.sa_sigaction = [](int, siginfo_t* info, void*) {
      systemCallsTrap = 0; // else returning from here would be the next one
      trapped = trapped + 1;
      lastTrapped = info->si_syscall;
    };
    sigaction(SIGSYS, &action, &before_);
    trapped = 0;
#ifndef RUNG_TEST_SANITIZED // else its checks of classes fail, which look by a system call whether memory can be read
    works_ = prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_ON, 0, 0, &systemCallsTrap) == 0;
#endif
  }
  ~SystemCallTrap() {
    systemCallsTrap = 0;
    if (works_) prctl(PR_SET_SYSCALL_USER_DISPATCH, PR_SYS_DISPATCH_OFF, 0, 0, 0);
    sigaction(SIGSYS, &before_, nullptr);
  }
  SystemCallTrap(const SystemCallTrap&) = delete;
  SystemCallTrap& operator=(const SystemCallTrap&) = delete;

  bool works() const { return works_; } // the kernel can do it, and no sanitizer is here
  void enter() const { systemCallsTrap = works_ ? 1 : 0; }
  void exit() const { systemCallsTrap = 0; }
  int count() const { return trapped; }
  int last() const { return lastTrapped; } // the number of the last one

private:
  struct sigaction before_{};
  bool works_ = false;
};

// The first system call of `work` is counted; nothing where the kernel cannot do that.
template <class F>
std::optional<int> systemCallsOf(F&& work) {
  const SystemCallTrap trap;
  trap.enter();
  work();
  trap.exit();
  return trap.works() ? std::optional<int>(trap.count()) : std::nullopt;
}

} // namespace
