// A program that instances run, shared by the image's handle, instances and replacements.
#pragma once
#include <atomic>
#include <memory>
#include <vector>

#include "rtlib/api/handles.h"
#include "rtlib/load/so_engine.h"
#include "rtlib/run/footprint.h"
#include "rung/runtime.h"

namespace rung::api {

struct Image {
  explicit Image(std::unique_ptr<runtime::SoEngine> file);
  Image(const rung_program& inMemory, void* context, void (*releases)(void*), void* ownedBy);
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  ~Image();

  std::unique_ptr<runtime::SoEngine> loaded; // null: the program was in memory
  const rung_program& program;
  void* engine = nullptr; // rung_ctx::engine
  void (*release)(void* owner) = nullptr;
  void* owner = nullptr;
  std::vector<uint32_t> symbols; // the author's, in the program's table
  runtime::Footprint footprint;
  // Entered once, by any thread; null: no compiler serves the image.
  mutable std::atomic<const rung_code_maker*> maker{nullptr};
};

} // namespace rung::api

struct rung_image {
  uint32_t mark = rung::api::kImageMark;
  std::shared_ptr<const rung::api::Image> image;
};
