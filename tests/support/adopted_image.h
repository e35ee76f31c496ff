// A program in memory as an image of the runtime.
#pragma once
#include "rung/runtime.hpp"

namespace rung::test {

// The program and its engine outlive the image and what is made of it.
inline Image adopted(const rung_program& program, void* engine = nullptr) {
  rung_image* image = nullptr;
  check(rung_image_adopt(&program, engine, nullptr, nullptr, &image));
  return Image(image);
}

} // namespace rung::test
