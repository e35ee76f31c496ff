// Waits until a file changes, whichever way an editor writes it.
#pragma once
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ir/support/result.h"

namespace rung::rungc {

// Watches folders and not files, because an editor may replace a file by a new one.
class FileWatch {
public:
  // Watches for changes of these files after `since`, and from now on of files with this ending in these folders.
  static Result<FileWatch> open(const std::vector<std::string>& files, const std::vector<std::string>& folders,
                                std::string ending, std::filesystem::file_time_type since);
  FileWatch(FileWatch&& other) noexcept;
  FileWatch& operator=(FileWatch&&) = delete;
  ~FileWatch();

  // Waits; returns the file that has changed, once no more changes follow for a moment, or nothing after Ctrl-C or
  // SIGTERM.
  std::optional<std::string> wait();

private:
  struct Folder {
    int watch;
    std::string path;
    bool all; // whether every file with the ending counts
  };
  FileWatch(int notify, int signals, std::string ending)
      : notify_(notify), signals_(signals), ending_(std::move(ending)) {}
  Result<void> add(const std::string& folder, bool all);
  std::string changedSince(std::filesystem::file_time_type since) const;
  std::string takeChange();

  int notify_ = -1;
  int signals_ = -1; // descriptor for SIGINT and SIGTERM, which are blocked while this object lives
  std::string ending_;
  std::vector<Folder> folders_;
  std::set<std::string> files_;
  std::string changedBefore_; // a file that changed between `since` and open()
};

} // namespace rung::rungc
