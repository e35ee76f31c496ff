// The hand-made program of these tests, as an image.
#pragma once
#include "rung/runtime.hpp"
#include "tests/unit/rtlib/test_program.h"

namespace rung::test {

inline Image adopted(const TestProgram& program) { return Image::adopt(program.program); }

} // namespace rung::test
