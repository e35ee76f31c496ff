// See sandbox.h.
#include "machine/rung-compile/sandbox.h"

#include <fcntl.h>
#include <grp.h>
#include <linux/capability.h>
#include <sched.h>
#include <seccomp.h>
#include <signal.h> // NOLINT(modernize-deprecated-headers): sigaction
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>

namespace rung::rung_compile {
namespace {

constexpr uid_t kNobody = 65534; // also the ID of the group

std::string because(const char* what) { return std::string(what) + ": " + std::strerror(errno); }

// ---- rights --------------------------------------------------------------------------------------------------------

struct Ids {
  uid_t real = 0, effective = 0, saved = 0;
  Ids() { getresuid(&real, &effective, &saved); }
  bool hasRoot() const { return real == 0 || effective == 0 || saved == 0; }
};

// Root may be only the real or the saved user.
void takeRoot() {
  if (geteuid() != 0 && seteuid(0) != 0) errno = 0; // calls that need root fail later
}

bool leaveRoot() {
  takeRoot();
  return setgroups(0, nullptr) == 0 && setresgid(kNobody, kNobody, kNobody) == 0 &&
         setresuid(kNobody, kNobody, kNobody) == 0 && !Ids().hasRoot();
}

bool dropCapabilities() {
  __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
  std::array<__user_cap_data_struct, 2> none{};
  prctl(PR_CAP_AMBIENT, PR_CAP_AMBIENT_CLEAR_ALL, 0, 0, 0);
  return syscall(SYS_capset, &header, none.data()) == 0;
}

bool limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
  const rlimit both{soft, hard};
  return setrlimit(resource, &both) == 0;
}

bool setLimits(const Limits& limits) {
  constexpr rlim_t kMostFiles = 12;
  return limit(RLIMIT_CORE, 0, 0) && limit(RLIMIT_NOFILE, kMostFiles, kMostFiles) &&
         limit(RLIMIT_CPU, limits.processorSeconds, limits.processorSeconds + 1) &&
         limit(RLIMIT_FSIZE, limits.fileSize, limits.fileSize) &&
         (limits.memory == 0 || limit(RLIMIT_AS, limits.memory, limits.memory));
}

// The lowest priority, below all threads of the host.
void lowerPriority() {
  const sched_param none{};
  sched_setscheduler(0, SCHED_BATCH, &none);
  setpriority(PRIO_PROCESS, 0, 19);
}

// ---- system calls --------------------------------------------------------------------------------------------------

// The descriptor N in /proc/self/fd/N; -1: another path.
int openFileOf(const char* path) {
  constexpr std::string_view kFolder = "/proc/self/fd/";
  if (std::strncmp(path, kFolder.data(), kFolder.size()) != 0) return -1;
  int number = 0;
  const char* at = path + kFolder.size();
  for (; *at >= '0' && *at <= '9' && number < 1000; ++at) number = number * 10 + (*at - '0');
  return *at == '\0' ? number : -1;
}

long resultOf(long result) { return result < 0 ? -errno : result; }

long openInstead(const char* path, int flags) {
  const int file = openFileOf(path);
  if (file < 0 || (flags & O_ACCMODE) != O_RDONLY) return -EACCES;
  return resultOf(syscall(SYS_fcntl, file, F_DUPFD_CLOEXEC, 0));
}

// fstat() of the C library makes this call with an empty path.
long statInstead(long file, const char* path, void* to) {
  return path != nullptr && *path != '\0' ? -EACCES : resultOf(syscall(SYS_fstat, file, to));
}

// Replaces or refuses a system call that the kernel has intercepted. Uses only async-signal-safe functions.
// NOLINTBEGIN(performance-no-int-to-ptr): arguments of calls are words
long doInstead(int call, long a, long b, long c) {
  switch (call) {
#ifdef SYS_open
  case SYS_open: return openInstead(reinterpret_cast<const char*>(a), static_cast<int>(b));
#endif
  case SYS_openat: return openInstead(reinterpret_cast<const char*>(b), static_cast<int>(c));
  case SYS_newfstatat: return statInstead(a, reinterpret_cast<const char*>(b), reinterpret_cast<void*>(c));
  default: return -EPERM;
  }
}
// NOLINTEND(performance-no-int-to-ptr)

void onRefused(int, siginfo_t* info, void* context) {
  const int before = errno;
  mcontext_t& machine = static_cast<ucontext_t*>(context)->uc_mcontext;
#if defined(__x86_64__)
  const auto word = [&](int at) { return static_cast<long>(machine.gregs[at]); };
  machine.gregs[REG_RAX] = doInstead(info->si_syscall, word(REG_RDI), word(REG_RSI), word(REG_RDX));
#elif defined(__aarch64__)
  const auto word = [&](int at) { return static_cast<long>(machine.regs[at]); };
  machine.regs[0] = static_cast<unsigned long>(doInstead(info->si_syscall, word(0), word(1), word(2)));
#else
  _exit(1);
#endif
  errno = before;
}

// System calls for memory, time and open files, which a compilation needs.
constexpr int kAllowed[] = {
    SCMP_SYS(read),
    SCMP_SYS(readv),
    SCMP_SYS(pread64),
    SCMP_SYS(write),
    SCMP_SYS(writev),
    SCMP_SYS(pwrite64),
    SCMP_SYS(lseek),
    SCMP_SYS(fstat),
    SCMP_SYS(close),
    SCMP_SYS(ftruncate),
    SCMP_SYS(dup),
    SCMP_SYS(memfd_create),
    SCMP_SYS(munmap),
    SCMP_SYS(mremap),
    SCMP_SYS(brk),
    SCMP_SYS(madvise),
    SCMP_SYS(futex),
    SCMP_SYS(rt_sigreturn),
    SCMP_SYS(rt_sigaction),
    SCMP_SYS(rt_sigprocmask),
    SCMP_SYS(sigaltstack),
    SCMP_SYS(clock_gettime),
    SCMP_SYS(gettimeofday),
    SCMP_SYS(getrusage),
    SCMP_SYS(getrandom),
    SCMP_SYS(getpid),
    SCMP_SYS(gettid),
    SCMP_SYS(sched_yield),
    SCMP_SYS(exit),
    SCMP_SYS(exit_group),
    SCMP_SYS(sched_getaffinity),
    SCMP_SYS(restart_syscall),
};
constexpr int kDoneInstead[] = {SCMP_SYS(open), SCMP_SYS(openat), SCMP_SYS(newfstatat)};
constexpr int kFileCommands[] = {F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL, F_ADD_SEALS, F_GET_SEALS};

bool addRules(scmp_filter_ctx filter) {
  bool ok = true;
  const auto allow = [&](int call, auto... conditions) {
    ok = seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, sizeof...(conditions), conditions...) == 0 && ok;
  };
  for (const int call : kAllowed) allow(call);
  for (const int command : kFileCommands)
    allow(SCMP_SYS(fcntl), scmp_arg_cmp{1, SCMP_CMP_EQ, static_cast<scmp_datum_t>(command), 0});
  for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect)})
    allow(call, scmp_arg_cmp{2, SCMP_CMP_MASKED_EQ, PROT_EXEC, 0});
  allow(SCMP_SYS(tgkill), scmp_arg_cmp{0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(getpid()), 0}); // abort()
  for (const int call : kDoneInstead) ok = seccomp_rule_add(filter, SCMP_ACT_TRAP, call, 0) == 0 && ok;
  return ok;
}

bool catchRefused() {
  struct sigaction action{};
  action.sa_sigaction = &onRefused;
  action.sa_flags = SA_SIGINFO | SA_NODEFER;
  return sigaction(SIGSYS, &action, nullptr) == 0;
}

} // namespace

std::string giveUpRights(int lastFile, const Limits& limits) {
  lowerPriority();
  close_range(static_cast<unsigned>(lastFile) + 1, ~0U, 0);
  if (Ids().hasRoot() && !leaveRoot()) return because("cannot leave root's user");
  if (!dropCapabilities()) return because("cannot drop capabilities");
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0 ||
      prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0) != 0)
    return because("cannot give up rights");
  return setLimits(limits) ? "" : because("cannot set limits");
}

std::string enterSandbox() {
  if (!catchRefused()) return because("cannot catch refused calls");
  scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
  if (filter == nullptr) return "cannot make a filter of system calls";
  const bool ok = seccomp_attr_set(filter, SCMP_FLTATR_CTL_TSYNC, 1) == 0 && addRules(filter); // for all threads
  const int status = ok ? seccomp_load(filter) : 0;
  seccomp_release(filter);
  if (!ok) return "the filter of system calls has a call that is unknown here";
  return status == 0 ? "" : std::string("cannot filter system calls: ") + std::strerror(-status);
}

std::string becomeUser(uid_t user, const Limits& limits) {
  lowerPriority();
  if (!Ids().hasRoot() && getuid() != user) return "the process is another user's";
  if (Ids().hasRoot()) takeRoot();
  if (setresuid(user, user, user) != 0) return because("cannot leave root's user");
  if (user != 0 && Ids().hasRoot()) return "root's rights are still there";
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 || prctl(PR_SET_PDEATHSIG, SIGKILL, 0, 0, 0) != 0)
    return because("cannot give up rights");
  return setLimits(limits) ? "" : because("cannot set limits");
}

} // namespace rung::rung_compile
