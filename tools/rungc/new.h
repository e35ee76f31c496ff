// What the build makes for rungc new.
#pragma once
#include "rtlib/text/embedded.h"

namespace rung::rungc {

// The files of templates/: DIALECT/NAME; without a dialect one is part of all projects.
std::span<const text::EmbeddedFile> projectTemplates();

} // namespace rung::rungc
