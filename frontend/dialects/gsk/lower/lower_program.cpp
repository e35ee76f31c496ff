// Lowers a program of this control: presets from the configuration, and the parts of Level 2 (P3).
#include "frontend/dialects/gsk/config.h"
#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/network/lower/lower_module.h"
#include "ir/core/parts.h"
#include "ir/support/diag/gsk.h"
#include "rtlib/nc/faults.h"

namespace rung::frontend::gsk {
namespace {

constexpr network::Execution kExecution{.slotUs = kSlotUs,
                                        .budget = 1'000'000, // P6
                                        .overrunFault = nc::kPmcDeadLoop,
                                        .results = {areas::kR, kResultFlags},
                                        .resultBytes = kResultBytes};

void addPresets(network::ModuleLowering& lowering, const frontend::CompileOptions& options) {
  for (const Preset& preset : presetsOf(options)) {
    const auto low = static_cast<uint8_t>(preset.value & 0xFF);
    const auto high = static_cast<uint8_t>(preset.value >> 8);
    lowering.module().inits.push_back({lowering.spaceOf(preset.address.area), preset.address.byte, {low, high}});
  }
}

void reportLongRungs(network::ModuleLowering& lowering, const network::LevelState& level2,
                     const std::vector<ir::PartPiece>& pieces, uint64_t room, Diagnostics& diagnostics) {
  const std::vector<ir::Rung>& rungs = lowering.module().at(level2.entry()).rungs;
  for (const ir::PartPiece& piece : pieces) {
    if (piece.weight <= room) continue;
    const network::Network* network = lowering.networkOf(level2.level, rungs[piece.firstRung]);
    diagnostics.report(diag::RungTooLong, network == nullptr ? SourceRange{} : network->range) << piece.weight << room;
  }
}

// n of P3: computed from the period or from the steps per slot. With both, the period applies and must be long enough.
uint32_t partsOfLevel2(network::ModuleLowering& lowering, const frontend::CompileOptions& options,
                       Diagnostics& diagnostics) {
  const auto given = partsOf(options);
  const auto slotSteps = slotStepsOf(options);
  const uint32_t parts = given.value_or(1);
  if (!slotSteps) return parts;
  const network::LevelState& first = lowering.levels()[0];
  const network::LevelState& second = lowering.levels()[1];
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
        << *given * kSlotUs / 1000 << level1 + ir::longestPart(pieces, *given) << *slotSteps << needed * kSlotUs / 1000;
  return parts;
}

} // namespace

std::unique_ptr<ir::Module> lowerProgram(const network::Program& program, network::Context& context,
                                         std::span<const FileId> files, const frontend::CompileOptions& options) {
  network::ModuleLowering lowering(program, context, files, kExecution, options.marks, options.given != nullptr);
  addPresets(lowering, options);
  lowering.lowerUnits();
  lowering.addTasks(partsOfLevel2(lowering, options, context.diagnostics));
  return lowering.take();
}

} // namespace rung::frontend::gsk
