// Files that the build embeds for rungc new.
#pragma once
#include "rtlib/text/embedded.h"

namespace rung::rungc {

// The files of templates/, by DIALECT/NAME; a file without a dialect is part of all projects.
std::span<const text::EmbeddedFile> projectTemplates();

} // namespace rung::rungc
