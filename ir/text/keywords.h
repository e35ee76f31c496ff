// Words of the text form for bits and enumerators; printer and parser use the same lists.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

#include "ir/core/module.h"
#include "ir/core/op_info.h"
#include "rtlib/text/letters.h"
#include "rung/program.h"

namespace rung::ir {

struct Keyword {
  std::string_view word;
  uint32_t value;
};

inline constexpr Keyword kSpaceFlags[] = {{"input", RUNG_SPACE_INPUT},
                                          {"output", RUNG_SPACE_OUTPUT},
                                          {"hidden", RUNG_SPACE_HIDDEN},
                                          {"allocated", RUNG_SPACE_ALLOCATED}};
inline constexpr Keyword kTimerFlags[] = {{"down", RUNG_TIMER_DOWN}, {"runs", RUNG_TIMER_RUNS}};
inline constexpr Keyword kSymbolFlags[] = {{"readonly", RUNG_SYMBOL_READONLY},
                                           {"hidden", RUNG_SYMBOL_HIDDEN},
                                           {"const", RUNG_SYMBOL_CONST},
                                           {"area", RUNG_SYMBOL_AREA}};
inline constexpr Keyword kSymbolTypes[] = {{"bit", RUNG_TYPE_BIT},  {"i8", RUNG_TYPE_I8},   {"i16", RUNG_TYPE_I16},
                                           {"i32", RUNG_TYPE_I32},  {"i64", RUNG_TYPE_I64}, {"f64", RUNG_TYPE_F64},
                                           {"text", RUNG_TYPE_TEXT}};
inline constexpr Keyword kStepOps[] = {{"advance", RUNG_STEP_ADVANCE},
                                       {"run", RUNG_STEP_RUN},
                                       {"part", RUNG_STEP_PART},
                                       {"hook", RUNG_STEP_HOOK},
                                       {"slot", RUNG_STEP_SLOT}};
struct StepList {
  std::string_view keyword;
  std::vector<Step> Module::* steps;
};
inline constexpr StepList kStepLists[] = {{"scan", &Module::scan}, {"fast", &Module::fast}, {"slice", &Module::slices}};
inline constexpr Keyword kMessageOps[] = {{"clear", RUNG_MESSAGE_CLEAR},
                                          {"show", RUNG_MESSAGE_SHOW},
                                          {"show_log", RUNG_MESSAGE_SHOW_LOG},
                                          {"log", RUNG_MESSAGE_LOG}};
inline constexpr Keyword kWeights[] = {{"mostly", kMostly}, {"seldom", kSeldom}};

// Null if there is none.
constexpr const Keyword* findKeyword(std::span<const Keyword> list, std::string_view word) {
  for (const Keyword& keyword : list)
    if (keyword.word == word) return &keyword;
  return nullptr;
}
constexpr const Keyword* findKeyword(std::span<const Keyword> list, uint32_t value) {
  for (const Keyword& keyword : list)
    if (keyword.value == value) return &keyword;
  return nullptr;
}

// Whether a name without quotes may contain the character; the first one must not be a digit.
constexpr bool isNameChar(char c) { return text::isLetter(c) || text::isDigit(c) || c == '_' || c == '@' || c == '.'; }

} // namespace rung::ir
