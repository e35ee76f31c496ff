// One connection as it is served: from where, to where, how the value changes on the way. Made before the program runs;
// copying allocates nothing and looks nothing up.
#pragma once
#include <limits>

#include "rtlib/nc/technol/exchange.h"
#include "rtlib/run/instance.h"
#include "sim/technol/module_cells.h"

namespace rung::sim::technol {

// A place that a connection begins or ends at: a bit, a number or a text.
struct Pin {
  enum class Kind : uint8_t {
    Memory,  // the number or bit at `located`, which is `place`
    Text,    // at `place`
    Cell,    // of a module
    CellBit, // a bit of a module's cell
  };
  Kind kind = Kind::Memory;
  nc::ExchangeType type = nc::ExchangeType::Bit;
  uint8_t bit = 0;   // of the cell
  uint32_t cell = 0; // its number
  core::Place located;
  runtime::Ref place;
};
inline bool isOfModule(const Pin& pin) { return pin.kind == Pin::Kind::Cell || pin.kind == Pin::Kind::CellBit; }
inline bool isMemoryBit(const Pin& pin) { return pin.kind == Pin::Kind::Memory && pin.type == nc::ExchangeType::Bit; }
Pin pinAt(const rung_program& program, const runtime::Ref& place, nc::ExchangeType type);

// (min(max(x, least), most) + before) * scale + after, then held between low and high.
struct Stage {
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  double least = -kInfinity, most = kInfinity;
  double before = 0, scale = 1, after = 0;
  double low = -kInfinity, high = kInfinity;
  bool operator==(const Stage&) const = default;
};

struct Wire {
  static constexpr size_t kStages = 3;
  Pin from, to;
  bool invert = false;
  bool joins = false;    // ORed to what another wire has put there
  bool isShared = false; // its end is one that others join or have set
  bool isBit = false;    // from a bit of the memory to another: most are
  uint8_t stageCount = 0;
  Stage stages[kStages];
  nc::ExchangePeriod period = nc::ExchangePeriod::Slow;
  uint64_t target = kNoTarget; // the element of a DEF_IN that it ends in
  bool whole = true;           // and not in a bit of it

  static constexpr uint64_t kNoTarget = UINT64_MAX;
  static uint64_t targetOf(uint32_t space, uint32_t byte) { return uint64_t{space} << 32 | byte; }
};

class WireMemory {
public:
  WireMemory(runtime::Instance& instance, ModuleCells& cells) : memory_(instance.memory()), cells_(&cells) {}
  void copy(const Wire& wire) const;
  // The value that would be copied, in the bits of the wire's end; not of texts.
  uint64_t valueOf(const Wire& wire) const;

private:
  uint64_t read(const Pin& pin) const;
  void write(const Pin& pin, uint64_t bits) const;
  void copyText(const Wire& wire) const;

  core::Memory memory_;
  ModuleCells* cells_;
};

} // namespace rung::sim::technol
