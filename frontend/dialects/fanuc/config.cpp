// See config.h.
#include "frontend/dialects/fanuc/config.h"

#include "frontend/dialects/fanuc/language.h"
#include "frontend/dialects/fanuc/read/parameters.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"

namespace rung::frontend::fanuc {

Pmc configuredPmc(const frontend::CompileOptions& options, const SourceManager& sources, const MnemonicFiles& files,
                  Diagnostics& diagnostics) {
  if (const auto at = options.config.find("pmc"); at != options.config.end()) {
    const std::optional<Pmc> pmc = pmcNamed(at->second);
    if (!pmc) diagnostics.report(diag::UnknownPmc, options.placeOf("pmc")) << at->second;
    return pmc.value_or(Pmc::MemB);
  }
  for (const auto& file : files)
    if (const auto text = systemParameter(sources, *file, kPmcType)) {
      const std::optional<Pmc> pmc = pmcNamed(text->text);
      if (!pmc) diagnostics.report(diag::UnknownPmc, text->range) << text->text;
      return pmc.value_or(Pmc::MemB);
    }
  return Pmc::MemB;
}

network::PresetPages pagesOf(Pmc pmc) {
  const auto room = [&](network::Area area) { return areasOf(pmc)[static_cast<size_t>(area)].room(0); };
  return {.timers = room(areas::kT) / 2,
          .counters = room(areas::kC) / 4,
          .mostTimer = 32767,
          .mostCounter = 32767,
          .timerUnitMs = timerUnitMs,
          .timerPreset = timerPreset,
          .counterPreset = counterPreset};
}

} // namespace rung::frontend::fanuc
