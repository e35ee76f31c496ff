// How a serial port is set: the attributes of ComChannel (TECHNOL manual 23.3.1, l.21000-21040).
#pragma once
#include <cstdint>
#include <string>
#include <string_view>

namespace rung::io::com {

inline constexpr uint32_t kMostPorts = 16; // numbers 0 to 15

enum class Parity : uint8_t { None, Odd, Even, Mark, Space };

struct Settings {
  bool isActive = false;
  uint32_t physical = 0; // PhysicalComNo, 1 is the first; 0: not given
  uint32_t speed = 115200;
  uint32_t dataBits = 8;
  uint32_t stopBits = 2;
  Parity parity = Parity::None;

  // An attribute and its value, in any case. "" or what is wrong.
  std::string set(std::string_view attribute, std::string_view value);
  // Start, data, parity and stop bits.
  uint32_t bitsOfByte() const { return 1 + dataBits + (parity == Parity::None ? 0 : 1) + stopBits; }
  uint8_t mask() const { return dataBits == 7 ? 0x7F : 0xFF; }
};

// "COM[1].ComSpeed": the number of the port, and its attribute in capitals.
struct PortKey {
  uint32_t number = 0;
  std::string attribute;
};
// Whether the key is one of a serial port, right or wrong.
bool isPortKey(std::string_view key);
// "" or what is wrong with it.
std::string readPortKey(std::string_view key, PortKey& port);

} // namespace rung::io::com
