// See configuration.h.
#include "frontend/network/lower/configuration.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "frontend/sema/foreign_word.h"
#include "ir/core/parts.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/nc/pmc/slot.h"
#include "rtlib/text/number.h"

namespace rung::frontend::network {
namespace {

constexpr uint64_t kMaxParts = 1000; // 8 s
constexpr const char* kSlotSteps = "slot_steps";

// The number after `prefix`, 0 if it is malformed; nullopt if the key does not begin with `prefix`.
std::optional<uint64_t> numberOf(std::string_view key, std::string_view prefix) {
  if (!key.starts_with(prefix)) return std::nullopt;
  return parseDigits(key.substr(prefix.size())).value_or(0);
}

// A key of a page.
struct Entry {
  bool isTimer = false;
  uint64_t number = 0;
  uint64_t value = 0; // saturated
  uint64_t most = 0;
  uint64_t numbers = 0; // of the page
};

std::optional<Entry> entryOf(const PresetPages& pages, std::string_view key, const std::string& text) {
  const uint64_t value = text::wholeIn<uint64_t>(text).value_or(UINT64_MAX); // larger than every limit
  if (const auto timer = numberOf(key, "tmr."))
    return Entry{true, *timer, value, pages.timerUnitMs(*timer) * pages.mostTimer, pages.timers};
  if (const auto counter = numberOf(key, "ctr."))
    return Entry{false, *counter, value, pages.mostCounter, pages.counters};
  return std::nullopt;
}

void checkPreset(const Entry& entry, const std::string& key, const std::string& text,
                 const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const SourceRange place = options.placeOf(key);
  const text::NumberForm form = text::writtenNumber(text).form;
  if (entry.number < 1 || entry.number > entry.numbers) {
    diagnostics.report(diag::ConstantOutOfRange, place)
        << key << fmt::format("{0}.1 to {0}.{1}", entry.isTimer ? "tmr" : "ctr", entry.numbers);
  } else if (form == text::NumberForm::None || form == text::NumberForm::Real) {
    DiagBuilder report = diagnostics.report(diag::BadOperand, place);
    report << text << fmt::format("the value of {}, a whole number{}", key, entry.isTimer ? " of milliseconds" : "");
    if (const auto time = frontend::foreignTime(text); time && entry.isTimer)
      report.note(fmt::format("{} in milliseconds: {}", text, time->milliseconds()));
  } else if (entry.value > entry.most) {
    diagnostics.report(diag::ConstantOutOfRange, place)
        << fmt::format("{} {}", key, text) << fmt::format("0 to {}", entry.most);
  }
}

std::optional<uint64_t> periodOf(const frontend::CompileOptions& options) {
  const auto at = options.config.find("period_us");
  if (at == options.config.end()) return std::nullopt;
  return text::wholeIn<uint64_t>(at->second).value_or(0);
}

// n of P3, if the period is given.
std::optional<uint32_t> partsOf(const frontend::CompileOptions& options) {
  const auto period = periodOf(options);
  if (!period) return std::nullopt;
  return static_cast<uint32_t>(*period / nc::pmc::kSlotUs);
}

// The number of steps in one slot of 8 ms, including level 1, if given: n follows (man. l.434-444).
std::optional<uint32_t> slotStepsOf(const frontend::CompileOptions& options) {
  const auto at = options.config.find(kSlotSteps);
  if (at == options.config.end()) return std::nullopt;
  return text::wholeIn<uint32_t>(at->second).value_or(1);
}

void reportLongRungs(ModuleLowering& lowering, const LevelState& level2, const std::vector<ir::PartPiece>& pieces,
                     uint64_t room, Diagnostics& diagnostics) {
  const std::vector<ir::Rung>& rungs = lowering.module().at(level2.entry()).rungs;
  for (const ir::PartPiece& piece : pieces) {
    if (piece.weight <= room) continue;
    const Network* network = lowering.networkOf(level2.level, rungs[piece.firstRung]);
    diagnostics.report(diag::RungTooLong, network == nullptr ? SourceRange{} : network->range) << piece.weight << room;
  }
}

} // namespace

void checkConfig(const frontend::CompileOptions& options, const PresetPages& pages, std::span<const nc::ConfigKey> keys,
                 Diagnostics& diagnostics) {
  if (const auto period = periodOf(options);
      period && (*period == 0 || *period % nc::pmc::kSlotUs != 0 || *period / nc::pmc::kSlotUs > kMaxParts))
    diagnostics.report(diag::ConstantOutOfRange, options.placeOf("period_us"))
        << fmt::format("period_us {}", options.config.at("period_us"))
        << fmt::format("multiples of {} up to {}", nc::pmc::kSlotUs, nc::pmc::kSlotUs * kMaxParts);
  if (const auto steps = options.config.find(kSlotSteps); steps != options.config.end()) {
    const nc::ConfigKey& row = *nc::findConfigKey(keys, kSlotSteps);
    if (!nc::wrongValue(row, kSlotSteps, steps->second).empty())
      diagnostics.report(diag::ConstantOutOfRange, options.placeOf(kSlotSteps))
          << fmt::format("{} {}", kSlotSteps, steps->second) << nc::takesOf(row);
  }
  for (const auto& [key, text] : options.config)
    if (const auto entry = entryOf(pages, key, text)) checkPreset(*entry, key, text, options, diagnostics);
}

void addPresets(ModuleLowering& lowering, const frontend::CompileOptions& options, const PresetPages& pages) {
  for (const auto& [key, text] : options.config) {
    const auto entry = entryOf(pages, key, text);
    if (!entry) continue;
    const Address address = entry->isTimer ? pages.timerPreset(entry->number) : pages.counterPreset(entry->number);
    const uint64_t value = entry->isTimer ? entry->value / pages.timerUnitMs(entry->number) : entry->value;
    lowering.module().inits.push_back({lowering.spaceOf(address.area),
                                       address.byte,
                                       {static_cast<uint8_t>(value), static_cast<uint8_t>(value >> 8)}});
  }
}

uint32_t partsOfLevel2(ModuleLowering& lowering, const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const auto given = partsOf(options);
  const auto slotSteps = slotStepsOf(options);
  const uint32_t parts = given.value_or(1);
  if (!slotSteps) return parts;
  const LevelState& first = lowering.levels()[0];
  const LevelState& second = lowering.levels()[1];
  uint64_t level1 = 0;
  for (const ir::PartPiece& piece : ir::partPieces(lowering.module(), first.entry())) level1 += piece.weight;
  if (level1 >= *slotSteps) {
    diagnostics.report(diag::Level1TooLong) << level1 << *slotSteps;
    return parts;
  }
  const uint64_t room = *slotSteps - level1;
  const std::vector<ir::PartPiece> pieces = ir::partPieces(lowering.module(), second.entry());
  const uint32_t needed = ir::partsNeeded(pieces, room);
  if (needed == 0)
    reportLongRungs(lowering, second, pieces, room, diagnostics);
  else if (!given)
    return needed;
  else if (needed > *given)
    diagnostics.report(diag::PeriodTooShort)
        << *given * nc::pmc::kSlotUs / 1000 << level1 + ir::longestPart(pieces, *given) << *slotSteps
        << needed * nc::pmc::kSlotUs / 1000;
  return parts;
}

} // namespace rung::frontend::network
