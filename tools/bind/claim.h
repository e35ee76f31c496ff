// For which layouts of a host's structs a program is compiled: what `rungc build --binding` takes from the files that
// rungc bind has made.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "ir/support/result.h"

namespace rung::bind {

struct Claim {
  std::string name; // of the struct
  std::string text; // rung_layout::text
};

uint64_t hashOf(std::string_view text);

// A comment of C with the claim, which claimIn finds again.
std::string claimText(std::string_view name, std::string_view text);

// Fails where the file is not one of rungc bind, or was changed by hand.
Result<Claim> claimIn(std::string_view file);

} // namespace rung::bind
