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
  uint64_t bit = 0;              // offset from the beginning of the struct
  std::vector<uint64_t> lengths; // remaining dimensions of an array

  uint64_t elements() const;
  uint64_t bytes() const { return is->bytes * elements(); }
};

// The member, or what is wrong with the path: "found …, expected …; …".
std::variant<Member, std::string> findMember(const codegen::HostLayout& layout, std::string_view path);

// Visits every number in the struct, including those in unions, with its path. An array is visited as a whole, an array
// of structs element by element.
void forEachNumber(const codegen::HostLayout& layout,
                   const std::function<void(const std::string& path, const Member& member)>& see);

// The layouts of a host's structs for which a program is compiled: `rungc build --binding` takes them from the files
// that rungc bind has made.

struct Claim {
  std::string name; // name of the struct
  std::string text; // rung_layout::text
};

uint64_t hashOf(std::string_view text);

// A C comment with the claim, which claimIn finds again.
std::string claimText(std::string_view name, std::string_view text);

// Fails if the file was not made by rungc bind, or was changed by hand.
Result<Claim> claimIn(std::string_view file);

} // namespace rung::bind
