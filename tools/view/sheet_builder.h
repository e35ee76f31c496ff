// Builds a sheet of cells from the drawing of a rung in its source and from the meaning of its operands.
#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "frontend/ladder/text/drawing.h"
#include "tools/view/names.h"
#include "tools/view/sheet.h"

namespace rung::view {

struct OperandUse {
  const Named& named;
  std::string_view operand; // as written
  bool writes = false;
  bool coil = false;
  uint32_t row = 0; // row of its element
};

// Receives the uses in a sheet while it is built, for the program's lists. Each function returns the link of an
// operand; its target is settled when all rungs have been read.
class SheetListener {
public:
  virtual ~SheetListener() = default;
  virtual Link onUse(const OperandUse& use) = 0;
  virtual Link onTarget(const frontend::TargetUse& target, uint32_t row) = 0;
};

// Texts of messages by number (NCT) or bit (GSK).
using Texts = std::unordered_map<std::string, std::string>;

struct SheetContext {
  frontend::ladder::FindBox findBox;
  Names& names;
  const Texts& texts;
  std::function<Place(SourcePos drawn)> placeOf; // position of an element in the author's files
  bool hasTables = false;                        // boxes may have values after the word TABLE
};

// A message's number as its key in the list of uses.
std::string messageKey(std::string_view number);

Sheet buildSheet(const SheetContext& context, const frontend::ladder::Drawing& drawing, SheetListener& listener);
// The networks of a chart's rung, one below the other; `file` is that of its positions.
Sheet buildSheet(const frontend::chart::Rung& rung, uint32_t file, Names& names, SheetListener& listener);

// A coil or box with nothing to its right in any of its rows leads to the right rail.
void findClosing(Sheet& sheet);

} // namespace rung::view
