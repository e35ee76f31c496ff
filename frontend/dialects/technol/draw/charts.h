// The whole program as drawings.
#pragma once
#include "frontend/chart/chart.h"
#include "frontend/dialects/technol/check/typed.h"
#include "frontend/dialects/technol/lower/trace.h"

namespace rung::frontend::technol {

// `module` as it was built of the program, with its trace; `analysis` is of the program.
chart::Program chartsOf(const TypedProgram& program, const Analysis& analysis, const Trace& trace,
                        const ir::Module& module);

} // namespace rung::frontend::technol
