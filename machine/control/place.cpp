// See place.h.
#include "machine/control/place.h"

#include <dirent.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>

namespace rung::control {
namespace {

constexpr std::string_view kEnding = ".sock";

constexpr mode_t kHisAlone = 0700;

// The mode of a folder that belongs to the user; nothing if the path is not such a folder.
std::optional<mode_t> modeOfFolder(const std::string& path, uid_t user) {
  struct stat about{};
  if (lstat(path.c_str(), &about) != 0 || !S_ISDIR(about.st_mode) || about.st_uid != user) return std::nullopt;
  return about.st_mode & 0777;
}

void addPlaces(const std::string& path, std::vector<Place>& places) {
  const std::unique_ptr<DIR, int (*)(DIR*)> folder(opendir(path.c_str()), closedir);
  if (folder == nullptr && errno != ENOENT)
    throw std::runtime_error("cannot look for hosts in " + path + ": " + std::strerror(errno) +
                             "; only the user who started a host can reach it");
  if (folder == nullptr) return;
  while (const dirent* entry = readdir(folder.get())) {
    const std::string_view name = entry->d_name;
    if (name.ends_with(kEnding))
      places.push_back({std::string(name.substr(0, name.size() - kEnding.size())), path + "/" + entry->d_name});
  }
}

} // namespace

std::vector<std::string> socketFolders(uid_t user) {
  if (const char* named = secure_getenv("RUNG_SOCKETS"); named != nullptr && *named == '/') return {named};
  const std::string number = std::to_string(user);
  const std::string early = "/tmp/rung-" + number;
  if (!modeOfFolder("/run/user/" + number, user)) return {early};
  std::vector<std::string> folders = {"/run/user/" + number + "/rung"};
  if (modeOfFolder(early, user) == kHisAlone) folders.push_back(early); // every user can create a folder in /tmp
  return folders;
}

std::string socketPath(const std::string& folder, const std::string& host) {
  return folder + "/" + host + std::string(kEnding);
}

std::string socketOf(uid_t user, const std::string& host) {
  const std::vector<std::string> folders = socketFolders(user);
  const auto has = [&](const std::string& folder) { return isServed(socketPath(folder, host)); };
  const auto found = std::ranges::find_if(folders, has);
  return socketPath(found != folders.end() ? *found : folders.front(), host);
}

sockaddr_un socketAddress(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) throw std::runtime_error(path + ": the path of a socket is too long");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

bool isServed(const std::string& path) {
  const sockaddr_un address = socketAddress(path);
  const int probe = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const bool served =
      connect(probe, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 || errno == EAGAIN;
  close(probe);
  return served;
}

std::string wrongHostName(const std::string& name) {
  constexpr std::string_view kAllowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  constexpr size_t kLongest = 60; // the path of a socket has at most 107 characters
  if (name.size() > kLongest)
    return "found a name of " + std::to_string(name.size()) + " characters for a host, expected at most " +
           std::to_string(kLongest);
  const bool good = !name.empty() && name[0] != '.' && name.find_first_not_of(kAllowed) == std::string::npos;
  return good ? "" : "found the name \"" + name + "\" of a host, expected letters, digits, '-', '_' and '.'";
}

std::vector<Place> placesOf(uid_t user) {
  std::vector<Place> places;
  for (const std::string& folder : socketFolders(user)) addPlaces(folder, places);
  return places;
}

std::vector<std::string> hostsOf(uid_t user) {
  std::vector<std::string> hosts;
  for (const Place& place : placesOf(user))
    if (isServed(place.path)) hosts.push_back(place.host);
  std::ranges::sort(hosts);
  const auto twice = std::ranges::unique(hosts);
  hosts.erase(twice.begin(), twice.end());
  return hosts;
}

std::string prepareFolder(uid_t user) {
  std::string folder = socketFolders(user).front();
  if (mkdir(folder.c_str(), kHisAlone) != 0 && errno != EEXIST)
    throw std::runtime_error("cannot make the folder " + folder + ": " + std::strerror(errno));
  if (modeOfFolder(folder, user) != kHisAlone)
    throw std::runtime_error(folder + " must be a folder that only user " + std::to_string(user) +
                             " may use: chmod 700 it, or set RUNG_SOCKETS to another folder");
  return folder;
}

} // namespace rung::control
