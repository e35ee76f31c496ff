// The prompt: lines from a terminal, with editing, or from a file or pipe, until quit or the end of the input.
#pragma once
#include <csignal>
#include <functional>

#include "tools/console/console.h"

namespace rung::console {

// Signals between a handler and what it interrupts: the number of the last one, 0 for none.
using Signal = volatile std::sig_atomic_t;

// True: no line failed. At a terminal a line that failed is the person's to put right: there it is always true.
// SIGINT in `signal` interrupts a statement, another one ends the prompt. `begins` is called before every line.
bool runPrompt(Console& console, Signal& signal, const std::function<void()>& begins);

} // namespace rung::console
