// Shared objects that engines were made of before, in the folder of the JIT's cache: compiling one takes far longer
// than what a scenario does with it. A file is named by the digest of all that makes it and has a seal: a damaged one
// counts as absent, as does one that others could have written (rtlib/load/trust.h).
#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "ir/support/result.h"

namespace rung::compiler {

// The sealed object of `identity`, which is all that decides its bytes; built where the folder does not have it, and
// then kept there. An empty folder: built. A folder that cannot be used is as good as none: it only takes longer.
Result<std::string> sealedObject(const std::string& folder, std::string_view identity,
                                 const std::function<Result<std::string>()>& build);

} // namespace rung::compiler
