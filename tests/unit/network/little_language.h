// A made-up language of the family: other names, areas, limits and functions than any dialect has.
#pragma once
#include <iterator>
#include <string_view>

#include "frontend/network/operand_kind.h"
#include "ir/support/diag/gsk.h"

namespace rung::network::test {

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

inline constexpr Row kRows[] = {
    {.info = {.mnemonic = "FASTEND", .number = 10}, .control = Control::LevelEnd},
    {.info = {.mnemonic = "SLOWEND", .number = 11}, .control = Control::LevelEnd},
    {.info = {.mnemonic = "PART", .number = 12, .operands = {kToPart}}, .control = Control::Sp},
    {.info = {.mnemonic = "PARTEND", .number = 13}, .control = Control::Spe},
    {.info = {.mnemonic = "VISIT", .number = 14, .pins = {kGo}, .operands = {kToPart}}, .control = Control::Call},
    {.info = {.mnemonic = "HOP", .number = 15, .pins = {kGo}, .operands = {kToMark}}, .control = Control::Jmpb},
    {.info = {.mnemonic = "HERE", .number = 16, .operands = {kToMark}, .placement = frontend::Placement::Anywhere},
     .control = Control::Lbl},
    {.info = {.mnemonic = "SKIP", .number = 17, .pins = {kGo}}, .control = Control::Jmp},
    {.info = {.mnemonic = "SKIPEND", .number = 18, .placement = frontend::Placement::AtRail}, .control = Control::Jmpe},
    {.info = {.mnemonic = "CLOCK",
              .number = 20,
              .pins = {frontend::PinInfo{.name = "HALT"}, kGo},
              .operands = {frontend::OperandInfo{.name = "clock", .kind = &kNumber, .min = 1, .max = 3}},
              .output = frontend::Output::Always},
     .numbers = Row::Numbers::Timer},
    {.info = {.mnemonic = "COPY",
              .number = 21,
              .pins = {kGo},
              .operands = {frontend::OperandInfo{.name = "from", .kind = &kByte},
                           frontend::OperandInfo{.name = "to", .kind = &kByte, .access = frontend::Access::Write}}}},
    {.info = {.mnemonic = "PICK",
              .number = 22,
              .pins = {kGo},
              .operands = {frontend::OperandInfo{.name = "work", .kind = &kWords},
                           frontend::OperandInfo{.name = "rows", .kind = &kNumber, .min = 1, .max = 9}}},
     .hasTable = true},
    {.info = {.mnemonic = "RISE", .number = 23, .pins = {kGo}, .output = frontend::Output::Always},
     .numbers = Row::Numbers::Edge},
    {.info = {.mnemonic = "LATER", .number = 24, .pins = {kGo}}, .built = false},
};

template <size_t N>
constexpr std::array<const Row*, N> pointersTo(const Row (&rows)[N]) {
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

inline constexpr Language kLittle = {
    .name = "little",
    .listExtension = ".lst",
    .commands = {"GET", "GETN", "WITH", "WITHN", "ELSE", "ELSEN", "MERGE", "MEET", "PUT", "PUTN", "HOLD", "DROP", "DO",
                 "ARG", "ROW", "DIALECT", "SYMBOL", "CONST"},
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

} // namespace rung::network::test
