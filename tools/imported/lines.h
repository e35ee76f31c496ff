// Lines of a file, and their fields.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/pmc_address.h"
#include "rtlib/text/position.h"

namespace rung::imported {

struct Line {
  std::string_view text; // without its end
  uint32_t number = 1;
};

// Up to the end-of-file mark of DOS.
std::vector<Line> linesOf(std::string_view text);
bool isBlank(const Line& line);

// The position of a byte of the line; its column counts characters.
text::Position positionOf(const Line& line, size_t offset);

struct Field {
  std::string text; // without blanks at both ends, and without the quotes of a quoted field
  text::Position at;
};

// The fields between commas. A field in quotes may have commas in it; `""` in it is a quote.
std::vector<Field> fieldsOf(const Line& line);

// X8.4, as a scenario writes it: without leading zeros and the number of the PMC.
std::string nameOf(const PmcAddress& address);

// A text of the file as a part of a comment: without control characters.
std::string asShown(std::string_view text);
// As a part of a remark: not longer than a line either.
std::string inBrief(std::string_view text);

} // namespace rung::imported
