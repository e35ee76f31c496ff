// The hand-made program of these tests, as an image.
#pragma once
#include "tests/support/adopted_image.h"
#include "tests/unit/rtlib/test_program.h"

namespace rung::test {

inline Image adopted(const TestProgram& program) { return adopted(program.program); }

} // namespace rung::test
