// Parses the contents of a rung's braces, and its transfer. A part of the parser in parser.cpp.
#pragma once
#include <map>
#include <string>
#include <string_view>

#include "ir/core/module.h"
#include "ir/text/scanner.h"

namespace rung::ir {

using NameIndex = std::map<std::string, uint32_t, std::less<>>;

// The index from a reference: `-`, `#N` or a known name.
uint32_t parseReference(Scanner& scanner, const NameIndex& names, std::string_view kind);
// A place SPACE[unit] or SPACE[unit+rest], in bytes; that of a bit as SPACE[unit.bit].
struct ParsedPlace {
  uint32_t space = RUNG_NONE;
  int64_t bitOffset = 0;
  uint32_t count = 0; // of a window
};
enum class PlaceForm { Byte, Bit, Window };
ParsedPlace parsePlace(Scanner& scanner, const Module& module, const NameIndex& spaces, PlaceForm form);
Type parseType(Scanner& scanner);
int64_t parseLiteral(Scanner& scanner, Type type);

struct ModuleNames {
  NameIndex files, spaces, faults, services, routines, tasks;
};

class RungParser {
public:
  RungParser(Scanner& scanner, const Module& module, const ModuleNames& names, Rung& rung)
      : scanner_(scanner), module_(module), names_(names), rung_(rung) {}

  // Parses source lines and operations up to the closing brace.
  void parseBody();
  // The name of the callee of a call, to be resolved when all routines are known; empty for other transfers. `-` and
  // `#N` are resolved at once.
  std::string parseTransfer();

private:
  void parseSource(bool first);
  void parseOp();
  void parseResults(Op& op);
  void parseName(Op& op);
  // Whether there was an attribute, so that a comma precedes the operands.
  bool parseAttribute(Op& op);
  void parseOperands(Op& op, bool comma);
  ValueId parseValue();

  Scanner& scanner_;
  const Module& module_;
  const ModuleNames& names_;
  Rung& rung_;
};

} // namespace rung::ir
