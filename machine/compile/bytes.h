// Numbers and texts in what a compiler process is given.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace rung::compile {

// The low byte first.
inline void putNumber(std::string& out, uint64_t number, unsigned bytes) {
  for (unsigned i = 0; i < bytes; ++i) out += static_cast<char>(number >> i * 8 & 0xFF);
}

// The bytes that are left, and whether all were there that were taken.
class ByteReader {
public:
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}
  bool atEnd() const { return rest_.empty(); }
  bool good() const { return good_; }
  std::string_view rest() const { return rest_; }
  std::string_view take(size_t count) {
    good_ = good_ && count <= rest_.size();
    const std::string_view taken = rest_.substr(0, good_ ? count : 0);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  uint64_t takeNumber(unsigned bytes) {
    uint64_t number = 0;
    unsigned shift = 0;
    for (const char byte : take(bytes)) {
      number |= uint64_t{static_cast<uint8_t>(byte)} << shift;
      shift += 8;
    }
    return number;
  }

private:
  std::string_view rest_;
  bool good_ = true;
};

} // namespace rung::compile
