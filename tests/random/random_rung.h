// Fills one rung with random operations (part of random_module.cpp's work).
#pragma once
#include <vector>

#include "ir/core/builder.h"
#include "ir/core/op_info.h"
#include "tests/random/random.h"
#include "tests/random/random_source.h"

namespace rung::ir {

class RandomRung {
public:
  // `slots` are those that may be read and written.
  RandomRung(RandomSource& random, const RandomOptions& options, RungBuilder& builder, std::vector<SlotId> slots)
      : random_(random), options_(options), builder_(builder), slots_(std::move(slots)) {}

  void fill();
  // A value of the type that is visible here: an earlier one, a constant, or a load.
  ValueId value(Type type);
  // A bit that is always 0 unless a known cell is forced: it has been stored there and loaded again.
  ValueId known();

private:
  void addOp(uint32_t depth);
  void addPlain();
  void addAccess();
  void addIndexed();
  void addSlotAccess();
  void addHost();
  void addRegion(uint32_t depth);
  void addIf(uint32_t depth);
  void addKnownIf();
  void addLoop(uint32_t depth);

  Type someType(TypeSet set);
  Type operandType(Constraint constraint, Type own);
  Place place(Type type);
  Window window(Type type);
  Window wideWindow(Type type);
  ValueId constant(Type type);
  void remember(ValueId id) { visible_.push_back(id); }

  RandomSource& random_;
  const RandomOptions& options_;
  RungBuilder& builder_;
  const std::vector<SlotId> slots_;
  std::vector<ValueId> visible_;
};

} // namespace rung::ir
