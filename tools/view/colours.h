// The colours of drawings and pages. A picture of its own has those of paper; a page names them, so that it can
// have others in the dark.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace rung::view {

enum class Colour : uint8_t {
  Ink,
  Note, // comments, remarks
  Soft, // addresses, labels, places
  Link,
  Paper,
  Head,  // the bar of a box, the heads of tables
  Line,  // rulings
  Found, // what a link leads to
  Hit,   // what a search found
  Now,   // of them the one that is shown
  Warn,  // what never happened
  Part,  // what happened in part
  Good,
  Heat1, // rungs by what they take, from the least
  Heat2,
  Heat3,
  Heat4,
  Heat5,
};
inline constexpr size_t kColours = 18;

struct ColourInfo {
  std::string_view name; // of the property of a page: --ink
  std::string_view light;
  std::string_view dark;
};

inline constexpr std::array<ColourInfo, kColours> kColourInfos = {{
    {"ink", "#111", "#e6e8ea"},
    {"note", "#333", "#c6ccd2"},
    {"soft", "#555", "#9fa8b2"},
    {"link", "#0a4a86", "#7fb8f2"},
    {"paper", "#fff", "#14171a"},
    {"head", "#e8edf3", "#262d35"},
    {"line", "#bbb", "#4a525b"},
    {"found", "#fff7d6", "#3a3312"},
    {"hit", "#ffd84d", "#8a6a00"},
    {"now", "#ffa51f", "#c26a00"},
    {"warn", "#a3160b", "#ff8c7d"},
    {"part", "#8a5200", "#f0b45a"},
    {"good", "#1c6b2d", "#6fcf86"},
    {"heat1", "#f3d9a8", "#4b3a1c"},
    {"heat2", "#f2b45c", "#7a5314"},
    {"heat3", "#e8842a", "#b56a12"},
    {"heat4", "#cf4a12", "#e58a33"},
    {"heat5", "#8f1206", "#ffb98a"},
}};

constexpr const ColourInfo& infoOf(Colour colour) { return kColourInfos[static_cast<size_t>(colour)]; }

} // namespace rung::view
