// What a front end knows of a program's text: the names that it declares or uses, and the places that its operands
// name. Tools ask here; none reads an operand by itself. A program with errors has one too, of all that was understood.
#pragma once
#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "frontend/table/instruction.h"
#include "ir/support/source.h"

namespace rung::frontend {

// What is written at the places of a text, looked up by binary search.

// A Use has a `range`. Ranges may hold others: that of an operand the index in it.
template <class Use>
class UsesByPlace {
public:
  void add(const Use& use) { uses_.push_back(use); }
  // Once, when all are there: puts them in the order of the sources. Of several with one range `once` keeps the first.
  void settle(bool once) {
    std::ranges::stable_sort(uses_, {}, beginOf);
    if (once) {
      const auto again = std::ranges::unique(uses_, {}, &Use::range);
      uses_.erase(again.begin(), again.end());
    }
    SourcePos end;
    for (const Use& use : uses_) ends_.push_back(end = std::max(end, use.range.end));
  }

  // Afterwards.
  std::span<const Use> all() const { return uses_; }
  // The one with exactly this range; null when there is none.
  const Use* at(SourceRange range) const {
    const auto found = std::ranges::lower_bound(uses_, range.begin, {}, beginOf);
    return found != uses_.end() && found->range == range ? &*found : nullptr;
  }
  // The shortest that holds the position; null when none does.
  const Use* at(SourcePos position) const {
    const Use* best = nullptr;
    size_t i = static_cast<size_t>(std::ranges::upper_bound(uses_, position, {}, beginOf) - uses_.begin());
    for (; i > 0 && position < ends_[i - 1]; --i) {
      const Use& use = uses_[i - 1];
      if (position < use.range.end && (best == nullptr || lengthOf(use) <= lengthOf(*best))) best = &use;
    }
    return best;
  }

private:
  static SourcePos beginOf(const Use& use) { return use.range.begin; }
  static uint32_t lengthOf(const Use& use) { return use.range.end.value - use.range.begin.value; }

  std::vector<Use> uses_;
  std::vector<SourcePos>
      ends_; // the last end of this and all before it: nothing further left holds a position after it
};

// Bits of one of the dialect's spaces (ir::Space::name), counted from its beginning.
struct NamedPlace {
  std::string_view space;
  uint32_t firstBit = 0;
  uint32_t bits = 0; // 1: a bit; 0: it is not known, as the declaration has an error
};

// A name that the program declares, or one of the control's that it uses.
struct Definition {
  std::string_view name;
  std::string_view comment;
  SourceRange range;          // of the name in its declaration; invalid: the control's own
  NamedPlace place;           // not of a constant
  bool isPlaced = false;      // the declaration says where it lies
  std::string_view value;     // of a constant, as declared; empty: it is a place
  bool usedByControl = false; // by its name, whatever the program does
  bool isConstant() const { return !value.empty(); }
};

// A name in an operand or in another declaration.
struct NameUse {
  SourceRange range;
  uint32_t definition = 0;
};

inline constexpr uint32_t kNoDefinition = UINT32_MAX;

// An operand that names a place.
struct OperandUse {
  SourceRange range;
  uint32_t base = kNoDefinition; // the name that the place is counted from; none where it is an address
  NamedPlace place;              // with what is added at run time left out
  std::string_view computed;     // that, as written: ",REG" or ":REG"; empty: nothing is added
  Access access = Access::Read;
  bool isVariable = false; // `place` is as wide as the instruction takes a variable, whatever its declaration says
  bool isSet = false;      // a coil that sets the bit and never resets it
  bool isDue = false;      // the coil that an instruction must have, whether it is read or not
};

// An operand that is a place in the program: a label, a subprogram.
struct TargetUse {
  SourceRange range;
  std::string_view scope; // that its number belongs to, with its kind; the same for all uses of one target
  uint32_t number = 0;
  bool defines = false; // this is the place; else control goes there
};

// An instruction by its mnemonic, its number or its box.
struct InstructionUse {
  SourceRange range; // of that word
  const InstructionInfo* instruction = nullptr;
};

// All texts live as long as the sources and the program that was checked.
class Analysis {
public:
  // While the program is read, in any order.
  void define(const Definition& definition) { definitions_.push_back(definition); }
  void use(SourceRange name, uint32_t definition) { names_.add({name, definition}); }
  void use(const OperandUse& operand) { operands_.add(operand); }
  void use(const TargetUse& target) { targets_.add(target); }
  void use(const InstructionUse& instruction) { instructions_.add(instruction); }
  // Once, when it is complete: puts uses in the order of the sources.
  void settle();

  // Afterwards.
  std::span<const Definition> definitions() const { return definitions_; }
  std::span<const NameUse> names() const { return names_.all(); }
  std::span<const OperandUse> operands() const { return operands_.all(); }
  std::span<const TargetUse> targets() const { return targets_.all(); }
  // The operand that is written there, exactly; null when that names no place, of memory or of the program.
  const OperandUse* operandAt(SourceRange range) const { return operands_.at(range); }
  const TargetUse* targetAt(SourceRange range) const { return targets_.at(range); }
  // What the name that is written there, exactly, means; null when that is not a name.
  const Definition* nameAt(SourceRange range) const { return definitionOf(names_.at(range)); }
  // What a character belongs to, the innermost of a kind; null when that is nothing of the kind.
  const OperandUse* operandAt(SourcePos position) const { return operands_.at(position); }
  const TargetUse* targetAt(SourcePos position) const { return targets_.at(position); }
  const InstructionUse* instructionAt(SourcePos position) const { return instructions_.at(position); }
  // The meaning of a name that is used there.
  const Definition* nameAt(SourcePos position) const { return definitionOf(names_.at(position)); }
  // What is declared there, by its name.
  const Definition* declaredAt(SourcePos position) const { return definitionOf(declared_.at(position)); }

private:
  const Definition* definitionOf(const NameUse* name) const {
    return name == nullptr ? nullptr : &definitions_[name->definition];
  }

  std::vector<Definition> definitions_;
  UsesByPlace<NameUse> declared_; // the definitions that the program has
  UsesByPlace<NameUse> names_;
  UsesByPlace<OperandUse> operands_;
  UsesByPlace<TargetUse> targets_;
  UsesByPlace<InstructionUse> instructions_;
};

} // namespace rung::frontend
