// A temporary folder, which is created by the constructor and removed by the destructor.
#pragma once

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace rung {

class TemporaryFolder {
public:
  TemporaryFolder() {
    std::error_code error;
    std::string pattern = (std::filesystem::temp_directory_path(error) / "rung-XXXXXX").string();
    if (error)
      errno = error.value();
    else if (mkdtemp(pattern.data()) != nullptr)
      path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// False: it could not be created, errno says why.
  bool ok() const { return !path_.empty(); }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  /// The contents of a file in it; nothing if the file cannot be read.
  std::optional<std::string> contentsOf(std::string_view name) const {
    std::ifstream in(path_ / name, std::ios::binary);
    std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    return in ? std::optional(std::move(bytes)) : std::nullopt;
  }

private:
  std::filesystem::path path_;
};

} // namespace rung
