// The sample program (see sample_module.h).
#include "tests/unit/llvm/sample_module.h"

#include "ir/core/builder.h"

namespace rung::codegen {

using namespace ir;

Module sampleModule() {
  Module m;
  m.name = "sample";
  m.dialect = "gsk";
  m.files = {"sample.lad"};
  m.faults = {"limit reached", "dead-loop"};
  m.spaces = {{.name = "X", .unitBytes = 1, .units = 4, .flags = RUNG_SPACE_INPUT},
              {.name = "Y", .unitBytes = 1, .units = 4, .flags = RUNG_SPACE_OUTPUT},
              {.name = "D", .unitBytes = 1, .units = 16}};
  m.symbols.push_back({.name = "LAMP", .comment = {}, .space = SpaceId{1}});
  m.inits.push_back({.space = SpaceId{2}, .byte = 4, .data = {0, 0, 7}});
  m.safeSpans.push_back({SpaceId{1}, 0, 4});
  m.routines.resize(2);
  m.routines[0].name = "MAIN";
  m.routines[0].rungs.resize(2);
  m.routines[1].name = "COUNT";
  m.routines[1].rungs.resize(1);
  const Place lamp{SpaceId{1}, 0, 0};
  const Place count{SpaceId{2}, 4, 0};
  Rung& first = m.routines[0].rungs[0];
  first.title = "lamp";
  first.begin = {FileIndex{0}, 3, 1};
  RungBuilder lampRung(m, first);
  lampRung.store(lamp, lampRung.and_(lampRung.load(Type::Bit, {SpaceId{0}, 0, 0}),
                                     lampRung.not_(lampRung.load(Type::Bit, {SpaceId{0}, 0, 1}))));
  m.routines[0].rungs[1].begin = {FileIndex{0}, 6, 1};
  RungBuilder callRung(m, m.routines[0].rungs[1]);
  callRung.call(RoutineId{1}, callRung.load(Type::Bit, lamp));
  m.routines[1].rungs[0].begin = {FileIndex{0}, 9, 1};
  RungBuilder countRung(m, m.routines[1].rungs[0]);
  countRung.setLine(10);
  const ValueId next = countRung.add(countRung.load(Type::I16, count), countRung.constant(Type::I16, 1));
  countRung.setLine(11);
  countRung.trap(countRung.eq(next, countRung.constant(Type::I16, 3)), FaultId{0});
  countRung.store(count, next);
  m.tasks.push_back({.name = "MAIN",
                     .entry = RoutineId{0},
                     .periodUs = 8000,
                     .budget = 1000,
                     .budgetFault = FaultId{1},
                     .begin = {},
                     .end = {}});
  m.mainTask = TaskId{0};
  m.scan = {{RUNG_STEP_ADVANCE, {}, 8000}, {RUNG_STEP_RUN, TaskId{0}, 1}, {RUNG_STEP_SLOT, {}, 0}};
  return m;
}

} // namespace rung::codegen
