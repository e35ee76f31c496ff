// See plugin.h.
#include "rtlib/load/plugin.h"

#include <dlfcn.h>
#include <unistd.h>

#include <climits>

namespace rung::runtime {

std::string folderOfProgram() {
  char self[PATH_MAX];
  const ssize_t size = readlink("/proc/self/exe", self, sizeof self);
  if (size <= 0) return {};
  const std::string program(self, static_cast<size_t>(size));
  return program.substr(0, program.rfind('/'));
}

namespace {

// Programs are in bin or in a folder below it.
std::string pathOf(const std::string& name) {
  const std::string folder = folderOfProgram();
  const std::string below = folder + "/../lib/rung/" + name;
  const std::string deeper = folder + "/../../lib/rung/" + name;
  return access(below.c_str(), F_OK) != 0 && access(deeper.c_str(), F_OK) == 0 ? deeper : below;
}

} // namespace

Plugin::Plugin(const char* name, std::string_view build) {
  const std::string path = pathOf(name);
  library_ = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); // all symbols are bound now, because a scan may call it
  if (library_ == nullptr) {
    problem_ = dlerror();
    return;
  }
  const auto itsBuild = function<const char* (*)()>("rung_plugin_build");
  if (itsBuild == nullptr || itsBuild() != build)
    problem_ = path + ": it is of another build than this program; install both together";
}

void* Plugin::symbol(const char* name) const { return dlsym(library_, name); }

} // namespace rung::runtime
