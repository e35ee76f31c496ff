// What a process cannot do any more once it is in the sandbox. Each attempt is one process.
#include "machine/rung-compile/sandbox.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

namespace rung::rung_compile {
namespace {

constexpr Limits kLimits{.processorSeconds = 1, .memory = size_t{512} << 20, .fileSize = 1 << 20};
constexpr int kNotBegun = 200;
constexpr int kKilled = 300; // and the signal

template <class Attempt>
int process(Attempt attempt) {
  const pid_t child = fork();
  if (child == 0) _exit(attempt());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? kKilled + WTERMSIG(status) : WEXITSTATUS(status);
}

// errno of what was tried, 0 where it was possible.
template <class Attempt>
int inside(Attempt attempt) {
  return process([&] {
    if (!giveUpRights(STDERR_FILENO, kLimits).empty() || !enterSandbox().empty()) return kNotBegun;
    return attempt();
  });
}

template <class Result>
int errnoOf(Result result) {
  return result == static_cast<Result>(-1) ? errno : 0;
}

TEST(Sandbox, HasNoFiles) {
  EXPECT_EQ(inside([] { return errnoOf(open("/etc/hostname", O_RDONLY)); }), EACCES);
  EXPECT_EQ(inside([] { return errnoOf(open("/dev/null", O_RDWR)); }), EACCES);
  EXPECT_EQ(inside([] { return errnoOf(open("..", O_RDONLY | O_DIRECTORY)); }), EACCES);
  EXPECT_EQ(inside([] { return errnoOf(openat(0, "x", O_WRONLY | O_CREAT, 0600)); }), EACCES);
  EXPECT_EQ(inside([] { return errnoOf(open("/proc/self/fd/../fd/0", O_RDONLY)); }), EACCES);
  EXPECT_EQ(inside([] { return errnoOf(open("/proc/self/mem", O_RDONLY)); }), EACCES);
  EXPECT_EQ(inside([] {
              struct stat about{};
              return errnoOf(stat("/etc/hostname", &about));
            }),
            EACCES);
  EXPECT_EQ(inside([] { return errnoOf(access("/etc", F_OK)); }), EPERM);
  EXPECT_EQ(inside([] { return errnoOf(unlink("/nothing")); }), EPERM);
  EXPECT_EQ(inside([] { return errnoOf(rename("/nothing", "/more")); }), EPERM);
  EXPECT_EQ(inside([] { return errnoOf(chdir("/")); }), EPERM);
}

TEST(Sandbox, OpensWhatIsOpenAlready) {
  EXPECT_EQ(inside([] {
              const int file = memfd_create("f", 0);
              if (write(file, "abc", 3) != 3) return 1;
              const std::string path = "/proc/self/fd/" + std::to_string(file);
              const int again = open(path.c_str(), O_RDONLY);
              char text[4] = "";
              if (pread(again, text, 3, 0) != 3 || std::strcmp(text, "abc") != 0) return 2;
              struct stat about{};
              if (fstat(again, &about) != 0 || about.st_size != 3) return 3;
              return open(path.c_str(), O_RDWR) < 0 && open("/proc/self/fd/11", O_RDONLY) < 0 ? 0 : 4;
            }),
            0);
}

TEST(Sandbox, ReachesNobody) {
  EXPECT_EQ(inside([] { return errnoOf(socket(AF_UNIX, SOCK_STREAM, 0)); }), EPERM);
  EXPECT_EQ(inside([] { return errnoOf(socket(AF_INET, SOCK_STREAM, 0)); }), EPERM);
  EXPECT_EQ(inside([] { return errnoOf(fork()); }), EPERM);
  EXPECT_EQ(inside([] { return errnoOf(execl("/bin/true", "true", nullptr)); }), EPERM);
  EXPECT_EQ(inside([] { return errnoOf(kill(getppid(), 0)); }), EPERM);
  EXPECT_EQ(inside([] { return errnoOf(ptrace(PTRACE_TRACEME, 0, nullptr, nullptr)); }), EPERM);
}

TEST(Sandbox, MakesNoCode) {
  EXPECT_EQ(inside([] {
              return errnoOf(
                  mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) == MAP_FAILED ? -1
                                                                                                               : 0);
            }),
            EPERM);
  EXPECT_EQ(inside([] {
              void* page = mmap(nullptr, 4096, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
              return errnoOf(mprotect(page, 4096, PROT_READ | PROT_EXEC));
            }),
            EPERM);
}

TEST(Sandbox, HasNoWayBack) {
  EXPECT_EQ(inside([] { return errnoOf(prctl(PR_SET_DUMPABLE, 1, 0, 0, 0)); }), EPERM);
  EXPECT_EQ(inside([] { return errnoOf(setresuid(0, 0, 0)); }), EPERM);
  EXPECT_EQ(inside([] {
              const rlimit more{RLIM_INFINITY, RLIM_INFINITY};
              return errnoOf(setrlimit(RLIMIT_CPU, &more));
            }),
            EPERM);
  EXPECT_EQ(process([] {
              if (!giveUpRights(STDERR_FILENO, kLimits).empty()) return 1;
              uid_t user = 0, effective = 0, saved = 0;
              getresuid(&user, &effective, &saved);
              if (user == 0 || effective == 0 || saved == 0 || getgid() == 0 || setresuid(0, 0, 0) == 0) return 2;
              if (prctl(PR_GET_DUMPABLE, 0, 0, 0, 0) != 0 || prctl(PR_GET_NO_NEW_PRIVS, 0, 0, 0, 0) != 1) return 3;
              return getpriority(PRIO_PROCESS, 0) == 19 ? 0 : 4;
            }),
            0);
}

TEST(Sandbox, HasLimits) {
  EXPECT_EQ(inside([] {
              for (volatile int i = 0;; i = i + 1) {
              }
              return 0;
            }),
            kKilled + SIGXCPU);
  EXPECT_EQ(inside([] {
              return errnoOf(mmap(nullptr, size_t{1} << 30, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1,
                                  0) == MAP_FAILED
                                 ? -1
                                 : 0);
            }),
            ENOMEM);
  EXPECT_EQ(inside([] { return errnoOf(ftruncate(memfd_create("f", 0), 1 << 21)); }), kKilled + SIGXFSZ);
  EXPECT_EQ(inside([] {
              for (int i = 0; i < 20; ++i)
                if (memfd_create("f", 0) < 0) return errno;
              return 0;
            }),
            EMFILE);
  EXPECT_EQ(inside([] { return raise(SIGABRT); }), kKilled + SIGABRT);
}

TEST(Sandbox, ClosesWhatIsOpen) {
  const int file = open("/dev/null", O_RDONLY);
  EXPECT_EQ(inside([&] { return errnoOf(lseek(file, 0, SEEK_CUR)); }), EBADF);
  close(file);
}

} // namespace
} // namespace rung::rung_compile
