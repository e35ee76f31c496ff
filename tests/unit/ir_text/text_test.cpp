// The text form: what it looks like, that it reads back in every field, and where errors are reported. Whole printed
// modules are goldens in tests/golden/ir.
#include <gtest/gtest.h>

#include "ir/core/builder.h"
#include "ir/core/op_info.h"
#include "ir/core/ops.h"
#include "ir/text/text.h"
#include "tests/random/random.h"
#include "tests/unit/ir_text/module_equal.h"

namespace rung::ir {
namespace {

void expectRoundTrip(const Module& module) {
  const std::string text = print(module);
  const ParseOutcome parsed = parse(text);
  ASSERT_TRUE(parsed.module) << parsed.error.line << ':' << parsed.error.column << ": " << parsed.error.message << '\n'
                             << text;
  EXPECT_TRUE(equal(*parsed.module, module)) << text;
  EXPECT_EQ(print(*parsed.module), text);
  EXPECT_EQ(hashOf(*parsed.module), hashOf(module)) << text;
}

TEST(TextRoundTrip, RandomModules) {
  for (uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    expectRoundTrip(randomModule(seed));
  }
}

TEST(TextRoundTrip, EveryOperation) {
  for (const OpInfo& info : allOps()) {
    SCOPED_TRACE(info.name);
    expectRoundTrip(moduleForOp(info.code));
  }
}

// Each field that the text shows of an operation.
TEST(Hash, ChangesWithEveryField) {
  Module module = moduleForOp(OpCode::StoreAt);
  Rung& rung = module.routines.at(0).rungs.at(0);
  ASSERT_FALSE(rung.ops.empty());
  ASSERT_FALSE(rung.args.empty());
  const std::string text = print(module);
  const uint64_t hash = hashOf(module);
  const auto expectOther = [&](auto& field, auto change) {
    const auto before = field;
    change(field);
    EXPECT_NE(hashOf(module), hash) << print(module);
    field = before;
  };
  const auto grow = [](auto& field) { ++field; };
  for (Op& op : rung.ops) {
    expectOther(op.code, [](OpCode& code) { code = code == OpCode::Note ? OpCode::Const : OpCode::Note; });
    expectOther(op.type, [](Type& type) { type = type == Type::I8 ? Type::I16 : Type::I8; });
    expectOther(op.line, grow);
    expectOther(op.ref, grow);
    expectOther(op.count, grow);
    expectOther(op.imm, grow);
    expectOther(op.imm, [](int64_t& imm) { imm = -imm - 1; });
  }
  for (ValueId& arg : rung.args) expectOther(arg.index, grow);
  for (Type& type : rung.values) expectOther(type, [](Type& t) { t = t == Type::I8 ? Type::I16 : Type::I8; });
  const auto lengthen = [](std::string& text) { text += "x"; };
  const auto repeat = [](auto& list) { list.push_back(list.back()); };
  const auto turn = [](bool& flag) { flag = !flag; };
  expectOther(rung.title, lengthen);
  expectOther(rung.title, [](std::string& title) { title = "nine bytes"; });
  expectOther(rung.sourceText, lengthen);
  expectOther(rung.begin.line, grow);
  expectOther(rung.weight, grow);
  expectOther(rung.key, grow);
  expectOther(rung.transferLine, grow);
  expectOther(rung.transfer.targets, [](std::vector<uint32_t>& targets) { targets.push_back(0); });
  expectOther(rung.origin, [](Origin& origin) { origin = {"R", 0}; });
  expectOther(module.name, lengthen);
  expectOther(module.spaces.at(0).units, grow);
  expectOther(module.spaces.at(0).packedOnly, turn);
  expectOther(module.routines, repeat);
  expectOther(module.tasks, repeat);
  expectOther(module.tasks.at(0).budget, grow);
  expectOther(module.scan, repeat);
  expectOther(module.slots, [](std::vector<Slot>& slots) { slots.push_back({}); });
  expectOther(module.symbols, [](std::vector<Symbol>& symbols) { symbols.push_back({}); });
  expectOther(module.continuations, [](std::vector<Continuation>& all) { all.push_back({}); });
  expectOther(module.timers, [](std::vector<Timer>& all) { all.push_back({}); });
  expectOther(module.messages, [](std::vector<MessageText>& messages) { messages.push_back({}); });
  expectOther(module.inits, [](std::vector<Init>& inits) { inits.push_back({}); });
  EXPECT_EQ(hashOf(module), hash);
  EXPECT_EQ(print(module), text);
}

TEST(TextRoundTrip, EmptyModule) { expectRoundTrip(Module{}); }

// Names and texts that need quotes and escapes.
TEST(TextRoundTrip, StrangeTexts) {
  Module module;
  const std::string strange[] = {"",
                                 " ",
                                 "a b",
                                 "1st",
                                 "\"quoted\"",
                                 "back\\slash",
                                 "line\nline\r\n",
                                 "tab\tbell\x07",
                                 "; no comment",
                                 "Straße",
                                 "@hidden",
                                 "-",
                                 "#1",
                                 std::string("nul\0x", 5),
                                 "\x7F"};
  for (const std::string& text : strange) {
    module.name = module.dialect = text;
    module.files = {text};
    module.messages = {{3, text}};
    module.spaces = {{.name = text, .unitBytes = 2, .units = 4}};
    module.symbols = {{.name = text, .comment = text, .space = SpaceId{0}}};
    module.slots = {{.key = text}};
    Rung rung;
    rung.title = rung.sourceText = text;
    rung.begin = {FileIndex{0}, 1, 2};
    RungBuilder builder(module, rung);
    builder.note(text);
    builder.store({SpaceId{0}, 1, 1}, builder.bit(true));
    module.routines = {{.name = "R", .rungs = {rung}}};
    SCOPED_TRACE(text);
    expectRoundTrip(module);
  }
}

// Where names are not unique, references are numbers.
TEST(TextRoundTrip, EqualNames) {
  Module module;
  module.spaces = {{.name = "D", .unitBytes = 1, .units = 4},
                   {.name = "D", .unitBytes = 4, .units = 4},
                   {.name = "E", .unitBytes = 4, .units = 4}};
  module.faults = {"f", "f"};
  module.retains = {{SpaceId{1}, 5, 1}, {SpaceId{2}, 6, 1}};
  Rung rung;
  rung.transfer = {.kind = TransferKind::Call, .callee = RoutineId{1}};
  module.routines = {{.name = "R", .rungs = {rung}}, {.name = "R", .rungs = {Rung{}}}};
  module.tasks = {{.name = "T", .entry = RoutineId{1}, .budgetFault = FaultId{1}}};
  const std::string text = print(module);
  EXPECT_NE(text.find("retain #1[1+1] size 1"), std::string::npos) << text;
  EXPECT_NE(text.find("retain E[1+2] size 1"), std::string::npos) << text;
  EXPECT_NE(text.find("} call #1"), std::string::npos) << text;
  expectRoundTrip(module);
}

TEST(TextRoundTrip, FieldsAtTheirLimits) {
  Module module;
  module.spaces = {{.name = "D", .unitBytes = 8, .units = UINT32_MAX, .flags = 0xFF, .packedOnly = true}};
  module.slots = {{.type = Type::I64, .init = INT64_MIN, .transient = true, .key = "a"},
                  {.type = Type::F64, .init = static_cast<int64_t>(0xFFF0000000000000), .key = "b"},
                  {.type = Type::I8, .init = 0x80, .key = "c"}};
  module.continuations = {{.key = "", .slot = SlotId{7}, .points = {}},
                          {.key = "\"", .space = SpaceId{0}, .byte = UINT32_MAX, .points = {"", "a b", "\n"}}};
  module.timers = {{.name = "\"",
                    .flags = RUNG_TIMER_DOWN | RUNG_TIMER_RUNS,
                    .time = {.type = Type::I64, .slot = SlotId{9}, .space = {}},
                    .timeUs = UINT32_MAX,
                    .running = SlotId{8},
                    .constant = INT64_MIN},
                   {.name = "",
                    .time = {.type = Type::I8, .slot = {}, .space = SpaceId{0}, .byte = 5},
                    .preset = {.type = Type::I32, .slot = {}, .space = SpaceId{0}, .byte = UINT32_MAX},
                    .unit = {.type = Type::I16, .slot = SlotId{1}, .space = {}},
                    .unitsUs = {0, UINT32_MAX, 7}}};
  module.symbols = {{.name = "S",
                     .space = SpaceId{},
                     .byte = 3,
                     .bit = 5,
                     .type = 99,
                     .count = 0,
                     .flags = 0xF0,
                     .value = INT64_MIN}};
  module.symbols[0].bit = 0;
  Rung rung;
  rung.key = UINT64_MAX;
  rung.weight = UINT32_MAX;
  rung.begin = {FileIndex{}, UINT32_MAX, UINT32_MAX};
  rung.lastLine = rung.transferLine = UINT32_MAX;
  RungBuilder builder(module, rung);
  for (int64_t value : {INT64_MIN, INT64_MAX, int64_t{-1}}) builder.constant(Type::I64, value);
  for (double value : {0.0, -0.0, 0.1, 1e308, 5e-324, 1.0 / 3}) builder.real(value);
  builder.constant(Type::F64, 0x7FF8000000000001);
  module.routines = {{.name = "R", .rungs = {rung}}};
  module.scan = {{77, TaskId{9}, UINT32_MAX}};
  module.fast = {{RUNG_STEP_SLOT, TaskId{}, 0}};
  module.mainTask = TaskId{3};
  expectRoundTrip(module);
}

// ---- the printed form ----------------------------------------------------------------------------------------------

class PrintedRung : public ::testing::Test {
protected:
  PrintedRung() {
    module_.files = {"main.lad"};
    module_.spaces = {{.name = "M", .unitBytes = 4, .units = 200}, {.name = "X", .unitBytes = 1, .units = 8}};
    module_.symbols = {{.name = "START", .space = SpaceId{0}, .byte = 402, .bit = 1},
                       {.name = "TABLE", .space = SpaceId{0}, .byte = 40, .type = RUNG_TYPE_I32, .count = 5}};
    module_.slots = {{.type = Type::Bit, .key = "edge"}};
    module_.faults = {"watchdog"};
  }
  std::string text() {
    module_.routines = {{.name = "MAIN", .rungs = {rung_}}};
    return printRung(module_, RoutineId{0}, 0);
  }

  Module module_;
  Rung rung_;
  RungBuilder b_{module_, rung_};
};

TEST_F(PrintedRung, LooksLikeThis) {
  rung_.number = 5;
  rung_.title = "seal-in";
  rung_.begin = {FileIndex{0}, 12, 1};
  rung_.lastLine = 13;
  rung_.key = 0xAB;
  rung_.weight = 4;
  rung_.sourceText = "--| |--\n";
  const ValueId start = b_.load(Type::Bit, {SpaceId{0}, 402, 1});
  const ValueId x = b_.load(Type::Bit, {SpaceId{1}, 3, 5});
  b_.setLine(13);
  const ValueId any = b_.or_(start, x);
  b_.if_(any);
  const ValueId word = b_.load(Type::I16, {SpaceId{0}, 402});
  b_.else_(std::vector{word});
  const ValueId minus = b_.constant(Type::I16, -7);
  const ValueId both = b_.endIf(std::vector{minus})[0];
  const ValueId large = b_.ltS(both, b_.constant(Type::I16, 100));
  const ValueId index = b_.i32(2);
  b_.storeAt({SpaceId{0}, 40, 5}, index, b_.i32(3));
  b_.slotStore(SlotId{0}, large);
  b_.trap(large, FaultId{0});
  rung_.transferLine = 14;
  b_.gotoRung(7, large);
  EXPECT_EQ(text(), R"(  rung 0 drawn 5 "seal-in" loc(main.lad:12:1-13) key(0x00000000000000AB) weight 4 {
    source "--| |--"
    source ""
    %0:bit = load M[100.17] ; "START"
    %1:bit = load X[3.5]
    %2:bit = or %0, %1 @13
    if %2 @13
      %3:i16 = load M[100+2] @13
    else %3 @13
      %4:i16 = const -7 @13
    %5:i16 = endif %4 @13
    %6:i16 = const 100 @13
    %7:bit = lt_s.i16 %5, %6 @13
    %8:i32 = const 2 @13
    %9:i32 = const 3 @13
    store_at.i32 M[10 count 5], %8, %9 @13 ; "TABLE"
    slot_store.bit $0, %7 @13 ; "edge"
    trap watchdog, %7 @13
  } goto 7 if %7 @14
)");
}

TEST_F(PrintedRung, RemarksStandUnderTheirOperation) {
  b_.if_(b_.bit(true));
  b_.note("x");
  b_.endIf();
  module_.routines = {{.name = "MAIN", .rungs = {rung_}}};
  const std::string printed = printRung(module_, RoutineId{0}, 0, [](size_t i) {
    return i == 2 ? "wrong\nhere" : i == 4 ? "and here" : "";
  });
  EXPECT_EQ(printed, R"(  rung 0 "" loc(-:0:0-0) key(0x0000000000000000) weight 1 {
    %0:bit = const 1
    if %0
      note "x"
      ; ^ wrong here
    endif
  }
  ; ^ and here
)");
}

// The printer shows what the verifier rejects.
TEST_F(PrintedRung, BrokenRungsPrint) {
  b_.load(Type::I32, {SpaceId{0}, 4});
  b_.i32(1);
  rung_.ops[0].ref = 77;
  rung_.ops[0].imm = -3;
  rung_.ops[1].imm = static_cast<int64_t>(0x1FFFFFFFFF);
  rung_.ops.push_back(
      {.code = OpCode::Add, .type = Type::Bit, .argCount = 2, .resultCount = 1, .firstArg = 50, .result = ValueId{99}});
  rung_.ops.push_back({.code = OpCode::Note, .ref = 5});
  rung_.ops.push_back({.code = OpCode::Message, .ref = 9});
  rung_.ops.push_back({.code = OpCode::SlotLoad, .ref = 9});
  rung_.ops.push_back({.code = OpCode::EndIf});
  const std::string printed = text();
  EXPECT_NE(printed.find("%0:i32 = load #77[!-3]"), std::string::npos) << printed;
  EXPECT_NE(printed.find("const bits(0x1FFFFFFFFF)"), std::string::npos) << printed;
  EXPECT_NE(printed.find("%99:none = add.bit %?, %?"), std::string::npos) << printed;
}

// ---- parsing -------------------------------------------------------------------------------------------------------

TEST(TextParse, SpacingAndCommentsMeanNothing) {
  const ParseOutcome parsed = parse(R"(
; a module
  module "m"   dialect "d" ; here

file "a.lad"
space D unit 1 units 4
routine R {	; begin

rung 0 "" loc(  "a.lad" : 1 : 0 - 2) key ( 0x1f ) weight 1 {
%0 :bit=load D[ 2 . 3 ]
      store.bit   D[0.0],%0   @ 4
}
})");
  ASSERT_TRUE(parsed.module) << parsed.error.line << ": " << parsed.error.message;
  const Rung& rung = parsed.module->routines[0].rungs[0];
  EXPECT_EQ(rung.key, 0x1Fu);
  EXPECT_EQ(rung.ops[0].imm, 19);
  EXPECT_EQ(rung.ops[1].line, 4u);
}

struct Mistake {
  const char* text;
  uint32_t line;
  uint32_t column;
  const char* message;
};

TEST(TextParse, ErrorsSayWhere) {
  const std::string head = "module \"m\" dialect \"d\"\n";
  const std::string inRung =
      head + "space D unit 1 units 8\nservice S\nroutine R {\nrung 0 \"\" loc(-:0:0-0) key(0) weight 1 {\n";
  const Mistake whole[] = {
      {"", 1, 1, "'module' expected"},
      {"modul", 1, 1, "'module' expected"},
      {"module m", 1, 8, "'\"' expected"},
      {"module \"m\" dialect \"d", 1, 20, "text without its closing quote"},
      {"module \"m\" dialect \"d\" x", 1, 24, "end of line expected"},
      {"module \"\\q\" dialect \"\"", 1, 8, "unknown escape"},
      {"module \"\\x4\" dialect \"\"", 1, 8, "two hexadecimal digits expected after \\x"},
  };
  const Mistake declarations[] = {
      {"nonsense", 2, 1, "there is no declaration 'nonsense'"},
      {"module \"m\" dialect \"d\"", 2, 1, "there is no declaration 'module'"},
      {"space D unit one", 2, 14, "number expected"},
      {"space D unit 4294967296", 2, 14, "number too large"},
      {"space D unit 1 units 1 wet", 2, 24, "end of line expected"},
      {"slot $1 bit init 0 \"\"", 2, 7, "the next slot is $0"},
      {"slot $0 f32 init 0 \"\"", 2, 9, "there is no type 'f32'"},
      {"symbol S bit E[0.0] count 1 value 0 \"\"", 2, 14, "there is no space 'E'"},
      {"symbol S i128 -[0] count 1 value 0 \"\"", 2, 10, "there is no type 'i128'"},
      {"init -[0] 0A1", 2, 11, "two hexadecimal digits a byte expected"},
      {"retain -[99999999999] size 1", 2, 21, "offset too large"},
      {"routine R {\n  rung 1 \"\"", 3, 8, "the next rung is 0"},
      {"routine R {\n  rung 0 \"\" loc(x:1:1-1)", 3, 17, "there is no file 'x'"},
      {"routine R {", 2, 12, "'}' expected"},
      {"task T entry R", 2, 14, "there is no routine 'R'"},
      {"step scan jump - 0", 2, 11, "there is no step 'jump'"},
      {"step slow", 2, 6, "'scan', 'fast' or 'slice' expected"},
      {"task T entry - period 0 budget 0 fault - parts 1 {\nbegin -[0] -[0]", 3, 13, "'>' expected"},
  };
  const Mistake ops[] = {
      {"%1:bit = const 1", 6, 2, "the next value is %0"},
      {"%0:bit = constant 1", 6, 10, "there is no operation 'constant'"},
      {"%0:bit = const", 6, 15, "number expected"},
      {"const 1", 6, 1, "'const' needs a type"},
      {"store.f32 D[0], %0", 6, 1, "there is no type 'f32'"},
      {"store.bit D[0], %0", 6, 14, "'.' expected"},
      {"store.i8 D[0.1], %0", 6, 13, "']' expected"},
      {"store_at.i8 D[0], %0", 6, 16, "'count' expected"},
      {"message shout", 6, 9, "unknown kind of message 'shout'"},
      {"trap f, %0", 6, 6, "there is no fault 'f'"},
      {"if x", 6, 4, "end of line expected"},
      {"if %", 6, 5, "number expected"},
      {"} goto", 6, 7, "number expected"},
      {"} call Q\n}", 7, 2, "there is no routine 'Q'"},
      {"} jump 1", 6, 3, "end of line expected"},
      {"note x", 6, 6, "'\"' expected"},
  };
  const auto expect = [](const std::string& text, const Mistake& mistake) {
    const ParseOutcome parsed = parse(text);
    ASSERT_FALSE(parsed.module) << text;
    EXPECT_EQ(parsed.error.message, mistake.message) << text;
    EXPECT_EQ(parsed.error.line, mistake.line) << text;
    EXPECT_EQ(parsed.error.column, mistake.column) << text;
  };
  for (const Mistake& mistake : whole) expect(mistake.text, mistake);
  for (const Mistake& mistake : declarations) expect(head + mistake.text, mistake);
  for (const Mistake& mistake : ops) expect(inRung + mistake.text, mistake);
}

// Every beginning of a module is either one or an error; none hangs or crashes.
TEST(TextParse, TruncatedTexts) {
  const std::string text = print(randomModule(3, {.routines = 1, .rungs = 2, .ops = 12}));
  for (size_t length = 0; length < text.size(); ++length) {
    const ParseOutcome parsed = parse(std::string_view(text).substr(0, length));
    if (!parsed.module) {
      EXPECT_FALSE(parsed.error.message.empty());
    }
  }
}

// tests/growth counts what it costs.
TEST(TextParse, LargeModules) {
  Module module;
  module.files = {"a"};
  module.spaces = {{.name = "X", .unitBytes = 1, .units = 100000}};
  Rung rung;
  RungBuilder builder(module, rung);
  const ValueId x = builder.load(Type::Bit, {SpaceId{0}, 5, 1});
  builder.store({SpaceId{0}, 6, 1}, x);
  module.routines = {{.name = "R", .rungs = std::vector<Rung>(100000, rung)}};
  for (uint32_t i = 0; i < 100000; ++i)
    module.symbols.push_back({.name = "S" + std::to_string(i), .space = SpaceId{0}, .byte = i});
  expectRoundTrip(module);
}

} // namespace
} // namespace rung::ir
