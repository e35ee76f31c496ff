// The commands rungctl messages and rungctl log.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "machine/rungctl/words.h"

namespace rung::rungctl {

// Both return the exit status. `stop` becomes other than 0 when the user interrupts the command.
int messages(Client& client, const Words& words, const volatile int& stop);
int log(Client& client, const Words& words, const volatile int& stop);
// The log in a file, which may be that of a host that does not run.
int logFile(const Words& words);

// "2026-11-29 14:38:04 - 14:38:09  message 3 DOOR IS OPEN".
std::string entryText(const nlohmann::json& entry);

// A point of time: "2026-11-29", "2026-11-29 14:38", "14:38:05" (today), or "90s", "10m", "2h", "3d" before `nowS`.
// Returns seconds since 1970; nothing: it is none.
std::optional<int64_t> timeOf(const std::string& text, int64_t nowS);

} // namespace rung::rungctl
