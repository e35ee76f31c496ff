// Reading the configuration (see config.h).
#include "frontend/dialects/nct/config.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "rtlib/nc/nct/signals.h"

namespace rung::nct {
namespace {

using Options = std::map<std::string, std::string>;

// A number and what stands behind it.
struct Quantity {
  uint64_t number = 0;
  std::string_view unit;
};

std::optional<Quantity> quantity(std::string_view text) {
  Quantity q;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), q.number);
  if (error != std::errc() || q.number > UINT32_MAX) return std::nullopt;
  q.unit = text.substr(static_cast<size_t>(end - text.data()));
  return q;
}

// Microseconds; a bare number counts them already.
std::optional<uint64_t> duration(std::string_view text) {
  const std::optional<Quantity> q = quantity(text);
  if (!q) return std::nullopt;
  if (q->unit.empty() || q->unit == "us") return q->number;
  if (q->unit == "ms") return q->number * 1000;
  if (q->unit == "s") return q->number * 1'000'000;
  return std::nullopt;
}

void readDuration(const Options& options, const char* key, uint32_t& out, Diagnostics& diagnostics) {
  const auto entry = options.find(key);
  if (entry == options.end()) return;
  const std::optional<uint64_t> value = duration(entry->second);
  if (value && *value >= 1 && *value <= 3'600'000'000u)
    out = static_cast<uint32_t>(*value);
  else
    diagnostics.report(Diag::BadOperand) << entry->second << "duration of at most an hour such as 2ms or 500us";
}

void readWord(const Options& options, const char* key, uint32_t least, uint32_t& out, Diagnostics& diagnostics) {
  const auto entry = options.find(key);
  if (entry == options.end()) return;
  const std::optional<Quantity> q = quantity(entry->second);
  if (q && q->unit.empty() && q->number >= least && q->number < kWords)
    out = static_cast<uint32_t>(q->number);
  else
    diagnostics.report(Diag::ConstantOutOfRange)
        << std::string(key) + " " + entry->second << std::to_string(least) + " to " + std::to_string(kWords - 1);
}

// The words of the inputs come first (rtlib/nc/nct/signals.h).
uint32_t firstOutputWord() {
  uint32_t first = UINT32_MAX;
  for (const nc::Signal& signal : nc::nctSignals())
    if (signal.direction == nc::Direction::Out) first = std::min(first, signal.byteOffset / 4);
  return first;
}

} // namespace

Config readConfig(const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  Config config;
  config.firstOutput = firstOutputWord();
  const uint32_t userMemory = config.plcRam - config.plcNvram;
  readWord(options.config, "PLCNVRAM", nc::areaBytes(nc::nctSignals(), "M") / 4, config.plcNvram, diagnostics);
  config.plcRam = config.plcNvram + userMemory < kWords ? config.plcNvram + userMemory : kWords - 1;
  readWord(options.config, "PLCRAM", config.plcNvram, config.plcRam, diagnostics);
  readDuration(options.config, "period_us", config.periodUs, diagnostics);
  config.timesliceUs = config.periodUs >= 5 ? config.periodUs / 5 : 1;
  readDuration(options.config, "timeslice", config.timesliceUs, diagnostics);
  // A time slice without a period of its own: five of them belong to a cycle of MAIN, as by default.
  if (options.config.contains("timeslice") && !options.config.contains("period_us"))
    config.periodUs = 5 * config.timesliceUs;
  return config;
}

} // namespace rung::nct
