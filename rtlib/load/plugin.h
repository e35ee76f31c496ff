// Plug-ins: libraries that one of Rung's programs loads when it first needs them, from lib/rung beside the folder of
// the program, as in a build and an installation.
#pragma once
#include <string>
#include <string_view>

namespace rung::runtime {

// The folder of this process's program; "": unknown.
std::string folderOfProgram();

class Plugin {
public:
  /// `name`: of the file. It is used only if its function `rung_plugin_build` gives `build`, a text for whatever has to
  /// be the same on both sides, since C++ goes between them. It stays loaded.
  Plugin(const char* name, std::string_view build);

  bool ok() const { return problem_.empty(); }
  const std::string& problem() const { return problem_; }

  /// Of a plug-in that is ok; null where it has no such function.
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
