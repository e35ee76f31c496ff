// Paths of the sockets through which rungctl reaches the hosts of a user.
#pragma once
#include <sys/types.h>
#include <sys/un.h>

#include <string>
#include <vector>

namespace rung::control {

// The folders of a user's sockets; a host uses the first one. If the environment variable RUNG_SOCKETS is set, only
// that folder; a process with more rights than its user ignores it. Otherwise /run/user/NUMBER/rung, if
// /run/user/NUMBER exists, and /tmp/rung-NUMBER, used by hosts that were started before that existed.
std::vector<std::string> socketFolders(uid_t user);
std::string socketPath(const std::string& folder, const std::string& host);
// The socket of a running host: in the first folder that contains it, or in the first one.
std::string socketOf(uid_t user, const std::string& host);
// Throws std::runtime_error if the path is too long for a socket.
sockaddr_un socketAddress(const std::string& path);
// Returns whether a host listens at a socket; a host that was killed leaves its socket. Throws as socketAddress.
bool isServed(const std::string& path);

// Checks a host's name: at most 60 letters, digits, '-', '_' and '.', no '.' at the beginning. Returns "", or the
// error.
std::string wrongHostName(const std::string& name);
struct Place {
  std::string host;
  std::string path; // of its socket
};
// The existing sockets, including those of hosts that were killed. Throws std::runtime_error if a folder exists and
// cannot be read.
std::vector<Place> placesOf(uid_t user);
// The running hosts, sorted. Throws as placesOf.
std::vector<std::string> hostsOf(uid_t user);

// Creates the folder for a new host, accessible only to its user. Throws std::runtime_error if the path exists and is
// not such a folder.
std::string prepareFolder(uid_t user);

} // namespace rung::control
