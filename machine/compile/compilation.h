// Compiles sources in a separate process, which the host starts and which has no access to the host (docs/security.md).
// Errors of the compiler harm only that process.
#pragma once
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <sys/types.h>

namespace rung::compile {

// A compiler process. All functions are for the thread that has created the object; an internal thread waits for the
// process.
class Compilation {
public:
  enum class State : uint8_t {
    Running,
    Compiled, // `image` returns the program
    Errors,   // in the sources: `report` has them as rungc prints them
    Failed,   // `report` has the reason
  };
  enum class Input : uint8_t {
    Sources, // packed (sources.h)
    Forces,  // packed (forced_code_maker.h)
  };
  static constexpr unsigned kMostSeconds = 60; // wall-clock time

  // Starts to compile packed sources or forces; `packed` may be any bytes. The process has a lower priority than every
  // thread of the host, and accepts the bytes only as `input`.
  explicit Compilation(std::string packed, Input input = Input::Sources);
  // Starts to compile these files (sources, or a project); the process reads them first, with the rights of `user`.
  Compilation(const std::vector<std::string>& files, uid_t user);
  // Ends the process if it still runs.
  ~Compilation();
  Compilation(const Compilation&) = delete;
  Compilation& operator=(const Compilation&) = delete;

  State state() const { return state_.load(std::memory_order_acquire); }
  // Waits until the process has ended: for a host that compiles its program when it starts.
  State wait();
  // The functions below must not be called while the process runs.
  const std::string& report() const { return report_; } // errors, or the warnings of a compiled program
  // A memory file with the compiled program, for rung_image_open_memory; valid as long as this object.
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
  std::mutex changes_; // protects process_ and ending_
  pid_t process_ = 0;  // 0: no process runs
  bool ending_ = false;
  std::thread worker_;
};

// Finds rung-compile, the program that a host starts to compile sources.

// An unprivileged process (rtlib/load/trust.h) uses the environment variable RUNG_COMPILE, if it is set. Otherwise the
// program is beside the host's own program, as in a build, or where an installation with the same prefix has it.
// Returns an empty path, with the reason in `problem`, if the program does not exist, or if users other than root and
// the process's own could have changed it.
std::string compilerProgram(std::string& problem);

} // namespace rung::compile
