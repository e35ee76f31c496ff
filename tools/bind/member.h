// A member of a host's struct by its path, as C writes it: axis[0].position.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "codegen/clang/layout.h"
#include "ir/support/result.h"

namespace rung::bind {

struct Member {
  const codegen::HostMember* is = nullptr;
  uint64_t bit = 0;              // from the begin of the struct
  std::vector<uint64_t> lengths; // of an array that is left

  uint64_t elements() const;
  uint64_t bytes() const { return is->bytes * elements(); }
};

// The member, or what is wrong with the path: "found …, expected …; …".
std::variant<Member, std::string> findMember(const codegen::HostLayout& layout, std::string_view path);

// Every number in the struct with its path, of arrays as a whole but for arrays of structs; those in unions, too.
void forEachNumber(const codegen::HostLayout& layout,
                   const std::function<void(const std::string& path, const Member& member)>& see);

// For which layouts of a host's structs a program is compiled: what `rungc build --binding` takes from the files that
// rungc bind has made.

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
