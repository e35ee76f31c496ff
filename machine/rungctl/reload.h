// The commands rungctl reload, with a compiled program or sources that the host compiles, and rungctl rollback.
#pragma once
#include <string>

#include "machine/rungctl/words.h"

namespace rung::rungctl {

// Returns the exit status. `stop` becomes other than 0 when the user interrupts the command.
int reload(Client& client, const Words& words, const volatile int& stop);
int rollback(Client& client, const Words& words);

// "changed rung 4 "lamps", mill.pmc:12", of the list `rungs` in an answer.
std::string rungLine(const nlohmann::json& rung);

} // namespace rung::rungctl
