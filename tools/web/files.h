// The files of app/, embedded by the build, which makes this function.
#pragma once
#include <span>

#include "rtlib/text/embedded.h"

namespace rung::web {

std::span<const text::EmbeddedFile> appFiles();

} // namespace rung::web
