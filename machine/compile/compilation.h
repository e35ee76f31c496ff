// Compiles sources in a process of its own, which the host starts, in which nothing of the host's can be reached
// (docs/security.md). What it does wrong harms that process alone.
#pragma once
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace rung::compile {

// A process that has been started, for the thread that has done it.
class Compilation {
public:
  enum class State : uint8_t {
    Running,
    Compiled, // `image` has the program
    Errors,   // of the sources: `report` has them as rungc prints them
    Failed,   // `report` says why
  };
  enum class Input : uint8_t {
    Sources, // packed (sources.h)
    Forces,  // the same (forces.h)
  };
  static constexpr unsigned kMostSeconds = 60; // of the clock

  // Starts to compile them; any bytes may be given. The process has a lower priority than all of the host, and takes
  // them for nothing else than `input`.
  explicit Compilation(std::string packed, Input input = Input::Sources);
  // Starts to compile these files, which that process reads first, with the rights of `user`: sources, or a project.
  Compilation(const std::vector<std::string>& files, uid_t user);
  // Ends the process where it still runs.
  ~Compilation();
  Compilation(const Compilation&) = delete;
  Compilation& operator=(const Compilation&) = delete;

  State state() const { return state_.load(std::memory_order_acquire); }
  // For sources that are read here and now.
  State wait();
  // From here on not while it runs.
  const std::string& report() const { return report_; } // also warnings of a program that is compiled
  // A memory file, for rung_image_open_memory, of a program that is compiled; as long as the compilation.
  int image() const { return image_; }

private:
  struct Process;
  struct Outcome;
  template <class Work>
  void begin(Work work);
  Outcome run(const std::vector<std::string>& words, const std::string& input, size_t mostAnswer, int image);
  void compile(const std::vector<std::string>& words, const std::string& packed);
  void end(State state, std::string report);
  bool take(pid_t process);

  std::atomic<State> state_{State::Running};
  std::string report_;
  int image_ = -1;
  std::mutex changes_; // of these two
  pid_t process_ = 0;  // 0: none runs
  bool ending_ = false;
  std::thread worker_;
};

// The program that a host starts to compile sources, rung-compile.

// Its path. An unprivileged process (rtlib/load/trust.h) takes the one of the environment variable RUNG_COMPILE, if
// that is set, or else one beside its own program, where a build has it, or where an installation below the prefix of
// that program has it. Empty, and `problem` says why: it is not there, or others than root, or the process's own user,
// could have changed it.
std::string compilerProgram(std::string& problem);

} // namespace rung::compile
