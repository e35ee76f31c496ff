// What an editor has open, and the programs that these files belong to.
#pragma once
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tools/lsp/position.h"
#include "tools/lsp/program.h"

namespace rung::lsp {

class Workspace {
public:
  // All paths are absolute and normal.
  void open(const std::string& path, std::string text);
  void close(const std::string& path);
  // Replaces the characters of the range; false if the file is not open.
  bool change(const std::string& path, const Range& range, std::string_view text, Unit unit);
  // Something that no program knows yet has happened: to an open text, or to files on the disk.
  void changed();

  // Null if it is not open.
  const std::string* textOf(const std::string& path) const;
  std::vector<std::string> openPaths() const;

  // The program of a file as it is now: that of its project, if it has the file; otherwise that of the file alone.
  Program& programOf(const std::string& path);

private:
  Program& checked(const std::string& path, bool isProject);

  OpenTexts open_;
  std::map<std::string, std::unique_ptr<Program>> programs_; // by their paths
  std::set<const Program*> current_;                         // checked since the last change
};

} // namespace rung::lsp
