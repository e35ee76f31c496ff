// The project file rung.toml: what a program consists of and how it is configured (docs/project-file.md).
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/diagnostics.h"
#include "ir/support/source.h"

namespace rung::compiler {

inline constexpr std::string_view kFileName = "rung.toml";

// A key of the dialect's configuration. The value lies between these bytes of the project file.
struct Setting {
  std::string key;
  std::string value;
  size_t begin = 0;
  size_t end = 0;
};

// All paths can be opened from the working directory.
struct Project {
  std::string file;   // the project file itself
  std::string folder; // that it lies in, "" for the working directory
  std::string name;   // of what is made from it; the folder's where the file gives none
  std::string dialect;
  std::vector<std::string> files; // in order, the first is the main file
  std::vector<std::string> includePaths;
  std::vector<Setting> config;        // in the order of the file; `nc` is one of them
  std::vector<std::string> bindings;  // files of rungc bind, for whose layouts the program is built
  std::vector<std::string> scenarios; // every file that a pattern matches, in the order of the patterns, each once
};

// Reports every mistake of the file, and the files that are missing. Nothing when there are errors.
std::optional<Project> load(SourceManager& sources, const std::string& file, Diagnostics& diagnostics);

// The project file was read into another SourceManager; the places of its values in this one, where `config` has them.
std::map<std::string, SourceRange> placesOf(const Project& project, const std::map<std::string, std::string>& config,
                                            SourceManager& sources);

// The project file of this folder or of the nearest one above it that has one; "" is the working directory.
std::optional<std::string> findUpwards(const std::string& folder);

// The file that is made of a project where no other is named: NAME.so beside the project file.
std::string productOf(const Project& project, std::string_view ending);

// Whether the project names this file, however the path is written.
bool hasFile(const Project& project, const std::string& file);

// The files that match a pattern: *, ? and […] in each part of the path, as in a shell. Sorted.
std::vector<std::string> matchPattern(const std::string& folder, std::string_view pattern);
bool isPattern(std::string_view text);

// What a file is by its name, for commands that were given one of another kind.

enum class FileKind { Other, Program, Compiled, Scenario, Map, Binding, Project };

FileKind kindOfFile(const std::string& path);
// "" or, where the name says that the file is of another kind, that and which command takes it.
std::string otherKind(const std::string& path, FileKind wanted);

} // namespace rung::compiler
