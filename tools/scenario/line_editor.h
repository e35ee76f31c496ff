// Lines typed at a terminal, with editing, history and completion (libedit).
#pragma once
#include <csignal>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rung::scenario {

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

} // namespace rung::scenario
