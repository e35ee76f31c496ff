// A program that instances run, shared by the image's handle, instances and replacements.
#pragma once
#include <atomic>
#include <memory>
#include <vector>

#include "rtlib/host/footprint.h"
#include "rtlib/host/so_engine.h"
#include "rtlib/runtime/handles.h"
#include "rung/runtime.h"

namespace rung::runtime {

struct Image {
  explicit Image(std::unique_ptr<host::SoEngine> file);
  Image(const rung_program& inMemory, void* context, void (*releases)(void*), void* ownedBy);
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  ~Image();

  std::unique_ptr<host::SoEngine> loaded; // null: the program was in memory
  const rung_program& program;
  void* engine = nullptr; // rung_ctx::engine
  void (*release)(void* owner) = nullptr;
  void* owner = nullptr;
  std::vector<uint32_t> symbols; // the author's, in the program's table
  host::Footprint footprint;
  // Entered once, by any thread; null: no compiler serves the image.
  mutable std::atomic<const rung_code_maker*> maker{nullptr};
};

} // namespace rung::runtime

struct rung_image {
  uint32_t mark = rung::runtime::kImageMark;
  std::shared_ptr<const rung::runtime::Image> image;
};
