// Coverage of a program in the terms of its drawing.
#pragma once
#include "tools/report/coverage_report.h"
#include "tools/view/overlay.h"

namespace rung::rungc {

view::Overlay overlayOf(const report::Program& program);

} // namespace rung::rungc
