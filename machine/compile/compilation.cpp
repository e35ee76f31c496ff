// The host's side of the compiler process (see compilation.h): starts it, sends its input, and waits for it with a time
// limit.
#include "machine/compile/compilation.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <signal.h> // NOLINT(modernize-deprecated-headers): kill
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>
#include <string_view>
#include <utility>

#include "machine/compile/sources.h"
#include "rtlib/load/file.h"
#include "rtlib/load/plugin.h"
#include "rtlib/load/trust.h"
#include "rtlib/run/realtime.h"

namespace rung::compile {

namespace {

using Clock = std::chrono::steady_clock;
using runtime::File;

std::string because(const char* what) { return std::string(what) + ": " + std::strerror(errno); }

// Moves a descriptor above the numbers that the process gets, so that none of these is overwritten before it is
// duplicated.
File moved(int fd) {
  constexpr int kFirst = 16;
  File high(fd >= 0 ? fcntl(fd, F_DUPFD_CLOEXEC, kFirst) : -1);
  if (fd >= 0) close(fd);
  return high;
}

struct Pipe {
  File read, write;
  bool make() {
    std::array<int, 2> ends{-1, -1};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) return false;
    read = moved(ends[0]);
    write = moved(ends[1]);
    return read.ok() && write.ok();
  }
};

File memoryFile() { return moved(memfd_create("rung-program", MFD_CLOEXEC | MFD_ALLOW_SEALING)); }

struct SpawnActions {
  posix_spawn_file_actions_t files{};
  posix_spawnattr_t attributes{};
  SpawnActions() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnActions() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
};

// Default signals, and no real-time priority; the process itself lowers its priority further.
void setAttributes(posix_spawnattr_t& attributes) {
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  const sched_param priority{};
  posix_spawnattr_setschedpolicy(&attributes, SCHED_BATCH);
  posix_spawnattr_setschedparam(&attributes, &priority);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSCHEDULER);
}

// The open files of the process; all others of the host are closed.
void setFiles(posix_spawn_file_actions_t& actions, const Pipe& input, const Pipe& answer, int image) {
  posix_spawn_file_actions_adddup2(&actions, input.read.fd(), kInputFile);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, answer.write.fd(), kAnswerFile);
  if (image >= 0) posix_spawn_file_actions_adddup2(&actions, image, kImageFile);
  posix_spawn_file_actions_addclosefrom_np(&actions, image >= 0 ? kImageFile + 1 : kAnswerFile + 1);
}

// Returns the process ID, or 0 with errno. None of the host's memory is copied, which a real-time thread would notice.
pid_t spawned(const std::string& program, const std::vector<std::string>& words, const Pipe& input, const Pipe& answer,
              int image) {
  SpawnActions actions;
  setAttributes(actions.attributes);
  setFiles(actions.files, input, answer, image);
  std::vector<char*> arguments{const_cast<char*>("rung-compile")};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  std::array<char*, 1> environment{nullptr};
  pid_t process = 0;
  errno =
      posix_spawn(&process, program.c_str(), &actions.files, &actions.attributes, arguments.data(), environment.data());
  return errno == 0 ? process : 0;
}

// Writes the input and reads the answer until the process has ended. Returns "", or the error.
std::string exchange(File& to, std::string_view input, const File& from, std::string& answer, size_t most) {
  const auto end = Clock::now() + std::chrono::seconds(Compilation::kMostSeconds);
  fcntl(to.fd(), F_SETFL, O_NONBLOCK);
  std::array<char, 65536> bytes{};
  while (true) {
    if (input.empty() && to.ok()) to = File();
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    std::array<pollfd, 2> waiting{pollfd{from.fd(), POLLIN, 0}, pollfd{to.fd(), POLLOUT, 0}};
    if (left <= 0 || poll(waiting.data(), waiting.size(), static_cast<int>(left)) == 0)
      return "it took more than " + std::to_string(Compilation::kMostSeconds) + " s";
    if (waiting[1].revents != 0) {
      const ssize_t done = write(to.fd(), input.data(), input.size());
      if (done > 0) input.remove_prefix(static_cast<size_t>(done));
      if (done < 0 && errno != EINTR && errno != EAGAIN) input = {}; // the process no longer reads
    }
    if (waiting[0].revents == 0) continue;
    const ssize_t got = read(from.fd(), bytes.data(), bytes.size());
    if (got == 0) return "";
    if (got < 0 && errno != EINTR) return because("its answer cannot be read");
    if (got > 0) answer.append(bytes.data(), static_cast<size_t>(got));
    if (answer.size() > most) return "its answer has more than " + std::to_string(most) + " bytes";
  }
}

// How a process without a complete answer has ended.
std::string endOf(int status) {
  if (!WIFSIGNALED(status)) return "it ended with status " + std::to_string(WEXITSTATUS(status));
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) return "it needed more than " + std::to_string(kMostProcessorSeconds) + " s of processor time";
  std::string text = std::string("it was ended by the signal ") + strsignal(signal);
  if (signal == SIGABRT)
    text += "; the program may need more than " + std::to_string(kMostMemory >> 20) + " MB to be compiled";
  return text;
}

} // namespace

struct Compilation::Outcome {
  std::string answer;  // without the first line
  std::string verdict; // the first line; "" if there is none
  std::string problem; // reason of a failure
};

template <class Work>
void Compilation::begin(Work work) {
  worker_ = std::thread([this, work = std::move(work)] {
    runtime::becomeHelper();
    try {
      work();
    } catch (const std::exception& problem) { // out of memory
      end(State::Failed, problem.what());
    }
  });
}

Compilation::Compilation(std::string packed, Input input) {
  std::vector<std::string> words;
  if (input == Input::Forces) words.emplace_back(kForcesWord);
  begin([this, words = std::move(words), packed = std::move(packed)] { compile(words, packed); });
}

Compilation::Compilation(const std::vector<std::string>& files, uid_t user) {
  std::vector<std::string> words{"--collect", "--user", std::to_string(user), "--"};
  words.insert(words.end(), files.begin(), files.end());
  begin([this, words = std::move(words)] {
    Outcome read = run(words, "", kMostBytes + kMostReport, -1);
    if (read.verdict == kVerdictErrors) return end(State::Errors, std::move(read.answer));
    if (read.verdict != kVerdictSources) return end(State::Failed, read.problem.empty() ? read.answer : read.problem);
    compile({}, read.answer);
  });
}

Compilation::~Compilation() {
  {
    const std::lock_guard lock(changes_);
    ending_ = true;
    if (process_ != 0) kill(process_, SIGKILL);
  }
  if (worker_.joinable()) worker_.join();
  if (image_ >= 0) close(image_);
}

Compilation::State Compilation::wait() {
  if (worker_.joinable()) worker_.join();
  return state();
}

void Compilation::end(State state, std::string report) {
  report_ = std::move(report);
  state_.store(state, std::memory_order_release);
}

// Sets the process to be ended by the destructor; returns false if the result is no longer wanted.
bool Compilation::take(pid_t process) {
  const std::lock_guard lock(changes_);
  process_ = process;
  return !ending_;
}

Compilation::Outcome Compilation::run(const std::vector<std::string>& words, const std::string& input,
                                      size_t mostAnswer, int image) {
  Outcome outcome;
  const std::string program = compilerProgram(outcome.problem);
  if (program.empty()) return outcome;
  Pipe in, answer;
  if (!in.make() || !answer.make()) return {.problem = because("cannot make a pipe to the compiler process")};
  const pid_t process = spawned(program, words, in, answer, image);
  if (process == 0) return {.problem = because(("cannot start " + program).c_str())};
  in.read = File();
  answer.write = File();
  const bool wanted = take(process);
  const std::string wrong =
      wanted ? exchange(in.write, input, answer.read, outcome.answer, mostAnswer) : "it was cancelled";
  int status = 0;
  if (!wrong.empty()) kill(process, SIGKILL);
  siginfo_t ended{};
  while (waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  take(0); // before waitpid, so that the ID is not yet reused
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  const size_t line = outcome.answer.find('\n');
  if (wrong.empty() && WIFEXITED(status) && WEXITSTATUS(status) == 0 && line != std::string::npos) {
    outcome.verdict = outcome.answer.substr(0, line);
    outcome.answer.erase(0, line + 1);
  } else {
    outcome.problem = "the compiler process failed: " + (wrong.empty() ? endOf(status) : wrong);
  }
  return outcome;
}

void Compilation::compile(const std::vector<std::string>& words, const std::string& packed) {
  File image = memoryFile();
  if (!image.ok()) return end(State::Failed, because("cannot make a memory file for the program"));
  Outcome outcome = run(words, packed, kMostReport, image.fd());
  if (outcome.verdict == kVerdictCompiled) {
    image_ = image.release();
    end(State::Compiled, std::move(outcome.answer));
  } else if (outcome.verdict == kVerdictErrors) {
    end(State::Errors, std::move(outcome.answer));
  } else {
    if (outcome.problem.empty()) outcome.problem = "the compiler process gave an unknown answer";
    end(State::Failed, std::move(outcome.verdict == kVerdictFailed ? outcome.answer : outcome.problem));
  }
}

namespace {

constexpr const char* kProgram = RUNG_COMPILE_PROGRAM; // path of an installation

std::string fileProblem(const std::string& path, const runtime::ProcessIds& ids) {
  const int file = open(path.c_str(), O_PATH | O_CLOEXEC);
  const std::optional<runtime::FileFacts> facts = runtime::factsOf(file);
  const std::string problem = facts ? runtime::ownerProblem(*facts, ids) : std::strerror(errno);
  if (file >= 0) close(file);
  return problem;
}

// The path that an unprivileged process uses.
std::string chosenProgram() {
  if (const char* named = secure_getenv("RUNG_COMPILE"); named != nullptr && *named == '/') return named;
  for (const char* place : {"/rung-compile", "/../libexec/rung/rung-compile"}) {
    std::string near = runtime::folderOfProgram() + place;
    if (access(near.c_str(), F_OK) == 0) return near;
  }
  return kProgram;
}

} // namespace

std::string compilerProgram(std::string& problem) {
  const runtime::ProcessIds ids = runtime::idsOfThisThread();
  const bool privileged = runtime::isPrivileged(ids);
  std::string path = privileged ? kProgram : chosenProgram();
  problem = privileged ? runtime::rootsFileProblem(path) : fileProblem(path, ids);
  if (problem.empty()) return path;
  problem = "sources cannot be compiled here: " + path + ": " + problem + "; install the package rung" +
            (privileged ? "" : ", or start the host with RUNG_COMPILE set to the path of rung-compile");
  return {};
}

} // namespace rung::compile
