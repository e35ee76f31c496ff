// Reads the table [devices] of a mapping file.
#pragma once
#include "machine/host/mapping_reading.h"

namespace rung::host {

// False: the node is not a table.
bool readDevices(Reading& reading, const toml::node& node, File& map);

} // namespace rung::host
