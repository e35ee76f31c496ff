// Libraries of a program of ours that it loads when it first needs them: those in lib/rung below the folder that its
// own folder lies in, as they are built and installed.
#pragma once
#include <string>
#include <string_view>

namespace rung::runtime {

// Where the program lies that this process runs; "" where the system does not say.
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
