// Restricts a process that compiles for another user to its own memory and the files that are already open.
#pragma once
#include <string>

#include <sys/types.h>

namespace rung::rung_compile {

struct Limits {
  unsigned processorSeconds;
  size_t memory;   // bytes of address space; 0: no limit
  size_t fileSize; // bytes of a file that the process writes
};

// Gives up everything that is not needed before the compiler begins: root's user and groups, capabilities, the
// possibility to regain them, inspection by other processes, and priority. Closes files above `lastFile`. Returns "",
// or what could not be given up: the process must end then.
std::string giveUpRights(int lastFile, const Limits& limits);

// From here on the process opens no file, makes no process, thread or connection, maps no memory as code, and reaches
// no other process; the system refuses it (seccomp). When the linker opens /proc/self/fd/N, it gets a duplicate of the
// open file N. Returns "", or the reason of a failure.
std::string enterSandbox();

// For a process that reads files as their user: replaces root's rights by those of the user and sets the limits.
// Returns "", or the reason of a failure.
std::string becomeUser(uid_t user, const Limits& limits);

} // namespace rung::rung_compile
