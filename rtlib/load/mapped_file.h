// Where a library lies in the memory of the process: what its tables may point to.
#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

namespace rung::runtime {

class MappedFile {
public:
  // Of dlopen; empty where the system does not say where it lies.
  explicit MappedFile(void* library);
  // Of one span of memory, for tests.
  MappedFile(const void* begin, uint64_t bytes, bool isCode);

  bool holds(const void* address, uint64_t bytes) const noexcept { return segmentOf(address, bytes) != nullptr; }
  bool holdsCode(const void* address) const noexcept;
  // Ended by 0.
  bool holdsText(const char* text) const noexcept;

private:
  struct Segment {
    uintptr_t begin = 0;
    uintptr_t end = 0;
    bool isCode = false;
  };
  const Segment* segmentOf(const void* address, uint64_t bytes) const noexcept;
  std::vector<Segment> segments_;
};

} // namespace rung::runtime
