// Id<Tag>: a small typed index into a vector; ids of different tags are different types.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace rung {

template <typename Tag>
struct Id {
  static constexpr uint32_t kNoneIndex = UINT32_MAX;

  uint32_t index = kNoneIndex;

  constexpr bool valid() const { return index != kNoneIndex; }
  constexpr auto operator<=>(const Id&) const = default;
};

} // namespace rung

template <typename Tag>
struct std::hash<rung::Id<Tag>> {
  size_t operator()(rung::Id<Tag> id) const noexcept { return std::hash<uint32_t>()(id.index); }
};
