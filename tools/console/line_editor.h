// Lines typed at a terminal, with editing, history and completion (libedit).
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rung::console {

class LineEditor {
public:
  // What the last word of a line can become; the line is that before the cursor.
  using Complete = std::function<std::vector<std::string>(std::string_view line)>;
  // Asked when a signal has arrived: true ends the input.
  using Ended = std::function<bool()>;

  // On standard input and output, which are a terminal.
  LineEditor(Complete complete, Ended ended);
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

} // namespace rung::console
