// Coverage of a program in the terms of its drawing.
#pragma once
#include "tools/coverage/report.h"
#include "tools/view/overlay.h"

namespace rung::rungc {

view::Overlay overlayOf(const coverage::Program& program);

} // namespace rung::rungc
