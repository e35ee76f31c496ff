// Plug-ins: libraries that a program of Rung loads when it first needs them, from lib/rung beside the program's folder,
// in a build as in an installation.
#pragma once
#include <string>
#include <string_view>

namespace rung::runtime {

// The folder of this process's program; "": unknown.
std::string folderOfProgram();

class Plugin {
public:
  /// Loads the file `name`. It is accepted only if its function `rung_plugin_build` returns `build`, a text that
  /// identifies the build, because the interface is C++ and both sides must match. It is never unloaded.
  Plugin(const char* name, std::string_view build);

  bool ok() const { return problem_.empty(); }
  const std::string& problem() const { return problem_; }

  /// A function of a plug-in that is ok(); null if it has no such function.
  template <class Function>
  Function function(const char* name) const {
    return reinterpret_cast<Function>(symbol(name));
  }

private:
  void* symbol(const char* name) const;

  void* library_ = nullptr;
  std::string problem_;
};

} // namespace rung::runtime
