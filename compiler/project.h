// The project file rung.toml: the files of a program and its configuration (docs/project-file.md).
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

// A key of the dialect's configuration, with the range of the value's bytes in the project file.
struct Setting {
  std::string key;
  std::string value;
  size_t begin = 0;
  size_t end = 0;
};

// All paths are relative to the working directory.
struct Project {
  std::string file;   // the project file itself
  std::string folder; // folder of the project file, "" for the working directory
  std::string name;   // of its products; the folder's name if the file gives none
  std::string dialect;
  std::vector<std::string> files; // in order, the first is the main file
  std::vector<std::string> includePaths;
  std::vector<Setting> config;        // in the order of the file; `nc` is one of them
  std::vector<std::string> bindings;  // files of rungc bind with the layouts for which the program is built
  std::vector<std::string> scenarios; // every file that matches a pattern, in the order of the patterns, each once
};

// Reports every mistake in the file and every missing file. Nothing if there are errors.
std::optional<Project> load(SourceManager& sources, const std::string& file, Diagnostics& diagnostics);

// Its configuration by keys.
std::map<std::string, std::string> configOf(const Project& project);

// For a project file that was read into another SourceManager: the positions in this one of the values that `config`
// has from it.
std::map<std::string, SourceRange> placesOf(const Project& project, const std::map<std::string, std::string>& config,
                                            SourceManager& sources);

// The project file of this folder or of the nearest one above it that has one; "" is the working directory.
std::optional<std::string> findUpwards(const std::string& folder);

// The default product of a project: NAME.so beside the project file.
std::string productOf(const Project& project, std::string_view ending);

// Whether the file belongs to the project, however its path is written.
bool hasFile(const Project& project, const std::string& file);

// The files that match a pattern: *, ? and […] in each part of the path, as in a shell. Sorted.
std::vector<std::string> matchPattern(const std::string& folder, std::string_view pattern);
bool isPattern(std::string_view text);

// The kind of a file by its name, for commands that were given a file of another kind.

enum class FileKind { Other, Program, Compiled, Scenario, Map, Binding, Project };

FileKind kindOfFile(const std::string& path);
// "" or, if the name is that of another kind of file, a message that says so and which command takes it.
std::string otherKind(const std::string& path, FileKind wanted);

} // namespace rung::compiler
