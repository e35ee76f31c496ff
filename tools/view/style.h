// The colours of drawings and pages. A separate picture has the colours for paper; a page refers to them by name, so
// that it can have others in dark mode.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tools/view/sheet.h"

namespace rung::view {

enum class Colour : uint8_t {
  Ink,
  Note, // comments, remarks
  Soft, // addresses, labels, places
  Link,
  Paper,
  Head,  // title bars of boxes, heads of tables
  Line,  // rules
  Found, // the target of a link
  Hit,   // results of a search
  Now,   // the current result
  Warn,  // what never happened
  Part,  // what happened in part
  Good,
  Heat1, // rungs by their share, from the least
  Heat2,
  Heat3,
  Heat4,
  Heat5,
};
inline constexpr size_t kColours = 18;

struct ColourInfo {
  std::string_view name; // of the CSS property of a page: --ink
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

// CSS that sets the properties of a page, light, dark, and as the system prefers; data-theme of the root element
// chooses.
std::string colourRules();

// The space that a text takes. The reader's fonts are not known, so widths are those of wide fonts (DejaVu): in
// narrower ones a text only leaves more space.

enum class Style : uint8_t {
  Name,    // above a contact or coil, in boxes: a symbol or, without one, the address
  Address, // below, where the name is a symbol
  Note,    // the comment of a symbol
  Mark,    // the letter in a contact or coil
  Title,   // the mnemonic of a box
  Pin,     // in a box, beside its wire
  Label,   // in a box: the meaning of an operand
  Remark,  // right of the right rail
  Uses,    // right of the right rail: the rungs that use a coil
  Caption, // headings, by weight
  Module,
  Section,
  Comment,
  Place, // file and line
  Badge, // results of a run, at an element or a rung
};
inline constexpr size_t kStyles = 15;

struct StyleInfo {
  std::string_view cssClass;
  uint32_t size; // size of the font in pixels
  bool mono;
  bool bold;
  bool italic;
  Colour colour;
};
const StyleInfo& infoOf(Style style);

// In pixels, rounded up.
int widthOf(std::string_view text, Style style);
// The distance of two lines, in pixels.
int lineHeight(Style style);

// The text in lines of at most `width` pixels; a longer word is not divided. No line for a blank text.
std::vector<std::string> wrap(std::string_view text, Style style, int width);

// A text with parts that are links.
struct LinkedText {
  struct Part {
    size_t begin = 0;
    size_t end = 0;
    Link link;
  };
  std::string text;
  std::vector<Part> links; // from left to right

  void add(std::string_view more, Link link = {});
};
// Like wrap above, with breaks between `words`.
std::vector<LinkedText> wrap(const std::vector<LinkedText>& words, Style style, int width);

} // namespace rung::view
