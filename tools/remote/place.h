// Where the sockets are by which rungctl reaches the hosts of a user.
#pragma once
#include <sys/types.h>
#include <sys/un.h>

#include <string>
#include <vector>

namespace rung::remote {

// The folder of a user's sockets: that of the environment variable RUNG_SOCKETS, which a process with more rights than
// its user does not look at; else /run/user/NUMBER/rung, or /tmp/rung-NUMBER where the system has no /run/user.
std::string socketFolder(uid_t user);
std::string socketPath(uid_t user, const std::string& host);
// Throws std::runtime_error where the path is too long for a socket.
sockaddr_un socketAddress(const std::string& path);

// A host's name: letters, digits, '-', '_' and '.', not at the beginning.
bool isHostName(const std::string& name);
// Those that have a socket there, sorted; a host that has been killed leaves its own.
std::vector<std::string> hostsOf(uid_t user);

// Makes the folder, for its user alone. Throws std::runtime_error where something else has its place.
void prepareFolder(uid_t user);

} // namespace rung::remote
