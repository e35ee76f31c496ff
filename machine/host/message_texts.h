// The texts of messages that a control keeps in a file of its own, which the map names (File::messageFiles).
#pragma once
#include <string>
#include <vector>

#include "machine/host/mapping_file.h"
#include "rung/runtime.h"

namespace rung::host {

// Gives the instance what the files say, before its first power-on. Every mistake is one entry of `errors`: with its
// place in the map if the file is missing or the dialect takes none, else with its place in the file.
void defineMessages(const File& map, rung_instance* instance, std::vector<std::string>& errors,
                    const ReadFile& read = readFromDisk);

} // namespace rung::host
