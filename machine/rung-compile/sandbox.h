// The sandbox of the compiler process: what remains of its rights is its memory and the open files.
#pragma once
#include <string>

#include <sys/types.h>

namespace rung::rung_compile {

struct Limits {
  unsigned processorSeconds;
  size_t memory;   // bytes of address space; 0: no limit
  size_t fileSize; // bytes of a file that it writes
};

// Gives up all rights that the compiler does not need: root's user and groups, capabilities and the means to regain
// them, inspection by other processes, and priority. Files above `lastFile` are closed. "", or what could not be given
// up: then the process must end.
std::string giveUpRights(int lastFile, const Limits& limits);

// From now on the process cannot open files, create processes, threads or connections, map memory as code, or reach
// other processes: the system refuses it (seccomp). When the linker opens /proc/self/fd/N, it gets a duplicate of the
// open file N. "", or the reason of a failure.
std::string enterSandbox();

// Changes from root to a user, so that files are read with that user's rights; the limits apply, too. "", or the reason
// of a failure.
std::string becomeUser(uid_t user, const Limits& limits);

} // namespace rung::rung_compile
