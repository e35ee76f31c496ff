// Lowers a program of this control.
#include "frontend/dialects/gsk/config.h"
#include "frontend/dialects/gsk/lower/lower.h"
#include "frontend/network/lower/lower_module.h"
#include "rtlib/nc/faults.h"
#include "rtlib/nc/pmc/slot.h"

namespace rung::frontend::gsk {
namespace {

const network::Execution kExecution{.slotUs = nc::pmc::kSlotUs,
                                    .budget = 1'000'000, // P6
                                    .overrunFault = nc::kPmcDeadLoop,
                                    .results = {areas::kR, kResultFlags},
                                    .resultBytes = kResultBytes};

} // namespace

std::unique_ptr<ir::Module> lowerProgram(const network::Program& program, network::Context& context,
                                         std::span<const FileId> files, const frontend::CompileOptions& options) {
  network::ModuleLowering lowering(program, context, files, kExecution, options.marks, options.given != nullptr);
  addPresets(lowering, options, kPages);
  lowering.lowerUnits();
  lowering.addTasks(partsOfLevel2(lowering, options, context.diagnostics));
  return lowering.take();
}

} // namespace rung::frontend::gsk
