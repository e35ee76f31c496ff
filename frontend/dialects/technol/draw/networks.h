// The statements of a rung as networks: RLO is the power of a ladder, the stack its branches, DR the contents of boxes
// (man. ch. 3.5-3.7).
#pragma once
#include <span>

#include "frontend/chart/chart.h"
#include "frontend/dialects/technol/check/typed.h"

namespace rung::frontend::technol {

// Adds the networks of these statements, which follow each other, to the rung. What happens to RLO, DR and the stack
// before them is not known: a value that they bring is a contact RLO or STACK, and RLO that nothing here takes is a
// coil.
void addNetworks(const TypedProgram& program, std::span<const uint32_t> statements, chart::Rung& rung);

// The comment after a statement's line.
std::string_view commentAfter(const SourceProgram& program, const Statement& statement);

// Networks as text: conditions are names with · for and, + for or, ⊕ for exclusive or, / for not.

// Each output of a network with its condition: "S O_BRAKE if O_CCW". The output of the statement `without` is left out.
std::vector<std::string> outputTexts(const chart::Rung& rung, uint32_t network, uint32_t without);
// The condition of the statement's output in the rung; "" if it has none.
std::string conditionOf(const chart::Rung& rung, uint32_t statement);
// The opposite of a condition.
std::string oppositeOf(std::string condition);

} // namespace rung::frontend::technol
