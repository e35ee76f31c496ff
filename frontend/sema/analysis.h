// What a front end knows about a program's text: the names that it declares or uses, and the places that its operands
// name. Tools use it and do not parse operands themselves. It exists for a program with errors, too, with everything
// that was understood.
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

// Uses by their position in the text, looked up by binary search.

// A Use has a `range`. Ranges may be nested: that of an operand contains that of its index.
template <class Use>
class UsesByPlace {
public:
  void add(const Use& use) { uses_.push_back(use); }
  // Called once, after all have been added: sorts them in source order. With `once`, only the first of several with
  // equal ranges is kept.
  void settle(bool once) {
    std::ranges::stable_sort(uses_, {}, beginOf);
    if (once) {
      const auto again = std::ranges::unique(uses_, {}, &Use::range);
      uses_.erase(again.begin(), again.end());
    }
    SourcePos end;
    for (const Use& use : uses_) ends_.push_back(end = std::max(end, use.range.end));
  }

  // Valid after settle().
  std::span<const Use> all() const { return uses_; }
  // The one with exactly this range; null if there is none.
  const Use* at(SourceRange range) const {
    const auto found = std::ranges::lower_bound(uses_, range.begin, {}, beginOf);
    return found != uses_.end() && found->range == range ? &*found : nullptr;
  }
  // The one with the shortest range that contains the position; null if there is none.
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
      ends_; // the largest end of this and all before it: no earlier range contains a position after it
};

// Bits of one of the dialect's spaces (ir::Space::name), counted from its beginning.
struct NamedPlace {
  std::string_view space;
  uint32_t firstBit = 0;
  uint32_t bits = 0; // 1: a bit; 0: unknown, because the declaration has an error
};

// A name that the program declares, or one of the control's that it uses.
struct Definition {
  std::string_view name;
  std::string_view comment;
  SourceRange range;          // of the name in its declaration; invalid: the control's own
  NamedPlace place;           // not of a constant
  bool isPlaced = false;      // the declaration determines its place
  std::string_view value;     // of a constant, as declared; empty for a place
  bool usedByControl = false; // by its name, regardless of the program
  bool isListed = false;      // in a table of the control's tools, which may have more than the program uses
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
  uint32_t base = kNoDefinition; // the name from which the place is computed; none for an address
  NamedPlace place;              // without what is added at run time
  std::string_view computed;     // what is added, as written: ",REG" or ":REG"; empty: nothing
  Access access = Access::Read;
  bool isVariable = false; // `place` is as wide as the instruction takes a variable, regardless of its declaration
  bool isSet = false;      // a coil that sets the bit and never resets it
  bool isDue = false;      // a coil that an instruction requires, whether it is read or not
};

// An operand that is a position in the program: a label, a subprogram.
struct TargetUse {
  SourceRange range;
  std::string_view scope; // to which its number belongs, with its kind; the same for all uses of one target
  uint32_t number = 0;
  bool defines = false; // this is the target; otherwise control goes there
};

// An instruction, as a mnemonic, a number or a box.
struct InstructionUse {
  SourceRange range; // of that word
  const InstructionInfo* instruction = nullptr;
};

// All texts live as long as the sources and the checked program.
class Analysis {
public:
  // Called while the program is read, in any order.
  void define(const Definition& definition) { definitions_.push_back(definition); }
  void use(SourceRange name, uint32_t definition) { names_.add({name, definition}); }
  void use(const OperandUse& operand) { operands_.add(operand); }
  void use(const TargetUse& target) { targets_.add(target); }
  void use(const InstructionUse& instruction) { instructions_.add(instruction); }
  // Called once, when it is complete: sorts uses in source order.
  void settle();

  // Valid after settle().
  std::span<const Definition> definitions() const { return definitions_; }
  std::span<const NameUse> names() const { return names_.all(); }
  std::span<const OperandUse> operands() const { return operands_.all(); }
  std::span<const TargetUse> targets() const { return targets_.all(); }
  std::span<const InstructionUse> instructions() const { return instructions_.all(); }
  // The operand with exactly this range; null if it names no place, in memory or in the program.
  const OperandUse* operandAt(SourceRange range) const { return operands_.at(range); }
  const TargetUse* targetAt(SourceRange range) const { return targets_.at(range); }
  // The meaning of the name with exactly this range; null if that is not a name.
  const Definition* nameAt(SourceRange range) const { return definitionOf(names_.at(range)); }
  // The innermost use of each kind that contains the character; null if there is none.
  const OperandUse* operandAt(SourcePos position) const { return operands_.at(position); }
  const TargetUse* targetAt(SourcePos position) const { return targets_.at(position); }
  const InstructionUse* instructionAt(SourcePos position) const { return instructions_.at(position); }
  // The meaning of a name that is used there.
  const Definition* nameAt(SourcePos position) const { return definitionOf(names_.at(position)); }
  const NameUse* nameUseAt(SourcePos position) const { return names_.at(position); }
  // The definition whose name is declared there.
  const Definition* declaredAt(SourcePos position) const { return definitionOf(declared_.at(position)); }

private:
  const Definition* definitionOf(const NameUse* name) const {
    return name == nullptr ? nullptr : &definitions_[name->definition];
  }

  std::vector<Definition> definitions_;
  UsesByPlace<NameUse> declared_; // definitions in the program
  UsesByPlace<NameUse> names_;
  UsesByPlace<OperandUse> operands_;
  UsesByPlace<TargetUse> targets_;
  UsesByPlace<InstructionUse> instructions_;
};

} // namespace rung::frontend
