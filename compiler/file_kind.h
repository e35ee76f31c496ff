// What a file is by its name, for commands that were given one of another kind.
#pragma once
#include <string>

namespace rung::compiler {

enum class FileKind { Other, Program, Compiled, Scenario, Map, Binding, Project };

FileKind kindOfFile(const std::string& path);
// "" or, where the name says that the file is of another kind, that and which command takes it.
std::string otherKind(const std::string& path, FileKind wanted);

} // namespace rung::compiler
