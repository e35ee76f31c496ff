// The commands rungctl web and rungctl why: rungc, which has the compiler, does their work.
#pragma once
#include "machine/rungctl/words.h"

namespace rung::rungctl {

// They return only if rungc cannot be started.
int web(Client& client, const Words& words);
int why(Client& client, const Words& words);

} // namespace rung::rungctl
