// Structs of the host (rung_instance_bind_struct): consistent copies of structs whose writer guards them with counters,
// and the check that a program was compiled for their layout.
#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "rtlib/core/handover.h"
#include "rung/runtime.h"

namespace rung::api {

// A bound struct. It is not moved, because the bound variables and blocks refer to its copy.
class HostStruct {
public:
  HostStruct(const rung_layout& layout, uint8_t* address);

  const rung_layout& layout() const { return layout_; }
  const uint8_t* address() const { return address_; }
  bool guarded() const { return layout_.counter_bytes != 0; }
  // The source of the program's inputs: the last consistent copy, or the struct itself if it has no counters.
  uint8_t* inputs() { return guarded() ? whole_.data() : address_; }
  // Scan thread: takes a new copy. If the struct changes during every attempt, the last consistent copy stays.
  void take() noexcept;
  uint32_t inconsistent() const { return inconsistent_; } // slices without a consistent copy

private:
  static std::vector<core::GuardedMemory::Range> inputRanges(const rung_layout& layout);

  rung_layout layout_;
  uint8_t* address_;
  std::vector<core::GuardedMemory::Range> ranges_; // of the members that the program reads
  std::vector<uint8_t> copy_, whole_;
  uint32_t inconsistent_ = 0;
};

// The error in a layout, or null. Members are not looked up in a program.
const char* problemOf(const rung_layout& layout, const void* address) noexcept;

// RUNG_OK, or RUNG_REFUSED if the program was compiled for another layout of the struct.
int32_t checkLayout(const rung_program& program, const rung_layout& layout) noexcept;

class HostStructs {
public:
  HostStruct& add(std::unique_ptr<HostStruct> bound);
  void takeAll() noexcept {
    for (const std::unique_ptr<HostStruct>& bound : structs_)
      if (bound->guarded()) bound->take();
  }
  const HostStruct* at(const void* address) const noexcept;
  // Any thread.
  int32_t check(const rung_program& program) const noexcept;

private:
  mutable std::mutex mutex_; // held while the list grows or another thread reads it
  std::vector<std::unique_ptr<HostStruct>> structs_;
};

} // namespace rung::api
