// The floating-point settings that programs are compiled for: round to nearest, subnormals kept, no traps. Each thread
// has its own, and a host built with -ffast-math starts with different ones.
#pragma once
#include <cstdint>

namespace rung::core {

#if defined(__x86_64__) || defined(__SSE2__)
inline constexpr uint32_t kDefaultFloatControl = 0x1F80;
inline constexpr uint32_t kFloatStatus = 0x3F; // exception flags, not settings
inline uint32_t floatControl() noexcept { return __builtin_ia32_stmxcsr(); }
inline void setFloatControl(uint32_t control) noexcept { __builtin_ia32_ldmxcsr(control); }
#elif defined(__aarch64__)
inline constexpr uint32_t kDefaultFloatControl = 0;
inline constexpr uint32_t kFloatStatus = 0;
inline uint32_t floatControl() noexcept {
  uint64_t control;
  asm volatile("mrs %0, fpcr" : "=r"(control));
  return static_cast<uint32_t>(control);
}
inline void setFloatControl(uint32_t control) noexcept { asm volatile("msr fpcr, %0" : : "r"(uint64_t{control})); }
#elif defined(__arm__) && defined(__ARM_FP)
inline constexpr uint32_t kDefaultFloatControl = 0;
inline constexpr uint32_t kFloatStatus = 0xF800009F; // condition and exception flags, not settings
inline uint32_t floatControl() noexcept {
  uint32_t control;
  asm volatile("vmrs %0, fpscr" : "=r"(control));
  return control;
}
inline void setFloatControl(uint32_t control) noexcept { asm volatile("vmsr fpscr, %0" : : "r"(control)); }
#elif defined(__riscv_flen)
inline constexpr uint32_t kDefaultFloatControl = 0;
inline constexpr uint32_t kFloatStatus = 0;
inline uint32_t floatControl() noexcept {
  uint32_t control;
  asm volatile("frrm %0" : "=r"(control));
  return control;
}
inline void setFloatControl(uint32_t control) noexcept { asm volatile("fsrm %0" : : "r"(control)); }
#else
#error "how are the floating-point settings of this processor read?"
#endif

// Sets the default settings for the calling thread while it exists, and restores the thread's own afterwards. A nested
// object does nothing: `inForce`, initially false, is true while an outer one exists.
class FloatEnvironment {
public:
  explicit FloatEnvironment(bool& inForce) noexcept : inForce_(inForce), outermost_(!inForce) {
    if (!outermost_) return;
    inForce_ = true;
    found_ = floatControl();
    if (isOther()) [[unlikely]]
      setFloatControl(kDefaultFloatControl);
  }
  ~FloatEnvironment() {
    if (!outermost_) return;
    inForce_ = false;
    if (isOther()) [[unlikely]]
      setFloatControl(found_);
  }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

private:
  bool isOther() const noexcept { return (found_ & ~kFloatStatus) != kDefaultFloatControl; }

  bool& inForce_;
  bool outermost_;
  uint32_t found_ = 0;
};

} // namespace rung::core
