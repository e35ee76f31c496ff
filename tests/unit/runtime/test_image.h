// The hand-made program of these tests, as an image.
#pragma once
#include "rung/runtime.hpp"
#include "tests/unit/rtlib/test_program.h"

namespace rung::test {

inline Image adopted(const TestProgram& program) {
  rung_image* image = nullptr;
  check(rung_image_adopt(&program.program, nullptr, nullptr, nullptr, &image));
  return Image(image);
}

} // namespace rung::test
