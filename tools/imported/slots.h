// Time as scenarios of a FANUC PMC pass it.
#pragma once
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "rtlib/nc/pmc/slot.h"

namespace rung::imported {

using nc::pmc::kSlotUs;

// The slots that last at least so long; `us` is 0 or more.
constexpr int64_t slotsOf(int64_t us) { return (us + kSlotUs - 1) / kSlotUs; }

// The statement that runs so many slots, with its line end; "" for none.
inline std::string slotsText(int64_t slots) {
  return slots == 0 ? "" : slots == 1 ? "slot\n" : fmt::format("slot {}\n", slots);
}

} // namespace rung::imported
