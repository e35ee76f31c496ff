// A made-up language of the family: other names, areas, limits and functions than any dialect has.
#pragma once
#include <iterator>
#include <string_view>
#include <vector>

#include "frontend/network/lower/lower_function.h"
#include "frontend/network/operand_kind.h"
#include "frontend/network/read/list_reader.h"
#include "ir/support/diag/pmc.h"

namespace rung::frontend::network::test {

inline constexpr AreaInfo kAreas[] = {
    {.letter = 'I', .bytes = 4, .use = AreaUse::Input, .doc = "inputs"},
    {.letter = 'Q', .bytes = 4, .use = AreaUse::Output, .doc = "outputs"},
    {.letter = 'M', .bytes = 16, .doc = "memory", .system = 12},
    {.letter = 'Z', .bytes = 9, .doc = "a preset and two bytes each", .presets = {1, 3}},
};

inline constexpr OperandKind kByte{{"byte", "an address"}, {}};
inline constexpr OperandKind kWords{{"words", "an address of 2 bytes in M"},
                                    {.bytes = 2, .area = Area{2}, .elsewhere = diag::WorkAreaNotInR}};
inline constexpr OperandKind kNumber{{"number", "a number"}, {.parse = OperandClass::Number}};
inline constexpr OperandKind kMark{{"mark", "K1 to K9"}, {.parse = OperandClass::Named, .written = "K{}"}};
inline constexpr OperandKind kPart{{"part", "U1 to U9"}, {.parse = OperandClass::Named, .written = "U{}"}};

inline constexpr frontend::OperandInfo kToMark = {
    .name = "mark", .kind = &kMark, .access = frontend::Access::None, .doc = "K1-K9", .min = 1, .max = 9};
inline constexpr frontend::OperandInfo kToPart = {
    .name = "part", .kind = &kPart, .access = frontend::Access::None, .doc = "U1-U9", .min = 1, .max = 9};
inline constexpr frontend::PinInfo kGo = {.name = "GO"};

inline void lowerCopy(Lowering& f) {
  f.b.when(f.act(), [&] { f.store(f.param(1).address, f.load(ir::Type::I8, f.param(0).address)); });
}
inline void lowerRise(Lowering& f) { f.setOutput(f.act()); }

inline constexpr LoweredRow kRows[] = {
    {{.info = {.mnemonic = "FASTEND", .number = 10}, .control = Control::LevelEnd}, &lowerEnd},
    {{.info = {.mnemonic = "SLOWEND", .number = 11}, .control = Control::LevelEnd}, &lowerEnd},
    {{.info = {.mnemonic = "PART", .number = 12, .operands = {kToPart}}, .control = Control::Sp}, &lowerMark},
    {{.info = {.mnemonic = "PARTEND", .number = 13}, .control = Control::Spe}, &lowerEnd},
    {{.info = {.mnemonic = "VISIT", .number = 14, .pins = {kGo}, .operands = {kToPart}}, .control = Control::Call},
     &lowerCall},
    {{.info = {.mnemonic = "HOP", .number = 15, .pins = {kGo}, .operands = {kToMark}}, .control = Control::Jmpb},
     &lowerJump},
    {{.info = {.mnemonic = "HERE", .number = 16, .operands = {kToMark}}, .control = Control::Lbl}, &lowerMark},
    {{.info = {.mnemonic = "SKIP", .number = 17, .pins = {kGo}}, .control = Control::Jmp}, &lowerJump},
    {{.info = {.mnemonic = "SKIPEND", .number = 18}, .control = Control::Jmpe}, &lowerMark},
    {{.info = {.mnemonic = "CLOCK",
               .number = 20,
               .pins = {frontend::PinInfo{.name = "HALT"}, kGo},
               .operands = {frontend::OperandInfo{.name = "clock", .kind = &kNumber, .min = 1, .max = 3}},
               .output = frontend::Output::Always},
      .numbers = Row::Numbers::Timer}},
    {{.info = {.mnemonic = "COPY",
               .number = 21,
               .pins = {kGo},
               .operands = {frontend::OperandInfo{.name = "from", .kind = &kByte},
                            frontend::OperandInfo{.name = "to", .kind = &kByte, .access = frontend::Access::Write}}}},
     &lowerCopy},
    {{.info = {.mnemonic = "PICK",
               .number = 22,
               .pins = {kGo},
               .operands = {frontend::OperandInfo{.name = "work", .kind = &kWords},
                            frontend::OperandInfo{.name = "rows", .kind = &kNumber, .min = 1, .max = 9}}},
      .hasTable = true}},
    {{.info = {.mnemonic = "RISE", .number = 23, .pins = {kGo}, .output = frontend::Output::Always},
      .numbers = Row::Numbers::Edge},
     &lowerRise},
    {{.info = {.mnemonic = "LATER", .number = 24, .pins = {kGo}}, .built = false}},
};

template <size_t N>
constexpr std::array<const Row*, N> pointersTo(const LoweredRow (&rows)[N]) {
  std::array<const Row*, N> result{};
  for (size_t i = 0; i < N; ++i) result[i] = &rows[i];
  return result;
}
inline constexpr auto kRowPointers = pointersTo(kRows);

inline constexpr Level kLevels[] = {
    {.name = "FAST",
     .end = "FASTEND",
     .turn = Turn::EverySlot,
     .endMissing = diag::MissingEnd1,
     .endTwice = diag::DuplicateEnd1},
    {.name = "SLOW",
     .end = "SLOWEND",
     .turn = Turn::Parts,
     .endMissing = diag::MissingEnd2,
     .endTwice = diag::DuplicateEnd2},
};
inline constexpr uint32_t kFast = 0;
inline constexpr uint32_t kSlow = 1;

inline const nc::SignalTable& signals() {
  static constexpr nc::Signal kSignals[] = {
      {"*DOOR", "I1.7", "I", 1, 7, nc::SignalType::Bit, nc::Direction::In, 1, 0, "", "", "the door is open", 1, false}};
  static constexpr uint16_t kByName[] = {0};
  static constexpr nc::SignalTable kTable{kSignals, kByName, false};
  return kTable;
}

inline const frontend::InstructionInfo* findBox(std::string_view mnemonic);

inline constexpr std::string_view kExtensions[] = {".lst"};
inline constexpr Language kLittle = {
    .name = "little",
    .listExtensions = kExtensions,
    .list = kCommandList,
    .commands = {"GET", "GETN", "WITH", "WITHN", "ELSE", "ELSEN", "", "MERGE", "MEET", "PUT", "PUTN", "HOLD", "DROP",
                 "DO", "ARG", "ROW", "DIALECT", "SYMBOL", "CONST"},
    .rows = kRowPointers,
    .areas = kAreas,
    .signals = signals,
    .levels = kLevels,
    .subprogram = "EXTRA",
    .messageTexts = "this language has none",
    .maxSteps = 40,
    .stackDepth = 3,
    .maxCallDepth = 2,
    .findBox = findBox,
};

inline const frontend::InstructionInfo* findBox(std::string_view mnemonic) {
  const Row* row = kLittle.findFunction(mnemonic);
  return row == nullptr ? nullptr : &row->info;
}

// A language with one level more, of which it says nothing but a row in each of its lists.
class ThreeLevels {
public:
  ThreeLevels() {
    for (const Row* row : kRowPointers) rows_.push_back(row);
    rows_.push_back(&idleEnd_);
    language_.levels = levels_;
    language_.rows = rows_;
  }
  ThreeLevels(const ThreeLevels&) = delete;
  const Language& language() const { return language_; }

private:
  LoweredRow idleEnd_{{.info = {.mnemonic = "IDLEEND", .number = 30}, .control = Control::LevelEnd}, &lowerEnd};
  std::vector<const Row*> rows_;
  Level levels_[3] = {kLevels[kFast],
                      kLevels[kSlow],
                      {.name = "IDLE",
                       .end = "IDLEEND",
                       .turn = Turn::LastSlot,
                       .endMissing = diag::MissingEnd2,
                       .endTwice = diag::DuplicateEnd2}};
  Language language_ = kLittle;
};

} // namespace rung::frontend::network::test
