// The prompt's loop (see prompt.h).
#include "tools/scenario/prompt.h"

#include <iostream>
#include <optional>
#include <unistd.h>
namespace rung::scenario {
namespace {

bool ends(Signal& signal) { return signal != 0 && signal != SIGINT; }

void runTerminal(Console& console, Signal& signal, const std::function<void()>& begins) {
  LineEditor editor([&](std::string_view line) { return console.completions(line); }, signal);
  std::cout << "Statements as in a scenario; Tab completes, help lists them, quit ends." << std::endl;
  while (!ends(signal)) {
    const std::optional<std::string> line = editor.read(console.prompt());
    if (!line) std::cout << std::endl; // the shell's prompt gets a line of its own
    if (!line || ends(signal)) return;
    begins();
    if (console.execute(*line) == Outcome::Quit) return;
    if (signal != SIGINT) continue;
    signal = 0;
    std::cout << "interrupted" << std::endl;
  }
}

} // namespace

bool runPrompt(Console& console, Signal& signal, const std::function<void()>& begins) {
  if (isatty(STDIN_FILENO) != 0 && isatty(STDOUT_FILENO) != 0) {
    runTerminal(console, signal, begins);
    return true;
  }
  bool passed = true;
  for (std::string line; signal == 0 && std::getline(std::cin, line);) {
    begins();
    const Outcome outcome = console.execute(line);
    if (outcome == Outcome::Quit) break;
    passed = passed && outcome != Outcome::Failed;
  }
  return passed;
}

} // namespace rung::scenario
