// Restricts a process that compiles for another user to its memory and the files that are open.
#pragma once
#include <string>

#include <sys/types.h>

namespace rung::rung_compile {

struct Limits {
  unsigned processorSeconds;
  size_t memory;   // bytes of address space; 0: no limit
  size_t fileSize; // bytes of a file that it writes
};

// All that can be given up before the compiler has begun: root's user and groups, capabilities, the way back to them,
// being looked at by others, and priority. Files above `lastFile` are closed. "" or what could not be given up: then
// the process must end.
std::string giveUpRights(int lastFile, const Limits& limits);

// From here on the process opens no file, makes no process, thread or connection, maps no memory as code, and reaches
// no other process; the system refuses it (seccomp). Of /proc/self/fd/N, which the linker opens, it gets a duplicate of
// the open file N. "" or why not.
std::string enterSandbox();

// For a process that reads files as their user: root's rights are given up for the user's; the limits hold, too. "" or
// why not.
std::string becomeUser(uid_t user, const Limits& limits);

} // namespace rung::rung_compile
