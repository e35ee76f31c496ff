// Message texts that a control stores in separate files, which the map names (File::messageFiles).
#pragma once
#include <string>
#include <vector>

#include "machine/host/mapping_file.h"
#include "rung/runtime.h"

namespace rung::host {

// Passes the contents of the files to the instance, before its first power-on. Every error is one entry of `errors`:
// with its position in the map if the file is missing or the dialect accepts none, otherwise with its position in the
// file.
void defineMessages(const File& map, rung_instance* instance, std::vector<std::string>& errors,
                    const ReadFile& read = readFromDisk);

} // namespace rung::host
