// Loads a program and says how it went: load_program FILE [KEYS_FOLDER]. The tests run it as setuid root; then it sets
// its users as LinuxCNC's rtapi_app does.
#include <cstdio>
#include <sys/fsuid.h>
#include <unistd.h>

#include "rtlib/load/so_engine.h"

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const uid_t started = getuid();
  if (geteuid() == 0 && started != 0) {
    if (setresuid(0, 0, started) != 0) return 2;
    setfsuid(started);
  }
  rung::runtime::SoOptions options{.mayLackSeal = true};
  if (argc > 2) options.keysFolder = argv[2];
  std::string error;
  const auto engine = rung::runtime::SoEngine::open(argv[1], error, options);
  std::puts(engine != nullptr ? "loaded" : error.c_str());
  setfsuid(geteuid()); // what an instrumented build writes at its end goes to root's folder
  return engine != nullptr ? 0 : 1;
}
