// A line on the terminal about long work; it is removed when the work is done.
#pragma once
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "tools/scenario/console.h"

namespace rung::scenario {

class Progress {
public:
  // Shows nothing if `out` is not a terminal, nor in the first two seconds.
  explicit Progress(FILE* out);
  // Begins other work: the two seconds count from now.
  void begin();
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::string_view text); // replaces the line; called several times a second
  void clear();                     // removes the line, before other lines are printed
  double seconds() const;           // since the work began

private:
  FILE* out_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_;
  double last_ = 0; // seconds() at the last update
};

// A progress line for work of unknown length: a thread shows how long it has taken.

class Working {
public:
  // Shows "WHAT, 12 s" on standard error, if that is a terminal, from the third second on until this is destroyed.
  // Nothing else may be printed meanwhile.
  explicit Working(std::string what);
  ~Working();
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;

  void say(std::string what); // replaces WHAT

private:
  void show();

  std::string what_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool ended_ = false;
  std::thread thread_; // runs only if there is a terminal
};

// Lines typed at a terminal, with editing, history and completion (libedit).

// Number of the last signal, written by the signal handler; 0 for none.
using Signal = volatile std::sig_atomic_t;

class LineEditor {
public:
  // Completions of the last word of `line`, which is the input up to the cursor.
  using Complete = std::function<std::vector<std::string>(std::string_view line)>;

  // For standard input and output, which must be a terminal. While a line is read, SIGINT in `signal` discards it and
  // any other signal ends the input; handlers for both must be installed.
  LineEditor(Complete complete, Signal& signal);
  ~LineEditor();
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  // The line without its line break. Nothing at the end of the input (Ctrl-D in an empty line); a discarded line
  // (Ctrl-C) is empty.
  std::optional<std::string> read(const std::string& prompt);

private:
  struct State;
  std::unique_ptr<State> state_;
};

// The prompt: executes lines from a terminal, with editing, or from a file or pipe, until quit or the end of the input.

// True: no line failed. Always true at a terminal, where the user can correct a failed line. SIGINT in `signal`
// interrupts a statement, any other signal ends the prompt. `begins` is called before every line.
bool runPrompt(Interpreter& console, Signal& signal, const std::function<void()>& begins);

} // namespace rung::scenario
