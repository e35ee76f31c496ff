// The same sources under other paths: paths are part of a program, so that the same files in another folder are the
// same program only under the paths of the first.
#pragma once
#include <string>
#include <vector>

#include "machine/compile/sources.h"

namespace rung::compile {

// How the paths of a program's files and those of files here differ, in how they begin.
class SourcePaths {
public:
  SourcePaths() = default; // the same ones
  SourcePaths(const std::vector<std::string>& program, const std::vector<std::string>& here);

  std::string ofProgram(const std::string& path) const { return replaced(path, here_, there_); }
  std::string here(const std::string& path) const { return replaced(path, there_, here_); }

private:
  static std::string replaced(const std::string& path, const std::string& from, const std::string& to);
  std::string there_, here_;
};

// Gives sources from here the paths that they have in the program.
void rename(Sources& sources, const SourcePaths& paths);

} // namespace rung::compile
