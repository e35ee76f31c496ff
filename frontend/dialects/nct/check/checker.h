// Checks the rungs of a program one by one: the row of each element, its position in the drawing, its operands.
#pragma once
#include <unordered_map>
#include <unordered_set>

#include "frontend/dialects/nct/program.h"
#include "frontend/sema/foreign_word.h"

namespace rung::frontend::nct {

// "Each output once" (l.233), over all modules.
class OutputReservations {
public:
  explicit OutputReservations(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}
  void add(const Row& row, const Operand& operand);

private:
  struct Owner {
    SourceRange once;         // of the coil, timer, …; invalid: none so far
    const Row* row = nullptr; // its row
    SourceRange setReset;     // of the first SET or RST
  };
  Diagnostics& diagnostics_;
  std::unordered_map<uint64_t, Owner> owners_; // by bit, or by word
};

class RungChecker {
public:
  RungChecker(Symbols& symbols, OutputReservations& reservations, frontend::Analysis& analysis,
              Diagnostics& diagnostics, std::string_view module);
  TypedRung check(const ladder::LadderFile& file, const ladder::Rung& rung);

private:
  const Row* rowOf(const ladder::Element& element, const Operand* first);
  struct Numbers { // kinds of numbers that a box has, by its constants and the signals of the NC
    bool integers = false;
    bool doubles = false;
  };
  Numbers numbersOf(std::span<const Word> operands);
  void reportUnknown(const ladder::Element& element, std::span<const Word> operands);
  void explainForeign(DiagBuilder& report, const ladder::Element& element, const frontend::ForeignWord& foreign,
                      Numbers numbers);
  void checkElement(TypedRung& typed, const ladder::Element& element);
  bool checkDrawn(const ladder::Rung& rung, const ladder::Element& element, const Row& row);
  bool checkPlacement(const ladder::Rung& rung, const ladder::Element& element, const Row& row);
  bool readOperands(TypedRung& typed, TypedElement& element);
  void readUncounted(const Row& row, std::span<const Word> words);
  bool readLabel(TypedElement& element, const Word& word);
  bool checkOperand(const Row& row, size_t index, const Operand& operand);
  void reportNoRegister(const Row& row, size_t index, SourceRange range);
  void reportOtherConstant(const Row& row, size_t index, const Operand& operand);
  bool checkRegister(const Row& row, size_t index, const Operand& operand);
  bool checkConstant(const Row& row, size_t index, const Operand& operand);
  bool checkDestination(const frontend::OperandInfo& info, const Operand& operand);
  bool checkModifiers(const Row& row, const ladder::Element& element, const Operand& operand);
  void warnInt0Only(const Operand& operand);
  struct CoilTraits { // see frontend::OperandUse
    bool isSet = false;
    bool isDue = false;
  };
  CoilTraits coilTraits(const ladder::Rung& rung, const ladder::Element& element) const;
  uint32_t baseOf(const Operand& operand);
  void note(const frontend::OperandInfo& info, const Operand& operand, CoilTraits coil);

  Symbols& symbols_;
  OutputReservations& reservations_;
  frontend::Analysis& analysis_;
  Diagnostics& diagnostics_;
  std::string_view module_; // name of the module, as written
  bool inInt0_;
  std::unordered_set<uint32_t> dueNets_; // nets after boxes of the rung that require a coil
  const nc::Signal* handwheel_;          // HWMOVE
  const nc::Signal* fastClock_;          // N_P2MS
};

} // namespace rung::frontend::nct
