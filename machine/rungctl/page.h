// The pages of rungctl top as lines of text, for a terminal of any size and for `top --once`.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "machine/rungctl/look.h"

namespace rung::rungctl {

enum class Section : uint8_t { Overview, Rungs, Timers, Pins, Messages, Waiting, Log };
inline constexpr size_t kSections = 7;

// What a user has chosen.
struct View {
  Section section = Section::Overview;
  bool byLongest =
      false;           // rungs: by the longest run, otherwise by time; pins: by name, otherwise the last changed first
  size_t scrolled = 0; // lines of the section that are above the page
};

enum class Style : uint8_t { Plain, Heading, Alarm, Faint };

struct Line {
  std::string text;
  Style style = Style::Plain;
};

// The lines of a page with exactly `height` lines of at most `width` columns; the last one names the keys. `problem`
// is why the look is an old one; "": it is not.
std::vector<Line> pageOf(const Look& look, const View& view, const std::string& problem, size_t width, size_t height);
// All sections, one after the other, as long as they are.
std::string wholeText(const Look& look);

// The number of columns of a text, as far as it has one a character; the text cut to `width` of them.
std::string cutTo(std::string text, size_t width);

} // namespace rung::rungctl
