// The ports of the input and output units: forced bits and shorted outputs (man. l.3498-3609). Inputs are forced
// before the program, outputs after it; what the machine or the program itself put there comes back before the next
// cycle. Without forcing and errors a cycle only looks at half a kilobyte.
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/run/instance.h"

namespace rung::sim::technol {

class Ports {
public:
  // P1IN to P128IN, P0OUT to P95OUT (man. l.3341); units INOUT08.
  static constexpr uint32_t kInputs = 128, kOutputs = 96, kUnits = 32;

  // `config CAN[1].INOUT08[i].CONTROL n`: the control byte of a unit, of which IO_DIS_ERPIS counts here. False: another
  // key. `problem` says what is wrong with the value.
  bool configure(std::string_view key, std::string_view value, std::string& problem);
  // At a power-on: nothing is forced.
  void reset(const runtime::Instance& instance);
  // Where the ports are in the program that runs now.
  void locate(const runtime::Instance& instance);

  void beforeProgram(runtime::Instance& instance);
  void afterProgram(runtime::Instance& instance);
  // The value that comes may be equal to a forced one, so the ports it goes to get their own back first.
  void beforeWrite(runtime::Instance& instance, const runtime::Ref& place);

private:
  struct Port {
    uint8_t own = 0;    // what the machine or the program put there
    uint8_t forced = 0; // what has been there since
    bool active = false;
  };
  struct Family { // of cells that are numbered
    uint32_t space = RUNG_NONE, first = 0, stride = 0;
    // The number of the cell at this byte.
    std::optional<uint32_t> find(uint32_t inSpace, uint32_t byte, uint32_t count) const;
  };
  struct Span {
    uint32_t offset, size;
  };
  static Family familyOf(const runtime::Instance& instance, const char* first, const char* second);
  static uint8_t read(const runtime::Instance& instance, const Family& family, uint32_t number);
  static void write(runtime::Instance& instance, const Family& family, uint32_t number, uint8_t value);
  static void restore(runtime::Instance& instance, const Family& family, uint32_t number, Port& port);
  static void force(runtime::Instance& instance, const Family& family, uint32_t number, Port& port, uint8_t high,
                    uint8_t low);
  void findSwitches(const runtime::Instance& instance);
  bool anySwitch(const runtime::Instance& instance) const;
  uint8_t shorted(runtime::Instance& instance, uint32_t output) const;

  Family inputs_, outputs_, lowIn_, highIn_, lowOut_, highOut_, shorts_;
  std::array<Port, kInputs> in_;
  std::array<Port, kOutputs> out_;
  std::array<uint8_t, kUnits> control_{};
  std::vector<Span> switches_; // of the block: forcing and errors
  bool active_ = false;
};

} // namespace rung::sim::technol
