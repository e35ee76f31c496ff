// The reference interpreter: memory, regions, transfers, host. Values of single operations are the evaluator's
// (ir_core).
#include <gtest/gtest.h>

#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/core/parts.h"
#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"
#include "tests/random/random.h"
#include "tests/unit/ir_interp/machine.h"

namespace rung::ir {
namespace {

// A module with the usual declarations around routines.
std::string program(std::string_view routines, std::string_view more = {}) {
  return std::string(R"(module "t" dialect "t"
space D unit 4 units 8
space B unit 1 units 16
slot $0 i32 init 5 "kept"
slot $1 bit init 1 "flag"
)") + std::string(more) +
         "fault \"budget\"\nfault \"stop\"\nservice \"ASK\"\n" + std::string(routines) +
         "task T entry MAIN period 1000 budget 1000 fault \"budget\" parts 1 {\n}\nschedule main T fast -\n"
         "step scan advance - 1000\nstep scan run T 1\n";
}

// One rung with these operations.
std::string rung(std::string_view ops, std::string_view transfer = "}", int number = 0) {
  return "rung " + std::to_string(number) + " \"\" loc(-:0:0-0) key(0) weight 1 {\n" + std::string(ops) + "\n" +
         std::string(transfer) + "\n";
}
std::string routine(std::string_view rungs, std::string_view name = "MAIN") {
  return "routine " + std::string(name) + " {\n" + std::string(rungs) + "}\n";
}
Machine machineOf(std::string_view ops) { return Machine(moduleFromText(program(routine(rung(ops))))); }

// ---- memory --------------------------------------------------------------------------------------------------------

TEST(InterpMemory, PlacesAreLittleEndianAtAnyAlignment) {
  Machine m(moduleFromText(program(routine(rung(R"(
    %0:i32 = const 0x12345678
    store.i32 D[1+1], %0
    %1:i16 = load D[1+2]
    store.i16 B[3], %1
    %2:bit = load D[1.13]
    store.bit B[8.7], %2
    %3:f64 = const 1.5
    store.f64 D[4+3], %3)")))));
  m->scan();
  EXPECT_EQ(m.value("D", 5, 4), 0x12345678u);
  EXPECT_EQ(m.value("B", 3, 2), 0x3456u);
  EXPECT_TRUE(m.bit("B", 8, 7)); // bit 5 of byte 5, 0x78
  EXPECT_EQ(m.value("D", 19, 8), 0x3FF8000000000000u);
}

TEST(InterpMemory, BitsLeaveTheirByteAlone) {
  Machine m(moduleFromText(
      program(routine(rung("%0:bit = const 0\nstore.bit B[0.3], %0\n%1:bit = const 1\nstore.bit B[1.0], %1")),
              "init B[0] FF7E\n")));
  m->scan();
  EXPECT_EQ(m.value("B", 0), 0xF7u);
  EXPECT_EQ(m.value("B", 1), 0x7Fu);
}

TEST(InterpMemory, WindowsBoundTheirIndex) {
  Machine m(moduleFromText(program(routine(rung(R"(
    %0:i32 = const 2
    %1:i32 = const 3
    %2:i32 = const -1
    %3:i32 = load_at D[1 count 3], %0
    %4:i32 = load_at D[1 count 3], %1
    %5:i32 = load_at D[1 count 3], %2
    store.i32 B[0], %3
    store.i32 B[4], %4
    store.i32 B[8], %5
    %6:i32 = const 77
    store_at.i32 D[5 count 3], %0, %6
    store_at.i32 D[5 count 3], %1, %6
    store_at.i32 D[5 count 3], %2, %6)")),
                                   "init D[3] 11111111\ninit D[4] 22222222\ninit B[0] FFFFFFFFFFFFFFFFFFFFFFFF\n")));
  m->scan();
  EXPECT_EQ(m.value("B", 0, 4), 0x11111111u);
  EXPECT_EQ(m.value("B", 4, 8), 0u);
  EXPECT_EQ(m.value("D", 28, 4), 77u);
  EXPECT_EQ(m.value("D", 16, 4), 0x22222222u);
  EXPECT_EQ(m.value("D", 20, 8), 0u);
}

TEST(InterpMemory, BitWindowsBoundIndexAndBitNumber) {
  Machine m(moduleFromText(program(routine(rung(R"(
    %0:i32 = const 1
    %1:i32 = const 31
    %2:i32 = const 32
    %3:bit = load_bit_at D[1 count 2], %0, %1
    %4:bit = load_bit_at D[1 count 2], %0, %2
    %5:bit = load_bit_at D[1 count 2], %1, %0
    store.bit B[0.0], %3
    store.bit B[0.1], %4
    store.bit B[0.2], %5
    %6:bit = const 1
    store_bit_at.bit D[4 count 2], %0, %1, %6
    store_bit_at.bit D[4 count 2], %0, %2, %6
    store_bit_at.bit D[4 count 2], %2, %0, %6)")),
                                   "init D[2] 00000080FFFFFFFF\n")));
  m->scan();
  EXPECT_EQ(m.value("B", 0), 1u);
  EXPECT_EQ(m.value("D", 20, 4), 0x80000000u);
  EXPECT_EQ(m.value("D", 16, 4), 0u);
  EXPECT_EQ(m.value("D", 24, 8), 0u);
}

TEST(InterpMemory, SlotsBeginWithTheirInitialValue) {
  Machine m = machineOf(R"(
    %0:i32 = slot_load $0
    %1:i32 = const 1
    %2:i32 = add %0, %1
    slot_store.i32 $0, %2
    store.i32 D[0], %2
    %3:bit = slot_load $1
    %4:bit = not %3
    slot_store.bit $1, %4
    store.bit B[0.0], %3)");
  m->scan();
  EXPECT_EQ(m.value("D", 0, 4), 6u);
  EXPECT_TRUE(m.bit("B", 0, 0));
  m->scan();
  EXPECT_EQ(m.value("D", 0, 4), 7u);
  EXPECT_FALSE(m.bit("B", 0, 0));
}

// ---- regions -------------------------------------------------------------------------------------------------------

TEST(InterpRegions, IfYieldsTheBranchThatRan) {
  for (const int cond : {0, 1}) {
    Machine m = machineOf("%0:bit = const " + std::to_string(cond) + R"(
      if %0
      %1:i32 = const 10
      store.i32 D[0], %1
      %2:i32 = const 11
      else %1, %2
      %3:i32 = const 20
      store.i32 D[1], %3
      %4:i32, %5:i32 = endif %3, %3
      store.i32 D[2], %4
      store.i32 D[3], %5
      if %0
      store.i32 D[4], %4
      endif)");
    m->scan();
    EXPECT_EQ(m.value("D", 0, 4), cond != 0 ? 10u : 0u);
    EXPECT_EQ(m.value("D", 4, 4), cond != 0 ? 0u : 20u);
    EXPECT_EQ(m.value("D", 8, 4), cond != 0 ? 10u : 20u);
    EXPECT_EQ(m.value("D", 12, 4), cond != 0 ? 11u : 20u);
    EXPECT_EQ(m.value("D", 16, 4), cond != 0 ? 10u : 0u);
  }
}

TEST(InterpRegions, LoopsCarryValuesThatChangePlaces) {
  Machine m = machineOf(R"(
    %0:i32 = const 1
    %1:i32 = const 2
    %2:i32, %3:i32, %4:i32 = loop 5, %0, %1
    store_at.i32 D[0 count 8], %2, %3
    %5:i32, %6:i32 = endloop %4, %3
    store.i32 D[6], %5
    store.i32 D[7], %6)");
  m->scan();
  for (uint32_t pass = 0; pass < 5; ++pass) EXPECT_EQ(m.value("D", 4 * pass, 4), pass % 2 + 1) << pass;
  EXPECT_EQ(m.value("D", 24, 4), 2u);
  EXPECT_EQ(m.value("D", 28, 4), 1u);
}

TEST(InterpRegions, NoPassGivesTheFirstValues) {
  Machine m = machineOf(R"(
    %0:i32 = const 9
    %1:i32, %2:i32 = loop 0, %0
    store.i32 D[0], %0
    %3:i32 = endloop %1
    store.i32 D[1], %3)");
  m->scan();
  EXPECT_EQ(m.value("D", 0, 4), 0u);
  EXPECT_EQ(m.value("D", 4, 4), 9u);
}

TEST(InterpRegions, Nest) {
  Machine m = machineOf(R"(
    %0:i32 = const 0
    %1:i32, %2:i32 = loop 3, %0
      %3:i32, %4:i32 = loop 4, %2
        %5:i32 = const 1
        %6:bit = eq.i32 %3, %1
        if %6
          %7:i32 = const 10
        else %7
        %8:i32 = endif %5
        %9:i32 = add %4, %8
      %10:i32 = endloop %9
    %11:i32 = endloop %10
    store.i32 D[0], %11)");
  m->scan();
  EXPECT_EQ(m.value("D", 0, 4), 3u * (10 + 3));
}

// ---- transfers -----------------------------------------------------------------------------------------------------

// A rung that appends a digit to D[0].
std::string digit(int n, std::string_view transfer, int number) {
  return rung("%0:i32 = load D[0]\n%1:i32 = const 10\n%2:i32 = mul %0, %1\n%3:i32 = const " + std::to_string(n) +
                  "\n%4:i32 = add %2, %3\nstore.i32 D[0], %4\n%5:bit = load B[0.0]\n%6:i32 = load B[4]",
              transfer, number);
}
// Whatever the chunks.
uint64_t digitsOf(std::string_view routines, std::string_view inits = {}) {
  uint64_t digits = 0;
  for (const uint32_t chunkRungs : {1u, 2u, 32u}) {
    LayoutOptions options;
    options.partition.maxChunkRungs = chunkRungs;
    Machine m(moduleFromText(program(routines, inits)), options);
    m->scan();
    EXPECT_FALSE(m->faulted());
    if (chunkRungs == 1) digits = m.value("D", 0, 4);
    EXPECT_EQ(m.value("D", 0, 4), digits) << chunkRungs << " rungs a chunk";
  }
  return digits;
}

TEST(InterpTransfers, FallThrough) {
  EXPECT_EQ(digitsOf(routine(digit(1, "}", 0) + digit(2, "}", 1) + digit(3, "}", 2))), 123u);
}

TEST(InterpTransfers, Goto) {
  EXPECT_EQ(digitsOf(routine(digit(1, "} goto 2", 0) + digit(2, "}", 1) + digit(3, "}", 2))), 13u);
  const std::string conditional = routine(digit(1, "} goto 2 if %5", 0) + digit(2, "}", 1) + digit(3, "}", 2));
  EXPECT_EQ(digitsOf(conditional), 123u);
  EXPECT_EQ(digitsOf(conditional, "init B[0] 01\n"), 13u);
}

TEST(InterpTransfers, SwitchTakesTheFirstWhenOutside) {
  const std::string rungs =
      routine(digit(1, "} switch %6 [3, 1, 2]", 0) + digit(2, "}", 1) + digit(3, "}", 2) + digit(4, "}", 3));
  EXPECT_EQ(digitsOf(rungs), 14u);
  EXPECT_EQ(digitsOf(rungs, "init B[4] 01000000\n"), 1234u);
  EXPECT_EQ(digitsOf(rungs, "init B[4] 02000000\n"), 134u);
  EXPECT_EQ(digitsOf(rungs, "init B[4] 03000000\n"), 14u);
  EXPECT_EQ(digitsOf(rungs, "init B[4] FFFFFFFF\n"), 14u);
}

TEST(InterpTransfers, CallsComeBackBehindTheCall) {
  const std::string sub = routine(digit(7, "} ret if %5", 0) + digit(8, "}", 1), "SUB");
  EXPECT_EQ(digitsOf(sub + routine(digit(1, "} call SUB", 0) + digit(2, "}", 1))), 1782u);
  EXPECT_EQ(digitsOf(sub + routine(digit(1, "} call SUB if %5", 0) + digit(2, "}", 1)), "init B[0] 01\n"), 172u);
  EXPECT_EQ(digitsOf(sub + routine(digit(1, "} call SUB if %5", 0) + digit(2, "}", 1))), 12u);
}

TEST(InterpTransfers, CallAtTheEndReturnsToTheCaller) {
  const std::string inner = routine(digit(3, "}", 0), "INNER");
  const std::string outer = routine(digit(2, "} call INNER", 0), "OUTER");
  EXPECT_EQ(digitsOf(inner + outer + routine(digit(1, "} call OUTER", 0) + digit(4, "}", 1))), 1234u);
  EXPECT_EQ(digitsOf(inner + outer + routine(digit(1, "} call OUTER", 0))), 123u);
}

TEST(InterpTransfers, EndEndsTheRunFromWithinACall) {
  const std::string sub = routine(digit(7, "} end if %5", 0) + digit(8, "}", 1), "SUB");
  const std::string rungs = sub + routine(digit(1, "} call SUB", 0) + digit(2, "}", 1));
  EXPECT_EQ(digitsOf(rungs, "init B[0] 01\n"), 17u);
  EXPECT_EQ(digitsOf(rungs), 1782u);
  Machine m(moduleFromText(program(rungs, "init B[0] 01\n")));
  m->scan();
  m->scan();
  EXPECT_EQ(m.value("D", 0, 4), 1717u);
}

TEST(InterpTransfers, RetAtTheOutermostLevelEndsTheRun) {
  EXPECT_EQ(digitsOf(routine(digit(1, "} ret if %5", 0) + digit(2, "}", 1)), "init B[0] 01\n"), 1u);
}

// ---- chunks --------------------------------------------------------------------------------------------------------

// A rung without operations but a condition.
std::string heavy(uint32_t number, uint32_t weight, std::string_view transfer = "}") {
  return "rung " + std::to_string(number) + " \"\" loc(-:0:0-0) key(0) weight " + std::to_string(weight) +
         " {\n%0:bit = load B[0.0]\n%1:i32 = load B[4]\n" + std::string(transfer) + "\n";
}
std::vector<std::pair<uint32_t, uint32_t>> chunksOf(const std::string& rungs, uint32_t maxRungs) {
  LayoutOptions options;
  options.partition.maxChunkRungs = maxRungs;
  const Machine m(moduleFromText(program(routine(rungs))), options);
  std::vector<std::pair<uint32_t, uint32_t>> chunks;
  for (const Chunk& chunk : m.layout().partition().chunks()) chunks.emplace_back(chunk.firstRung, chunk.weight);
  return chunks;
}
using Chunks = std::vector<std::pair<uint32_t, uint32_t>>; // first rung, weight

TEST(InterpChunks, JumpsDownStayInsideAndTheLightestWayWeighs) {
  const std::string over = heavy(0, 2, "} goto 2 if %0") + heavy(1, 50) + heavy(2, 3);
  EXPECT_EQ(chunksOf(over, 64), (Chunks{{0, 5}}));
  const std::string choice = heavy(0, 2, "} switch %1 [1, 2, 3]") + heavy(1, 7, "} goto 3") + heavy(2, 9) + heavy(3, 1);
  EXPECT_EQ(chunksOf(choice, 64), (Chunks{{0, 3}}));
  const std::string out = heavy(0, 2, "} ret if %0") + heavy(1, 50);
  EXPECT_EQ(chunksOf(out, 64), (Chunks{{0, 2}}));
}

TEST(InterpChunks, BeginAtTargetsOfJumpsBackAndBehindCalls) {
  EXPECT_EQ(chunksOf(heavy(0, 1) + heavy(1, 2) + heavy(2, 3, "} goto 1 if %0") + heavy(3, 4), 64),
            (Chunks{{0, 1}, {1, 5}}));
  const std::string sub = heavy(0, 1) + "}\nroutine SUB2 {\n" + heavy(0, 1, "} call MAIN if %0") + heavy(1, 1);
  EXPECT_EQ(chunksOf(sub, 64), (Chunks{{0, 1}, {0, 1}, {1, 1}}));
}

// Rungs 1 to 3 and 4 to 6 belong together.
TEST(InterpChunks, AreCutWhereTheFewestJumpsLeave) {
  const std::string rungs = heavy(0, 1) + heavy(1, 1, "} goto 4 if %0") + heavy(2, 1) + heavy(3, 1) +
                            heavy(4, 1, "} goto 7 if %0") + heavy(5, 1) + heavy(6, 1) + heavy(7, 1);
  EXPECT_EQ(chunksOf(rungs, 6), (Chunks{{0, 2}, {4, 2}}));
}

// A pass through the loop costs what it runs: 3 without rung 1, else 53; the chunk in which the budget of 1000 ends
// runs or does not run as a whole.
TEST(InterpChunks, TheWatchdogCountsWhatIsRun) {
  const std::string count = "rung 0 \"\" loc(-:0:0-0) key(0) weight 1 {\n%0:i32 = load D[0]\n%1:i32 = const 1\n"
                            "%2:i32 = add %0, %1\nstore.i32 D[0], %2\n%3:bit = load B[0.0]\n} goto 2 if %3\n";
  const std::string rungs = count + heavy(1, 50) + heavy(2, 2, "} goto 0");
  for (const uint32_t chunkRungs : {1u, 64u}) {
    LayoutOptions options;
    options.partition.maxChunkRungs = chunkRungs;
    Machine light(moduleFromText(program(routine(rungs), "init B[0] 01\n")), options);
    light->scan();
    EXPECT_TRUE(light->faulted());
    EXPECT_NEAR(static_cast<double>(light.value("D", 0, 4)), 1000 / 3.0, 1.0) << chunkRungs;
    Machine full(moduleFromText(program(routine(rungs))), options);
    full->scan();
    EXPECT_TRUE(full->faulted());
    EXPECT_NEAR(static_cast<double>(full.value("D", 0, 4)), 1000 / 53.0, 1.0) << chunkRungs;
  }
}

// ---- host ----------------------------------------------------------------------------------------------------------

TEST(InterpHost, NowIsTheClockOfTheRun) {
  Machine m = machineOf("%0:i64 = now\nstore.i64 D[0], %0");
  m->scan();
  EXPECT_EQ(m.value("D", 0, 8), 1000u);
  m->scan();
  EXPECT_EQ(m.value("D", 0, 8), 2000u);
}

TEST(InterpHost, TrapRecordsWhereItStopped) {
  Machine m(moduleFromText(program("file \"a.lad\"\n" + routine(R"(rung 0 "" loc("a.lad":5:0-9) key(0) weight 1 {
    %0:bit = const 0
    trap "budget", %0
    %1:i32 = const 1
    store.i32 D[0], %1
    %2:bit = const 1
    trap "stop", %2 @7
    store.i32 D[1], %1
    }
)"))));
  m->scan();
  EXPECT_TRUE(m->faulted());
  EXPECT_EQ(m->fault().code, 1u);
  EXPECT_EQ(m->fault().rung, 0u);
  EXPECT_EQ(m->fault().line, 7u);
  EXPECT_EQ(m.value("D", 0, 4), 1u);
  EXPECT_EQ(m.value("D", 4, 4), 0u);
}

TEST(InterpHost, TrapWithoutALineNamesTheRungs) {
  Machine m(moduleFromText(program(
      "file \"a.lad\"\n" +
      routine("rung 0 \"\" loc(\"a.lad\":5:0-9) key(0) weight 1 {\n%0:bit = const 1\ntrap \"stop\", %0\n}\n"))));
  m->scan();
  EXPECT_EQ(m->fault().line, 5u);
}

TEST(InterpHost, MessagesCarryTheirValues) {
  Machine m = machineOf(R"(
    %0:i32 = const 7
    %1:i32 = const -1
    %2:i64 = const -5
    message show_log, %0, %1, %0, %2
    %3:f64 = const 2.5
    message clear, %0, %0, %1, %3)");
  m->scan();
  rung_message first{};
  rung_message second{};
  ASSERT_TRUE(m->messages().pop(first));
  ASSERT_TRUE(m->messages().pop(second));
  EXPECT_EQ(first.op, uint32_t{RUNG_MESSAGE_SHOW_LOG});
  EXPECT_EQ(first.number, 7u);
  EXPECT_EQ(first.channel, -1);
  EXPECT_EQ(first.index, 7);
  EXPECT_EQ(first.value, -5);
  EXPECT_EQ(first.real, 0u);
  EXPECT_EQ(first.rung, 0u);
  EXPECT_EQ(second.op, uint32_t{RUNG_MESSAGE_CLEAR});
  EXPECT_EQ(second.value, 0x4004000000000000);
  EXPECT_EQ(second.real, 1u);
}

TEST(InterpHost, ServicesAreAskedAndPolled) {
  Machine m = machineOf(R"(
    %0:i32 = load D[0]
    %1:i32 = const 0
    %2:bit = eq.i32 %0, %1
    if %2
      %3:i64 = const -4
      %4:i64 = const 5
      %5:i32 = service_request "ASK", %3, %4
    else %5
    %6:i32 = endif %0
    store.i32 D[0], %6
    %7:i32 = service_poll %6
    store.i32 D[1], %7
    %8:i64 = service_result 1, %6
    store.i64 D[2], %8)");
  m->scan();
  EXPECT_EQ(m.value("D", 4, 4), uint64_t{RUNG_SERVICE_PENDING});
  core::ServiceRequest request;
  ASSERT_TRUE(m->services().take(request));
  EXPECT_EQ(request.service, 0u);
  EXPECT_EQ(request.argCount, 2u);
  EXPECT_EQ(request.args[0], -4);
  EXPECT_EQ(request.args[1], 5);
  EXPECT_EQ(m.value("D", 0, 4), request.ticket);
  core::ServiceReply reply;
  reply.ticket = request.ticket;
  reply.resultCount = 2;
  reply.results[1] = -99;
  ASSERT_TRUE(m->services().complete(reply));
  m->scan();
  EXPECT_EQ(m.value("D", 4, 4), uint64_t{RUNG_SERVICE_DONE});
  EXPECT_EQ(static_cast<int64_t>(m.value("D", 8, 8)), -99);
}

TEST(InterpHost, CountsRungs) {
  Machine m(moduleForOp(OpCode::ProfEnter));
  m->scan();
  m->scan();
  ASSERT_EQ(m->profile().size(), 1u);
  EXPECT_EQ(m->profile()[0].count, 2u);
  EXPECT_GE(m->profile()[0].total, m->profile()[0].max);
}

// Operations in place of ticks: constants, notes and the ends of branches do not count, nor what is not executed; a
// transfer does, and a loop counts its passes.
TEST(InterpHost, CountsOperations) {
  const std::string first = rung(R"(
    prof_enter
    %0:bit = load B[0.0]
    %1:i32 = const 1
    if %0
      store.i32 D[1], %1
      store.i32 D[2], %1
    else
      store.i32 D[3], %1
    endif
    prof_leave)",
                                 "} goto 1");
  const std::string second = rung(R"(
    prof_enter
    %0:i32 = const 1
    %1:i32, %2:i32 = loop 3, %0
      %3:i32 = add %2, %0
    %4:i32 = endloop %3
    prof_leave)",
                                  "}", 1);
  std::string text = program(routine(first + second));
  text.insert(text.find('\n'), " instrumented");
  Module module = moduleFromText(text);
  const Layout layout(module, {});
  InterpEngine engine(layout, 1, Counting::Operations);
  runtime::Instance instance(engine);
  instance.scan();
  EXPECT_EQ(instance.profile()[0].total, 4u) << "load, if, store, goto";
  EXPECT_EQ(instance.profile()[1].total, 7u) << "loop, and three times add and endloop";
  instance.memory().writeByte(1, 0, 1);
  instance.scan();
  EXPECT_EQ(instance.profile()[0].total, 9u) << "two stores now";
  EXPECT_EQ(instance.profile()[0].max, 5u);
  EXPECT_EQ(instance.profile()[1].total, 14u);
}

TEST(InterpDeathTest, NeedsItsContext) {
  const Module module = moduleForOp(OpCode::Now);
  const Layout layout(module, {});
  InterpEngine engine(layout, 1);
  runtime::Instance instance(engine.program());
  EXPECT_DEATH(instance.scan(), "rung_ctx::engine");
}

// ---- whole modules -------------------------------------------------------------------------------------------------

// Neither the representation of bits nor the cut into chunks shows.
TEST(InterpModules, LayoutDoesNotShow) {
  LayoutOptions packed;
  packed.expandBits = false;
  packed.partition.maxChunkRungs = 1;
  for (uint64_t seed = 0; seed < 300; ++seed) {
    Module module = randomModule(seed);
    // Parts are cut at chunks and faults of budgets come at chunks.
    for (Task& task : module.tasks) cutTask(module, task, 1);
    Machine a(module);
    Machine b(module, packed);
    for (int scan = 0; scan < 4; ++scan) {
      a->scan();
      b->scan();
      const auto difference = runtime::firstDifference(*a, *b, nc::describe);
      ASSERT_FALSE(difference) << "seed " << seed << ", scan " << scan << ": " << *difference;
    }
  }
}

TEST(InterpModules, EveryOperationRunsAndLeavesATrace) {
  for (const OpInfo& info : allOps()) {
    Machine m(moduleForOp(info.code));
    Machine untouched(moduleForOp(info.code));
    m->scan();
    EXPECT_EQ(m->faulted(), info.code == OpCode::Trap) << info.name;
    EXPECT_TRUE(m->messages().size() > 0 ||
                !std::equal(m->block().begin(), m->block().end(), untouched->block().begin()))
        << info.name;
  }
}

// Every other engine takes such a byte for 0 or 1 as well: one that holds more has been written wrongly.
TEST(InterpModules, TheByteOfABitHoldsZeroOrOne) {
  Machine m = machineOf("%0:bit = load B[0.3]\nstore.bit B[0.4], %0");
  const BitLocation bit = m.layout().memory().bit(findSpace(m.module(), "B"), 3);
  ASSERT_TRUE(bit.wholeByte);
  m->block()[bit.offset] = 1;
  m->scan();
  EXPECT_TRUE(m.bit("B", 0, 4));
  const auto spoilt = [&] {
    m->block()[bit.offset] = 2;
    m->scan();
  };
  EXPECT_DEATH(spoilt(), "0 or 1");
}

} // namespace
} // namespace rung::ir
