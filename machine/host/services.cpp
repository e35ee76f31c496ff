// See services.h.
#include "machine/host/services.h"

namespace rung::host {

const Translation& translationOf(std::string_view dialect) {
  static constexpr Translation kNone;
  if (dialect == "gsk") return gskTranslation();
  return dialect == "nct" ? nctTranslation() : kNone;
}

} // namespace rung::host
