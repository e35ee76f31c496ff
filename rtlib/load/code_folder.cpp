// Everything is looked up from the folder that was checked (see code_folder.h).
#include "rtlib/load/code_folder.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>

#include "rtlib/load/trust.h"

namespace rung::runtime {
namespace {

constexpr size_t kMostBytes = size_t{1} << 30;

void make(const std::string& path) {
  std::error_code ignored; // opening it says what is wrong
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
