// See put.h.
#include "ir/support/put.h"

#include <iterator>

namespace rung {

void putFormatted(std::string& out, fmt::string_view format, fmt::format_args args) {
  fmt::vformat_to(std::back_inserter(out), format, args);
}

} // namespace rung
