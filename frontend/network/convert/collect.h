// The files of a program, which has no errors, to its source model.
#pragma once
#include <vector>

#include "frontend/network/convert/source_model.h"
#include "frontend/network/read/reading.h"

namespace rung::network::convert {

// `networks`: everything that the reading gave to Context::onNetwork.
SourceProgram collect(Context& context, const Reading& reading, const std::vector<Network>& networks);

} // namespace rung::network::convert
