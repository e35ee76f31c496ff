// The rules, and the queries of the system.
#include "rtlib/load/trust.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/fsuid.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>

#include "rtlib/load/file.h"

namespace rung::runtime {

namespace {

constexpr uint32_t kGroupWrites = 0020;
constexpr uint32_t kOthersWrite = 0002;
constexpr size_t kMostKeyBytes = 4096;

// The libraries that a compiler's driver links to a shared object by default. The dynamic linker finds them in the
// system's folders: in a privileged process it ignores the environment.
constexpr std::array<std::string_view, 11> kSystemLibraries = {
    "libc.so.6",  "libm.so.6",     "libgcc_s.so.1",        "libstdc++.so.6",        "libpthread.so.0",     "libdl.so.2",
    "librt.so.1", "ld-linux.so.2", "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1", "ld-linux-armhf.so.3",
};

std::string octal(uint32_t mode) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "%04o", mode);
  return text.data();
}

// Why a user whom the process does not trust could change a file.
enum class Weakness : uint8_t { None, ForeignOwner, OthersWrite, GroupWrites };

Weakness weaknessOf(const FileFacts& file, const ProcessIds& ids) {
  const bool privileged = isPrivileged(ids);
  if (file.uid != 0 && (privileged || file.uid != ids.euid)) return Weakness::ForeignOwner;
  if ((file.mode & kOthersWrite) != 0) return Weakness::OthersWrite;
  if ((file.mode & kGroupWrites) != 0 && (privileged || file.gid != ids.egid)) return Weakness::GroupWrites;
  return Weakness::None;
}

std::string_view fixOf(Weakness weakness, const ProcessIds& ids) {
  if (isPrivileged(ids)) return "a copy made by sudo install -o root -g root -m 0644 may run";
  return weakness == Weakness::ForeignOwner ? "a copy of your own may run" : "after chmod go-w it may run";
}

std::string userText(uint32_t uid) { return uid == 0 ? "root" : "user " + std::to_string(uid); }

// Whether only root can change it.
bool isRoots(const FileFacts& file) { return file.uid == 0 && (file.mode & (kGroupWrites | kOthersWrite)) == 0; }

struct CloseFolder {
  void operator()(DIR* folder) const { ::closedir(folder); }
};
using Folder = std::unique_ptr<DIR, CloseFolder>;

// Opens a folder part by part along its path. All parts must belong to root; else `problem` says which does not.
File openRootsFolder(std::string_view path, std::string& problem) {
  File folder(::open("/", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  size_t end = 0;
  for (;;) {
    const std::optional<FileFacts> facts = factsOf(folder.fd());
    if (!facts || !isRoots(*facts)) {
      problem = std::string(end == 0 ? "/" : path.substr(0, end)) + " must be writable only by root";
      return File();
    }
    const size_t begin = path.find_first_not_of('/', end);
    if (begin == std::string_view::npos) return folder;
    end = std::min(path.find('/', begin), path.size());
    const std::string part(path.substr(begin, end - begin));
    folder = File(::openat(folder.fd(), part.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
    if (!folder.ok()) {
      if (errno != ENOENT) problem = std::string(path.substr(0, end)) + ": " + std::strerror(errno);
      return File();
    }
  }
}

File openKeysFolder(const std::string& path, const ProcessIds& ids, std::string& problem) {
  if (isPrivileged(ids) || path == kKeysFolder) return openRootsFolder(kKeysFolder, problem);
  File folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  const std::optional<FileFacts> facts = factsOf(folder.fd());
  const std::string wrong = facts ? ownerProblem(*facts, ids) : std::strerror(errno);
  if (wrong.empty()) return folder;
  problem = path + ": " + wrong;
  return File();
}

// Nothing if the file contains no key, or another user could have put it there.
std::optional<PublicKey> readKey(int folder, const char* name, const ProcessIds& ids) {
  const File file(::openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  const std::optional<FileFacts> facts = factsOf(file.fd());
  if (!facts || !facts->isRegular || !ownerProblem(*facts, ids).empty()) return std::nullopt;
  std::string text;
  if (!readAll(file.fd(), kMostKeyBytes, text).empty()) return std::nullopt;
  return parsePublicKey(text);
}

} // namespace

bool isPrivileged(const ProcessIds& ids) {
  const bool hasRoot = ids.euid == 0 || ids.suid == 0;
  const bool servesOther = ids.ruid != 0 || ids.suid != 0 || ids.fsuid != 0;
  return hasRoot && servesOther;
}

std::string ownerProblem(const FileFacts& file, const ProcessIds& ids) {
  switch (weaknessOf(file, ids)) {
  case Weakness::None: return {};
  case Weakness::OthersWrite: return "every user may write to it (mode " + octal(file.mode) + ")";
  case Weakness::GroupWrites:
    return "its group " + std::to_string(file.gid) + " may write to it (mode " + octal(file.mode) + ")";
  case Weakness::ForeignOwner: break;
  }
  if (isPrivileged(ids))
    return "it belongs to " + userText(file.uid) +
           ", and a process with root's rights that serves another user runs only what belongs to root";
  return "it belongs to " + userText(file.uid) + ", not to root" +
         (ids.euid == 0 ? "" : " or to " + userText(ids.euid)) + ", who runs it";
}

std::string loadProblem(const FileFacts& file, const ProcessIds& ids, SealState seal, bool mayLackSeal) {
  if (!file.isRegular) return "it is not a regular file";
  if (seal == SealState::WrongSignature) return "its signature is not by the key that it names; sign it again";
  if (seal == SealState::Missing && (isPrivileged(ids) || !mayLackSeal))
    return "it has no seal at its end, so damage could not be seen; build it again, or seal what another linker made: "
           "rungc seal";
  const Weakness weakness = weaknessOf(file, ids);
  if (weakness == Weakness::None || seal == SealState::Signed) return {};
  return ownerProblem(file, ids) + "; " + std::string(fixOf(weakness, ids)) +
         ", and so may one signed with a known key (rungc seal --sign)";
}

std::string dependencyProblem(const ElfObject& object) {
  if (!object.problem.empty()) return object.problem;
  if (!object.searched.empty())
    return "it names '" + object.searched.front() +
           "' to load libraries from or with (RPATH, RUNPATH, filter or audit); link it without";
  for (const std::string& library : object.needed)
    if (std::find(kSystemLibraries.begin(), kSystemLibraries.end(), library) == kSystemLibraries.end())
      return "it needs the library '" + library + "'; link that into it";
  return {};
}

ProcessIds idsOfThisThread() {
  ProcessIds ids;
  uid_t real = 0;
  uid_t effective = 0;
  uid_t saved = 0;
  ::getresuid(&real, &effective, &saved);
  ids.ruid = real;
  ids.euid = effective;
  ids.suid = saved;
  ids.fsuid = static_cast<uint32_t>(::setfsuid(static_cast<uid_t>(-1))); // changes nothing, and returns the present id
  ids.egid = ::getegid();
  return ids;
}

std::optional<FileFacts> factsOf(int fd) {
  struct stat status{};
  if (fd < 0 || ::fstat(fd, &status) != 0) return std::nullopt;
  return FileFacts{.uid = status.st_uid,
                   .gid = status.st_gid,
                   .mode = status.st_mode & 07777u,
                   .isRegular = S_ISREG(status.st_mode)};
}

std::string rootsFileProblem(const std::string& path) {
  std::string problem;
  const File folder = openRootsFolder(folderOf(path), problem);
  if (!folder.ok()) return problem.empty() ? folderOf(path) + " is not there" : problem;
  const std::string name = path.substr(path.rfind('/') + 1);
  const File file(::openat(folder.fd(), name.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
  const std::optional<FileFacts> facts = factsOf(file.fd());
  if (!facts) return std::strerror(errno);
  return facts->isRegular && isRoots(*facts) ? "" : "it must be writable only by root";
}

std::optional<PublicKey> findKey(const KeyId& id, const std::string& folder, const ProcessIds& ids,
                                 std::string& problem) {
  File opened = openKeysFolder(folder, ids, problem);
  if (!opened.ok()) return std::nullopt;
  const int fd = opened.fd();
  const Folder list(::fdopendir(fd));
  if (list == nullptr) return std::nullopt;
  opened.release(); // now owned by `list`
  while (const dirent* entry = ::readdir(list.get())) {
    if (!std::string_view(entry->d_name).ends_with(".pub")) continue;
    const std::optional<PublicKey> key = readKey(fd, entry->d_name, ids);
    if (key && key->id() == id) return key;
  }
  return std::nullopt;
}

// All files are opened relative to the folder that was checked.

namespace {

constexpr size_t kMostBytes = size_t{1} << 30;

void make(const std::string& path) {
  std::error_code ignored; // opening the folder reports errors
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), ignored);
  ::mkdir(path.c_str(), 0700);
}

} // namespace

std::optional<CodeFolder> CodeFolder::open(const std::string& path, std::string& problem) {
  make(path);
  File folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
  const std::optional<FileFacts> facts = factsOf(folder.fd());
  const std::string wrong = facts ? ownerProblem(*facts, idsOfThisThread()) : std::strerror(errno);
  if (wrong.empty()) return CodeFolder(std::move(folder));
  problem = "cannot use the folder '" + path + "' for code: " + wrong;
  return std::nullopt;
}

std::optional<std::string> CodeFolder::read(const std::string& name) const {
  const File file(::openat(folder_.fd(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  const std::optional<FileFacts> facts = factsOf(file.fd());
  std::string bytes;
  if (!facts || !facts->isRegular || !ownerProblem(*facts, idsOfThisThread()).empty() ||
      !readAll(file.fd(), kMostBytes, bytes).empty())
    return std::nullopt;
  return bytes;
}

std::string CodeFolder::write(const std::string& name, std::string_view bytes) const {
  const std::string wrong = replaceFileIn(folder_.fd(), name, bytes, {.mode = 0600});
  return wrong.empty() ? "" : "cannot write " + name + ": " + wrong;
}

} // namespace rung::runtime
