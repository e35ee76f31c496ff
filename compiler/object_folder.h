// Shared objects of engines made earlier, in the folder of the JIT's cache: compiling one takes far longer than running
// a scenario with it. A file is named by the digest of everything that determines it and has a seal: a damaged file
// counts as absent, as does one that other users could have written (rtlib/load/trust.h).
#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "ir/support/result.h"

namespace rung::compiler {

// The sealed object with this `identity`, which determines its bytes; if the folder does not contain it, it is built
// and stored there. With an empty folder name, or a folder that cannot be used, it is built every time.
Result<std::string> sealedObject(const std::string& folder, std::string_view identity,
                                 const std::function<Result<std::string>()>& build);

} // namespace rung::compiler
