// Reads the configuration (see config.h).
#include "frontend/dialects/nct/config.h"

#include <algorithm>

#include "ir/support/diag/operand.h"
#include "ir/support/diag/project.h"
#include "rtlib/nc/config_key.h"
#include "rtlib/nc/nct/signals.h"

namespace rung::frontend::nct {
namespace {

const nc::ConfigKey& rowOf(const char* key) { return *nc::findConfigKey(nc::nctConfigKeys(), key); }

void readPeriod(const frontend::CompileOptions& options, const char* key, int64_t (*parse)(std::string_view),
                uint32_t& out, Diagnostics& diagnostics) {
  const auto entry = options.config.find(key);
  if (entry == options.config.end()) return;
  const std::string wrong = nc::wrongValue(rowOf(key), key, entry->second);
  if (wrong.empty())
    out = static_cast<uint32_t>(parse(entry->second));
  else
    diagnostics.report(diag::ConfigValue, options.placeOf(key)) << wrong;
}

void readWord(const frontend::CompileOptions& options, const char* key, uint32_t least, uint32_t& out,
              Diagnostics& diagnostics) {
  const auto entry = options.config.find(key);
  if (entry == options.config.end()) return;
  const int64_t word = nc::wholeNumber(entry->second);
  if (word >= least && word < kWords)
    out = static_cast<uint32_t>(word);
  else
    diagnostics.report(diag::ConstantOutOfRange, options.placeOf(key))
        << std::string(key) + " " + entry->second << std::to_string(least) + " to " + std::to_string(kWords - 1);
}

// First word of the outputs; the words of the inputs precede them (rtlib/nc/nct/signals.h).
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
  readWord(options, "PLCNVRAM", nc::areaBytes(nc::nctSignals(), "M") / 4, config.plcNvram, diagnostics);
  config.plcRam = config.plcNvram + userMemory < kWords ? config.plcNvram + userMemory : kWords - 1;
  readWord(options, "PLCRAM", config.plcNvram, config.plcRam, diagnostics);
  readPeriod(options, "period_us", nc::wholeNumber, config.periodUs, diagnostics);
  config.timesliceUs = config.periodUs >= 5 ? config.periodUs / 5 : 1;
  readPeriod(options, "timeslice", nc::durationUs, config.timesliceUs, diagnostics);
  // If only the time slice is configured, a cycle of MAIN has five of them, as by default.
  if (options.config.contains("timeslice") && !options.config.contains("period_us"))
    config.periodUs = 5 * config.timesliceUs;
  return config;
}

} // namespace rung::frontend::nct
