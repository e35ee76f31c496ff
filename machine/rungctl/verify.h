// The command rungctl verify: whether the machine runs a program.
#pragma once
#include "machine/rungctl/words.h"

namespace rung::rungctl {

// Exit statuses of `verify`.
inline constexpr int kSameProgram = 0;
inline constexpr int kOtherProgram = 1;
inline constexpr int kUnknownProgram = 2;

// Compares the program that the host runs with a compiled program, or with sources, which are compiled here, by a
// process of their own. The host compiles and loads nothing. Returns an exit status of the above.
int verify(const Words& words);

} // namespace rung::rungctl
