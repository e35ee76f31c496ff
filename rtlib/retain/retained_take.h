// The retained memory that another program has left: the cells of this one are found there by name and by address, as
// when it takes over from a running one (see state_transfer.h).
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/change/state_transfer.h"
#include "rtlib/retain/retain.h"

namespace rung::runtime {

// `initial` and the result are images of the description `now`, `image` is one of `former`. What `former` does not have
// is as in `initial`.
struct RetainedTaken {
  bool good = false; // a description is none, the dialect is another, or an image has another size
  std::vector<uint8_t> image;
  std::vector<StateChange> changes;
  std::string otherDialect; // of `former`, where that is why; else ""
};
RetainedTaken takeRetained(std::string_view now, std::string_view former, std::span<const uint8_t> image,
                           std::span<const uint8_t> initial);

// The image of another program, as it was found, becomes one of this program, whose map that is; or stays not found.
// The report says what becomes of the cells.
using RetainTake = void (*)(const rung_program& program, const RetainMap& map, RetainImage& image);
void takeRetainedOf(const rung_program& program, const RetainMap& map, RetainImage& image);

} // namespace rung::runtime
