// The cycle counter that instrumented programs measure with: what __builtin_readcyclecounter gives on this machine.
#pragma once
#include <cstdint>
#include <ctime>

namespace rung::rt {

inline uint64_t readTicks() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  return __builtin_ia32_rdtsc();
#elif defined(__aarch64__)
  uint64_t ticks;
  asm volatile("mrs %0, cntvct_el0" : "=r"(ticks));
  return ticks;
#else
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<uint64_t>(now.tv_sec) * 1'000'000'000u + static_cast<uint64_t>(now.tv_nsec);
#endif
}

} // namespace rung::rt
