// Reads and checks the configuration.
#include "frontend/dialects/gsk/config.h"

#include <optional>
#include <string>

#include <fmt/format.h>

#include "frontend/sema/foreign_word.h"
#include "ir/support/diag/operand.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/text/number.h"

namespace rung::frontend::gsk {
namespace {

constexpr uint64_t kMaxParts = 1000; // 8 s
constexpr uint64_t kNumbers = 100;   // number of timers, and of counters
constexpr uint64_t kMaxWord = 65535;
constexpr const char* kSlotSteps = "slot_steps";

// The number after `prefix`, 0 if it is malformed; nullopt if the key does not begin with `prefix`.
std::optional<uint64_t> numberOf(std::string_view key, std::string_view prefix) {
  if (!key.starts_with(prefix)) return std::nullopt;
  return network::parseDigits(key.substr(prefix.size())).value_or(0);
}

constexpr std::string_view kTimer = "tmr";

struct Entry {
  std::string_view family;
  uint64_t number;
  uint64_t value; // saturated
  uint64_t max;
};

std::optional<Entry> entryOf(std::string_view key, const std::string& text) {
  const uint64_t value = text::wholeIn<uint64_t>(text).value_or(UINT64_MAX); // larger than every limit
  if (const auto timer = numberOf(key, "tmr."))
    return Entry{kTimer, *timer, value, timerUnitMs(static_cast<int64_t>(*timer)) * kMaxWord};
  if (const auto counter = numberOf(key, "ctr.")) return Entry{"ctr", *counter, value, kMaxWord};
  return std::nullopt;
}

void checkPreset(const Entry& entry, const std::string& key, const std::string& text,
                 const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const SourceRange place = options.placeOf(key);
  const text::NumberForm form = text::writtenNumber(text).form;
  if (entry.number < 1 || entry.number > kNumbers) {
    diagnostics.report(diag::ConstantOutOfRange, place)
        << key << fmt::format("{0}.1 to {0}.{1}", entry.family, kNumbers);
  } else if (form == text::NumberForm::None || form == text::NumberForm::Real) {
    DiagBuilder report = diagnostics.report(diag::BadOperand, place);
    report << text
           << fmt::format("the value of {}, a whole number{}", key, entry.family == kTimer ? " of milliseconds" : "");
    if (const auto time = frontend::foreignTime(text); time && entry.family == kTimer)
      report.note(fmt::format("{} in milliseconds: {}", text, time->milliseconds()));
  } else if (entry.value > entry.max) {
    diagnostics.report(diag::ConstantOutOfRange, place)
        << fmt::format("{} {}", key, text) << fmt::format("0 to {}", entry.max);
  }
}

std::optional<uint64_t> periodOf(const frontend::CompileOptions& options) {
  const auto at = options.config.find("period_us");
  if (at == options.config.end()) return std::nullopt;
  return text::wholeIn<uint64_t>(at->second).value_or(0);
}

} // namespace

void checkConfig(const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  if (const auto period = periodOf(options);
      period && (*period == 0 || *period % kSlotUs != 0 || *period / kSlotUs > kMaxParts))
    diagnostics.report(diag::ConstantOutOfRange, options.placeOf("period_us"))
        << fmt::format("period_us {}", options.config.at("period_us"))
        << fmt::format("multiples of {} up to {}", kSlotUs, kSlotUs * kMaxParts);
  if (const auto steps = options.config.find(kSlotSteps); steps != options.config.end()) {
    const nc::ConfigKey& row = *nc::findConfigKey(nc::gskConfigKeys(), kSlotSteps);
    if (!nc::wrongValue(row, kSlotSteps, steps->second).empty())
      diagnostics.report(diag::ConstantOutOfRange, options.placeOf(kSlotSteps))
          << fmt::format("{} {}", kSlotSteps, steps->second) << nc::takesOf(row);
  }
  for (const auto& [key, text] : options.config)
    if (const auto entry = entryOf(key, text)) checkPreset(*entry, key, text, options, diagnostics);
}

std::optional<uint32_t> partsOf(const frontend::CompileOptions& options) {
  const auto period = periodOf(options);
  if (!period) return std::nullopt;
  return static_cast<uint32_t>(*period / kSlotUs);
}

std::optional<uint32_t> slotStepsOf(const frontend::CompileOptions& options) {
  const auto at = options.config.find(kSlotSteps);
  if (at == options.config.end()) return std::nullopt;
  return text::wholeIn<uint32_t>(at->second).value_or(1);
}

Machine configuredMachine(const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const auto at = options.config.find("machine");
  if (at == options.config.end()) return Machine::Any;
  if (at->second == "mill") return Machine::Mill;
  if (at->second == "turn") return Machine::Turn;
  diagnostics.report(diag::ConstantOutOfRange, options.placeOf("machine"))
      << "machine " + at->second << nc::takesOf(*nc::findConfigKey(nc::gskConfigKeys(), "machine"));
  return Machine::Any;
}

std::vector<Preset> presetsOf(const frontend::CompileOptions& options) {
  std::vector<Preset> result;
  for (const auto& [key, text] : options.config) {
    const auto entry = entryOf(key, text);
    if (!entry) continue;
    const auto number = static_cast<int64_t>(entry->number);
    const bool timer = entry->family == kTimer;
    result.push_back({timer ? timerPreset(number) : counterPreset(number),
                      static_cast<uint32_t>(timer ? entry->value / timerUnitMs(number) : entry->value)});
  }
  return result;
}

} // namespace rung::frontend::gsk
