// See place.h.
#include "tools/remote/place.h"

#include <dirent.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace rung::remote {
namespace {

constexpr std::string_view kEnding = ".sock";

bool isFolderOf(const std::string& path, uid_t user) {
  struct stat about{};
  return lstat(path.c_str(), &about) == 0 && S_ISDIR(about.st_mode) && about.st_uid == user;
}

} // namespace

std::string socketFolder(uid_t user) {
  if (const char* named = secure_getenv("RUNG_SOCKETS"); named != nullptr && *named == '/') return named;
  const std::string run = "/run/user/" + std::to_string(user);
  return isFolderOf(run, user) ? run + "/rung" : "/tmp/rung-" + std::to_string(user);
}

std::string socketPath(uid_t user, const std::string& host) {
  return socketFolder(user) + "/" + host + std::string(kEnding);
}

sockaddr_un socketAddress(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) throw std::runtime_error(path + ": the path of a socket is too long");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

bool isHostName(const std::string& name) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  constexpr size_t kLongest = 60; // a socket's path has 107 characters
  return !name.empty() && name.size() <= kLongest && name[0] != '.' &&
         name.find_first_not_of(kAllowed) == std::string::npos;
}

std::vector<std::string> hostsOf(uid_t user) {
  std::vector<std::string> hosts;
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir(socketFolder(user).c_str()), closedir);
  if (folder == nullptr) return hosts;
  while (const dirent* entry = readdir(folder.get())) {
    const std::string_view name = entry->d_name;
    if (name.ends_with(kEnding)) hosts.emplace_back(name.substr(0, name.size() - kEnding.size()));
  }
  std::ranges::sort(hosts);
  return hosts;
}

void prepareFolder(uid_t user) {
  constexpr mode_t kHisAlone = 0700;
  const std::string folder = socketFolder(user);
  if (mkdir(folder.c_str(), kHisAlone) != 0 && errno != EEXIST)
    throw std::runtime_error("cannot make the folder " + folder + ": " + std::strerror(errno));
  struct stat about{};
  if (lstat(folder.c_str(), &about) != 0 || !S_ISDIR(about.st_mode) || about.st_uid != user ||
      (about.st_mode & 0777) != kHisAlone)
    throw std::runtime_error(folder + " is not a folder that user " + std::to_string(user) +
                             " alone may use (mode 0700); remove it");
}

} // namespace rung::remote
