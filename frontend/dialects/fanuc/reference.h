// The sections of the reference page that follow the instructions.
#pragma once
#include "frontend/table/reference.h"

namespace rung::frontend::fanuc {

void addReference(frontend::ReferencePage& page);

} // namespace rung::frontend::fanuc
