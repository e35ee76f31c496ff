// The files of a program, which has no errors, to its source model.
#pragma once
#include <vector>

#include "frontend/dialects/gsk/convert/source_model.h"
#include "frontend/dialects/gsk/read/reading.h"

namespace rung::gsk::convert {

// `networks`: everything that the reading gave to Context::onNetwork.
SourceProgram collect(Context& context, const Reading& reading, const std::vector<Network>& networks);

} // namespace rung::gsk::convert
