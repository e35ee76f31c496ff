// The cycle counter of instrumented programs, read in program order.
#pragma once
#include <cstdint>
#include <ctime>

namespace rung::core {

inline uint64_t readTicks() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  uint32_t low;
  uint32_t high;
  asm volatile("lfence\n\trdtsc\n\tlfence" : "=a"(low), "=d"(high) : : "memory");
  return uint64_t{high} << 32 | low;
#elif defined(__aarch64__)
  uint64_t ticks;
  asm volatile("isb\n\tmrs %0, cntvct_el0" : "=r"(ticks) : : "memory");
  return ticks;
#else
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<uint64_t>(now.tv_sec) * 1'000'000'000u + static_cast<uint64_t>(now.tv_nsec);
#endif
}

} // namespace rung::core
