// A line on the terminal about work that takes long; it is gone when the work is done.
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
  // Shows nothing when `out` is not a terminal, nor in the first two seconds.
  explicit Progress(FILE* out);
  // Other work begins: the two seconds count from now.
  void begin();
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void show(std::string_view text); // in place of what it showed before; some times a second
  void clear();                     // before other lines are printed
  double seconds() const;           // since the work began

private:
  FILE* out_;
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_;
  double last_ = 0; // shown at so many seconds
};

// A progress line about work that cannot say how far it is: a thread of its own shows how long it takes.

class Working {
public:
  // Shows "WHAT, 12 s" on standard error, when that is a terminal, from the third second on until this is destroyed.
  // Nothing else may be printed meanwhile.
  explicit Working(std::string what);
  ~Working();
  Working(const Working&) = delete;
  Working& operator=(const Working&) = delete;

  void say(std::string what); // in place of what it showed before

private:
  void show();

  std::string what_;
  std::mutex mutex_;
  std::condition_variable ends_;
  bool ended_ = false;
  std::thread thread_; // only where there is a terminal
};

// Lines typed at a terminal, with editing, history and completion (libedit).

// Signals between a handler and what it interrupts: the number of the last one, 0 for none.
using Signal = volatile std::sig_atomic_t;

class LineEditor {
public:
  // What the last word of a line can become; the line is that before the cursor.
  using Complete = std::function<std::vector<std::string>(std::string_view line)>;

  // On standard input and output, which are a terminal. While a line is read, SIGINT in `signal` gives it up and
  // another signal ends the input; handlers for both are installed.
  LineEditor(Complete complete, Signal& signal);
  ~LineEditor();
  LineEditor(const LineEditor&) = delete;
  LineEditor& operator=(const LineEditor&) = delete;

  // Without its end. Nothing at the end of the input (Ctrl-D in an empty line); a line that was given up (Ctrl-C) is
  // empty.
  std::optional<std::string> read(const std::string& prompt);

private:
  struct State;
  std::unique_ptr<State> state_;
};

// The prompt: lines from a terminal, with editing, or from a file or pipe, until quit or the end of the input.

// True: no line failed. At a terminal a line that failed is the person's to put right: there it is always true.
// SIGINT in `signal` interrupts a statement, another one ends the prompt. `begins` is called before every line.
bool runPrompt(Console& console, Signal& signal, const std::function<void()>& begins);

} // namespace rung::scenario
