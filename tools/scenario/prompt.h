// The prompt: lines from a terminal, with editing, or from a file or pipe, until quit or the end of the input.
#pragma once
#include <functional>

#include "tools/scenario/console.h"
#include "tools/scenario/line_editor.h"

namespace rung::scenario {

// True: no line failed. At a terminal a line that failed is the person's to put right: there it is always true.
// SIGINT in `signal` interrupts a statement, another one ends the prompt. `begins` is called before every line.
bool runPrompt(Console& console, Signal& signal, const std::function<void()>& begins);

} // namespace rung::scenario
