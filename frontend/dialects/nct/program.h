// A checked program: modules, their bodies, and rungs whose elements have their row and their operands.
#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "frontend/dialects/nct/read/symbols.h"
#include "frontend/dialects/nct/rows/instructions.h"
#include "frontend/ladder/text/ladder_file.h"

namespace rung::frontend::nct {

struct TypedElement {
  const ladder::Element* element = nullptr;
  const Row* row = nullptr;  // null: an error was reported
  uint32_t firstOperand = 0; // index in TypedRung::operands
  uint32_t operandCount = 0;
  std::optional<uint32_t> label; // of JMP, JME, SBS, SBN
};

struct TypedRung {
  const ladder::LadderFile* file = nullptr;
  const ladder::Rung* rung = nullptr;
  uint32_t number = 0;                // as drawn, see ir::Rung
  bool bad = false;                   // an error in it was reported
  std::vector<TypedElement> elements; // in the order of evaluation
  std::vector<Operand> operands;

  std::span<const Operand> operandsOf(const TypedElement& e) const {
    return std::span(operands).subspan(e.firstOperand, e.operandCount);
  }
};

// The rungs of a module up to END, or a subroutine.
struct Body {
  uint32_t first = 0; // index in TypedModule::rungs
  uint32_t end = 0;
  std::optional<uint32_t> number; // of the subroutine
};

inline constexpr uint32_t kLabels = 100; // numbers 0 to 99, l.2942

struct TypedModule {
  std::string_view name;
  SourceRange range;                            // of its last `module` statement
  const ladder::LadderFile* lastFile = nullptr; // the file with that statement
  bool exists = false;
  bool partial = false; // a second module of its name was reported
  std::vector<TypedRung> rungs;
  std::vector<uint32_t> parts;                                // first rung of the part in each file
  std::vector<Body> bodies;                                   // [0] is the main part
  std::array<std::optional<uint32_t>, kLabels> labels{};      // JME: index of its rung
  std::array<std::optional<uint32_t>, kLabels> subroutines{}; // SBN: index of its body
};

struct Program {
  TypedModule main = named("MAIN");
  TypedModule int0 = named("INT0");

private:
  static TypedModule named(std::string_view name) {
    TypedModule module;
    module.name = name;
    return module;
  }
};

} // namespace rung::frontend::nct
