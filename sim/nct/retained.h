// The non-volatile state of the simulated NC: each topic names its fields once, in `retain`, and a Retained measures,
// saves or restores them. The image has a fixed size, so that saving allocates nothing.
#pragma once
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace rung::sim::nct {

class Retained {
public:
  enum class Mode : uint8_t { Measure, Save, Restore };

  static Retained measure() { return Retained(Mode::Measure, {}); }
  static Retained save(std::span<uint8_t> image) { return Retained(Mode::Save, image); }
  // Does not write to `image`.
  static Retained restore(std::span<const uint8_t> image) {
    return Retained(Mode::Restore, {const_cast<uint8_t*>(image.data()), image.size()});
  }

  bool restoring() const { return mode_ == Mode::Restore; }
  uint32_t size() const { return at_; }

  template <class T>
  void value(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(&value, sizeof value);
  }
  // The elements of a table whose size is configured.
  template <class T>
  void values(std::span<T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes(values.data(), values.size_bytes());
  }

private:
  Retained(Mode mode, std::span<uint8_t> image) : mode_(mode), image_(image) {}

  void bytes(void* data, size_t size) {
    if (mode_ != Mode::Measure && at_ + size <= image_.size() && size != 0) {
      if (mode_ == Mode::Save)
        std::memcpy(image_.data() + at_, data, size);
      else
        std::memcpy(data, image_.data() + at_, size);
    }
    at_ += static_cast<uint32_t>(size);
  }

  Mode mode_;
  std::span<uint8_t> image_;
  uint32_t at_ = 0;
};

} // namespace rung::sim::nct
