// How much room a text takes. The fonts of the reader are not known, so widths are those of wide fonts (DejaVu): in
// narrower ones a text only leaves more room.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tools/view/colours.h"
#include "tools/view/sheet.h"

namespace rung::view {

enum class Style : uint8_t {
  Name,    // above a contact or coil, in boxes: a symbol or, without one, the address
  Address, // below, where the name is a symbol
  Note,    // the comment of a symbol
  Mark,    // the letter in a contact or coil
  Title,   // the mnemonic of a box
  Pin,     // in a box, beside its wire
  Label,   // in a box: what an operand is
  Remark,  // right of the right rail
  Uses,    // there: the rungs that use a coil
  Caption, // headings, in the order of their weight
  Module,
  Section,
  Comment,
  Place, // file and line
  Badge, // at an element, a rung: what a run of the program says of it
};
inline constexpr size_t kStyles = 15;

struct StyleInfo {
  std::string_view cssClass;
  uint32_t size; // of the font, in pixels
  bool mono;
  bool bold;
  bool italic;
  Colour colour;
};
const StyleInfo& infoOf(Style style);

// In pixels, rounded up.
int widthOf(std::string_view text, Style style);
// The distance of two lines.
int lineHeight(Style style);

// The text in lines of at most `width` pixels; a longer word stays whole. No line for a blank text.
std::vector<std::string> wrap(std::string_view text, Style style, int width);

// A text with parts that lead somewhere.
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
// As wrap, between `words`.
std::vector<LinkedText> wrap(const std::vector<LinkedText>& words, Style style, int width);

} // namespace rung::view
