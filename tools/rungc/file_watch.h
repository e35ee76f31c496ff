// Waits until a file changes, however an editor writes it.
#pragma once
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ir/support/result.h"

namespace rung::rungc {

// Folders are watched and not files, for an editor may put a new file in the place of the old one.
class FileWatch {
public:
  // Changes of these files since then, and from now on of files with this ending in these folders.
  static Result<FileWatch> open(const std::vector<std::string>& files, const std::vector<std::string>& folders,
                                std::string ending, std::filesystem::file_time_type since);
  FileWatch(FileWatch&& other) noexcept;
  FileWatch& operator=(FileWatch&&) = delete;
  ~FileWatch();

  // The file that has changed, once nothing more changes for a moment; nothing after Ctrl-C or SIGTERM.
  std::optional<std::string> wait();

private:
  struct Folder {
    int watch;
    std::string path;
    bool all; // every file with the ending counts
  };
  FileWatch(int notify, int signals, std::string ending)
      : notify_(notify), signals_(signals), ending_(std::move(ending)) {}
  Result<void> add(const std::string& folder, bool all);
  std::string changedSince(std::filesystem::file_time_type since) const;
  std::string takeChange();

  int notify_ = -1;
  int signals_ = -1; // SIGINT and SIGTERM, blocked while this lives
  std::string ending_;
  std::vector<Folder> folders_;
  std::set<std::string> files_;
  std::string changedBefore_; // between `since` and the opening
};

} // namespace rung::rungc
