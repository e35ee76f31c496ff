// See services.h.
#include "machine/host/services.h"

namespace rung::host {
namespace {

class NoTranslation final : public Translation {};

} // namespace

const Translation& translationOf(std::string_view dialect) {
  static constexpr NoTranslation kNone;
  if (dialect == "fanuc") return fanucTranslation();
  if (dialect == "gsk") return gskTranslation();
  return dialect == "nct" ? nctTranslation() : kNone;
}

} // namespace rung::host
