// Reads the table [devices] of a mapping file.
#pragma once
#include "tools/mapping/reading.h"

namespace rung::mapping {

// False: the node is not a table.
bool readDevices(Reading& reading, const toml::node& node, File& map);

} // namespace rung::mapping
