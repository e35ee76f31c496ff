// dlopen with checks that say what to do.
#include "rtlib/host/so_engine.h"

#include <dlfcn.h>

#include <utility>

#include "rtlib/host/program_info.h"

namespace rung::host {

SoEngine::SoEngine(void* library, const rung_program* program, std::string path)
    : library_(library), program_(program), path_(std::move(path)) {}

SoEngine::~SoEngine() { dlclose(library_); }

std::unique_ptr<SoEngine> SoEngine::open(const std::string& path, std::string& error, Loaded loaded) {
  // A name without a slash would be searched for in the system's folders.
  const std::string file = path.find('/') == std::string::npos ? "./" + path : path;
  const int stays = loaded == Loaded::WithProcess ? RTLD_NODELETE : 0;
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL | stays);
  if (library == nullptr) {
    const char* reason = dlerror();
    error = "cannot load " + path + ": " + (reason != nullptr ? reason : "unknown reason");
    return nullptr;
  }
  const auto* program = static_cast<const rung_program*>(dlsym(library, RUNG_PROGRAM_SYMBOL));
  error.clear();
  if (program == nullptr) {
    error = path + " is not a compiled PLC program: it has no symbol " RUNG_PROGRAM_SYMBOL;
  } else if (const std::string wrong = checkProgram(*program); !wrong.empty()) {
    error = path + " cannot be run: " + wrong + "; compile it again";
  }
  if (!error.empty()) {
    dlclose(library);
    return nullptr;
  }
  return std::unique_ptr<SoEngine>(new SoEngine(library, program, path));
}

} // namespace rung::host
