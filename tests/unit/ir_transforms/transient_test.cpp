// Stores to registers between rungs: in a rung, over rungs, calls, tasks and parts.
#include <gtest/gtest.h>

#include "ir/transforms/passes.h"
#include "ir/verify/verify.h"
#include "tests/unit/ir_transforms/passes_testing.h"

namespace rung::ir {
namespace {

const std::string kStore = "%0:i32 = load D[0]\nslot_store.i32 $1, %0\n";
const std::string kLoad = "%0:i32 = slot_load $1\nstore.i32 D[1], %0\n";
const std::string kBit = "%0:bit = load B[0.0]\n";

// Whether a module stores $1 in a rung of the first routine, after the pass.
std::vector<bool> stores(Module& module, RoutineId routine = RoutineId{0}) {
  std::vector<bool> out;
  for (uint32_t i = 0; i < module.at(routine).rungs.size(); ++i)
    out.push_back(bodyOf(module, routine, i).find("slot_store.i32 $1") != std::string::npos);
  return out;
}
std::vector<bool> storesAfter(const std::vector<RoutineText>& routines, const std::vector<std::string>& entries,
                              std::vector<uint32_t> borders = {}) {
  Module module = moduleOf(routines, entries, static_cast<uint32_t>(borders.size()) + 1);
  if (module.routines.empty()) return {};
  module.tasks.front().borders = std::move(borders);
  removeTransientStores(module);
  const std::vector<VerifyError> errors = verify(module, Mode::Final);
  EXPECT_TRUE(errors.empty()) << render(module, errors);
  return stores(module);
}
// One routine and task.
std::vector<bool> storesAfter(const std::vector<RungText>& rungs) { return storesAfter({{"R", rungs}}, {"R"}); }

using Bools = std::vector<bool>;

// ---- within a rung
// ---------------------------------------------------------------------------------------------------

std::string oneRung(std::string_view lines) { return after(removeTransientStores, lines); }
void expectUnchanged(std::string_view lines) { EXPECT_EQ(oneRung(lines), bodyOf(moduleOf(lines))); }

TEST(Transient, OverwrittenOrNeverRead) {
  EXPECT_EQ(oneRung(R"(%0:i32 = const 1
%1:i32 = const 2
slot_store.i32 $1, %0
slot_store.i32 $1, %1
%2:i32 = slot_load $1
store.i32 D[0], %2
slot_store.i32 $1, %0
slot_store.i32 $0, %0
slot_store.i32 $0, %1)"),
            R"(%0:i32 = const 1
%1:i32 = const 2
slot_store.i32 $1, %1
%2:i32 = slot_load $1
store.i32 D[0], %2
slot_store.i32 $0, %0
slot_store.i32 $0, %1
)");
}

TEST(Transient, InARegion) {
  // Stored above, so that the slot carries nothing from one run to the next.
  EXPECT_EQ(oneRung(R"(%0:bit = load B[0.0]
%1:i32 = load D[0]
slot_store.i32 $1, %1
if %0
  slot_store.i32 $1, %1
endif
%2:i32 = slot_load $1
store.i32 D[1], %2
if %0
  slot_store.i32 $1, %1
endif)"),
            R"(%0:bit = load B[0.0]
%1:i32 = load D[0]
slot_store.i32 $1, %1
if %0
slot_store.i32 $1, %1
endif
%2:i32 = slot_load $1
store.i32 D[1], %2
if %0
endif
)");
}

TEST(Transient, InALoopTheNextPassMayRead) {
  expectUnchanged(R"(%0:i32 = load D[0]
slot_store.i32 $1, %0
%1:i32 = loop 3
  %2:i32 = slot_load $1
  %3:i32 = add %2, %1
  store.i32 D[1], %3
  slot_store.i32 $1, %3
endloop)");
  EXPECT_EQ(oneRung("%0:i32 = loop 3\n  slot_store.i32 $1, %0\nendloop"), "%0:i32 = loop 3\nendloop\n");
}

TEST(Transient, AValueFromTheRunBeforeIsKept) {
  expectUnchanged("%0:i32 = slot_load $1\nstore.i32 D[0], %0\nslot_store.i32 $1, %0");
}

// ---- over rungs
// ------------------------------------------------------------------------------------------------------

TEST(Transient, OverRungs) {
  EXPECT_EQ(storesAfter({{kStore}, {kStore}, {}, {kLoad}, {kStore}}), (Bools{false, true, false, false, false}));
}

TEST(Transient, JumpsAndEnds) {
  // Past the rung that overwrites.
  EXPECT_EQ(storesAfter({{kStore + "%1:bit = load B[0.0]\n", "} goto 2 if %1"}, {kStore}, {kLoad}}),
            (Bools{true, true, false}));
  // Past the rung that loads.
  EXPECT_EQ(storesAfter({{kStore, "} goto 2"}, {kLoad}, {}}), (Bools{false, false, false}));
  EXPECT_EQ(storesAfter({{kStore, "} end"}, {kLoad}}), (Bools{false, false}));
  EXPECT_EQ(storesAfter({{kStore, "} ret"}, {kLoad}}), (Bools{false, false}));
  EXPECT_EQ(storesAfter({{kStore + "%1:bit = load B[0.0]\n", "} ret if %1"}, {kLoad}}), (Bools{true, false}));
  // Backward.
  EXPECT_EQ(storesAfter({{kStore}, {kLoad}, {kStore + "%1:bit = load B[0.0]\n", "} goto 1 if %1"}}),
            (Bools{true, false, true}));
  EXPECT_EQ(storesAfter({{kStore, "} switch %0 [1, 2]"}, {kStore, "} end"}, {kLoad}}), (Bools{true, false, false}));
}

TEST(Transient, AConditionalStoreDoesNotOverwrite) {
  EXPECT_EQ(storesAfter({{kStore}, {kBit + "%1:i32 = const 1\nif %0\n  slot_store.i32 $1, %1\nendif\n"}, {kLoad}}),
            (Bools{true, true, false}));
}

TEST(Transient, ReadBeforeItIsStoredInTheRung) {
  EXPECT_EQ(storesAfter({{kStore}, {kLoad + "slot_store.i32 $1, %0\n"}}), (Bools{true, false}));
}

// ---- calls
// -----------------------------------------------------------------------------------------------------------

TEST(Transient, TheCalleeReads) {
  EXPECT_EQ(storesAfter({{"R", {{kStore, "} call Q"}, {}}}, {"Q", {{}, {kLoad}}}}, {"R"}), (Bools{true, false}));
  EXPECT_EQ(storesAfter({{"R", {{kStore, "} call Q"}, {}}}, {"Q", {{kStore}, {kLoad}}}}, {"R"}), (Bools{false, false}));
}

TEST(Transient, TheCalleeLeavesItForTheCaller) {
  EXPECT_EQ(storesAfter({{"R", {{kStore, "} call Q"}, {kLoad}}}, {"Q", {{}}}}, {"R"}), (Bools{true, false}));
  // The callee always stores it; where the call is conditional, the caller's value may be read.
  EXPECT_EQ(storesAfter({{"R", {{kStore, "} call Q"}, {kLoad}}}, {"Q", {{kStore}}}}, {"R"}), (Bools{false, false}));
  EXPECT_EQ(
      storesAfter({{"R", {{kStore + "%1:bit = load B[0.0]\n", "} call Q if %1"}, {kLoad}}}, {"Q", {{kStore}}}}, {"R"}),
      (Bools{true, false}));
}

TEST(Transient, TheCallerReadsWhatTheCalleeStored) {
  Module module = moduleOf(
      {{"R", {{{}, "} call Q"}, {kLoad}}}, {"Q", {{kStore + "%1:bit = load B[0.0]\n", "} ret if %1"}, {kStore}}}},
      {"R"});
  removeTransientStores(module);
  EXPECT_EQ(stores(module, RoutineId{1}), (Bools{true, true}));
  // Through a call in the last rung.
  module = moduleOf({{"R", {{{}, "} call P"}, {kLoad}}}, {"P", {{kStore, "} call Q"}}}, {"Q", {{}}}}, {"R"});
  removeTransientStores(module);
  EXPECT_EQ(stores(module, RoutineId{1}), (Bools{true}));
  // An end does not come back.
  module = moduleOf({{"R", {{kStore, "} call Q"}, {kLoad}}}, {"Q", {{kStore, "} end"}}}}, {"R"});
  removeTransientStores(module);
  EXPECT_EQ(stores(module, RoutineId{1}), (Bools{false}));
  EXPECT_EQ(stores(module, RoutineId{0}), (Bools{false, false}));
}

// ---- tasks and parts
// -------------------------------------------------------------------------------------------------

TEST(Transient, EachTaskForItself) {
  EXPECT_EQ(storesAfter({{"R", {{kStore}, {}}}, {"Q", {{kStore}, {kLoad}}}}, {"R", "Q"}), (Bools{false, false}));
  // Q takes over what R left.
  EXPECT_EQ(storesAfter({{"R", {{kStore}, {}}}, {"Q", {{kLoad}}}}, {"R", "Q"}), (Bools{true, false}));
}

TEST(Transient, AnotherTaskBetweenTwoParts) {
  const std::vector<RoutineText> routines = {{"R", {{kStore}, {}, {kLoad}, {kStore}}}, {"Q", {{kStore}}}};
  EXPECT_EQ(storesAfter(routines, {"R", "Q"}), (Bools{true, false, false, false}));
  // Q may run in the midst of R, and then R reads what Q stored.
  EXPECT_EQ(storesAfter(routines, {"R", "Q"}, {2}), (Bools{true, false, false, true}));
  Module module = moduleOf(routines, {"R", "Q"}, 2);
  module.tasks.front().borders = {2};
  removeTransientStores(module);
  EXPECT_EQ(stores(module, RoutineId{1}), (Bools{true}));
  // Nothing else stores it.
  EXPECT_EQ(storesAfter({{"R", {{kStore}, {}, {kLoad}, {kStore}}}, {"Q", {{}}}}, {"R", "Q"}, {2}),
            (Bools{true, false, false, false}));
}

// ---- what is carried
// ---------------------------------------------------------------------------------------------------

bool isCarried(const std::vector<RungText>& rungs, std::vector<uint32_t> borders = {}) {
  Module module = moduleOf({{"R", rungs}}, {"R"}, static_cast<uint32_t>(borders.size()) + 1);
  if (module.routines.empty()) return false;
  module.tasks.front().borders = std::move(borders);
  keepCarried(module);
  return !module.slots[1].transient;
}

TEST(Transient, WhatARunLeavesForAnotherIsCarried) {
  EXPECT_FALSE(isCarried({{kStore}, {kLoad}}));
  EXPECT_TRUE(isCarried({{kLoad}, {kStore}}));
}

TEST(Transient, WhatAPartLeavesForAnotherIsCarried) {
  EXPECT_TRUE(isCarried({{kStore}, {kLoad}}, {1}));
  EXPECT_FALSE(isCarried({{kStore}, {kStore}, {kLoad}}, {1}));
  EXPECT_TRUE(isCarried({{kStore + "%1:bit = load B[0.0]\n", "} goto 2 if %1"}, {kStore}, {kLoad}}, {2}));
}

} // namespace
} // namespace rung::ir
