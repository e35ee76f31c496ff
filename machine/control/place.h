// Where the sockets are by which rungctl reaches the hosts of a user.
#pragma once
#include <sys/types.h>
#include <sys/un.h>

#include <string>
#include <vector>

namespace rung::control {

// The folders of a user's sockets; a host takes the first one. That of the environment variable RUNG_SOCKETS alone,
// which a process with more rights than its user does not look at; else /run/user/NUMBER/rung, where there is
// /run/user/NUMBER, and /tmp/rung-NUMBER, which hosts have from before that came.
std::vector<std::string> socketFolders(uid_t user);
std::string socketPath(const std::string& folder, const std::string& host);
// Of a host that runs: in the first folder that has it, or in the first one.
std::string socketOf(uid_t user, const std::string& host);
// Throws std::runtime_error where the path is too long for a socket.
sockaddr_un socketAddress(const std::string& path);
// Somebody listens there: a host that was killed has left its socket. Throws as socketAddress.
bool isServed(const std::string& path);

// A host's name: letters, digits, '-', '_' and '.', not at the beginning. "" or what is wrong with it.
std::string wrongHostName(const std::string& name);
struct Place {
  std::string host;
  std::string path; // of its socket
};
// The sockets that are there, also of hosts that were killed. Throws std::runtime_error where a folder is there and
// cannot be read.
std::vector<Place> placesOf(uid_t user);
// The hosts that run, sorted. Throws as placesOf.
std::vector<std::string> hostsOf(uid_t user);

// Makes the folder of a new host, for its user alone. Throws std::runtime_error where something else has its place.
std::string prepareFolder(uid_t user);

} // namespace rung::control
