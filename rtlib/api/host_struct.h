// Structs of the host (rung_instance_bind_struct): whole copies of those that its writer guards by counters, and which
// programs were compiled for them.
#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "rtlib/core/handover.h"
#include "rung/runtime.h"

namespace rung::api {

// One that is bound. It stays where it is: what is bound refers to its copy.
class HostStruct {
public:
  HostStruct(const rung_layout& layout, uint8_t* address);

  const rung_layout& layout() const { return layout_; }
  const uint8_t* address() const { return address_; }
  bool guarded() const { return layout_.counter_bytes != 0; }
  // Where the program's inputs are taken from: the last whole copy, or the struct itself.
  uint8_t* inputs() { return guarded() ? whole_.data() : address_; }
  // A new copy, where a whole one can be had.
  void take() noexcept;
  uint32_t inconsistent() const { return inconsistent_; } // slices

private:
  static std::vector<core::GuardedMemory::Range> inputRanges(const rung_layout& layout);

  rung_layout layout_;
  uint8_t* address_;
  std::vector<core::GuardedMemory::Range> ranges_; // of its members to the program
  std::vector<uint8_t> copy_, whole_;
  uint32_t inconsistent_ = 0;
};

// What is wrong with a layout; nullptr: nothing. Rows are not looked up in a program.
const char* problemOf(const rung_layout& layout, const void* address) noexcept;

// RUNG_REFUSED where the program was compiled for another layout of the struct.
int32_t checkLayout(const rung_program& program, const rung_layout& layout) noexcept;

class HostStructs {
public:
  HostStruct& add(std::unique_ptr<HostStruct> bound);
  void takeAll() noexcept {
    for (const std::unique_ptr<HostStruct>& bound : structs_)
      if (bound->guarded()) bound->take();
  }
  const HostStruct* at(const void* address) const noexcept;
  // For any thread.
  int32_t check(const rung_program& program) const noexcept;

private:
  mutable std::mutex mutex_; // held while the list grows or is looked at by other threads
  std::vector<std::unique_ptr<HostStruct>> structs_;
};

} // namespace rung::api
