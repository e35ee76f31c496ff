// The memory of the dialect in terms of the IR: synchronised memory M, time-slice memory TS, and the mask @W of the
// bits of the NC area that normal instructions wrote since the last transfer (man. §3.3, l.542-550).
//
// A fixed operand becomes a fixed place and costs only its load or store. A computed operand has a condition `valid`;
// out of its range it reads 0 and writes nothing, so a store needs no separate condition.
#pragma once
#include <optional>

#include "frontend/dialects/nct/config.h"
#include "frontend/dialects/nct/read/symbols.h"
#include "ir/core/builder.h"

namespace rung::frontend::nct {

// The flags are the bits of word 0000 in the order of the manual's chapter 5 (l.725-777).
enum Flag : uint8_t { kFlagEr, kFlagUf, kFlagOf, kFlagCy, kFlagGt, kFlagEq, kFlagLt };

struct MemorySpaces {
  ir::SpaceId m;
  ir::SpaceId ts;
  ir::SpaceId written; // @W
  ir::SpaceId scratch; // @S: words whose contents are not kept between two instructions; made on first use
};

// The words of the NC area whose mask instructions may set: [first, end).
struct WrittenRange {
  uint32_t first = UINT32_MAX;
  uint32_t end = 0;
  void add(uint32_t begin, uint32_t beyond);
};

// The range of an operand at run time.
enum class AccessBound : uint8_t {
  Read,  // 0000 to 9999
  Write, // 0001 to 9999: FLAGS is reserved for instructions (l.723); a write to the reserved word 0001 is lost
  User,  // PLCNVRAM to 9999: timers and counters (l.1335, l.1463)
};

// The evaluated place of an operand.
struct Place {
  ir::SpaceId space;
  bool fixed = true;
  uint32_t word = 0;
  uint32_t bit = 0;
  ir::Window window;  // computed: the words that it may reach
  ir::ValueId index;  // computed: i32, relative to the window
  ir::ValueId wordNo; // computed: i32, the word's number
  ir::ValueId bitNo;  // computed: i32
  ir::ValueId valid;  // computed: bit; invalid id: always
};

// A run of words from one place to another.
struct WordRange {
  ir::Window window;
  ir::ValueId first;  // in the window; invalid id: 0
  ir::ValueId length; // i32; undefined unless both places are valid and in order
  uint32_t mostWords = 0;
};

class Memory {
public:
  Memory(ir::RungBuilder& builder, const Config& config, const MemorySpaces& spaces, WrittenRange& written)
      : b_(builder), config_(config), spaces_(spaces), written_(written) {}

  Place word(const Address& address, AccessBound bound);
  // Where a word is whose address is not computed.
  std::optional<ir::Place> fixedWord(const Address& address) const;
  Place bit(const Address& address, AccessBound bound);
  // Two words; a computed index must be even (l.509).
  Place twoWords(const Address& address, AccessBound bound);

  ir::ValueId loadWord(const Place& place); // i32
  void storeWord(const Place& place, ir::ValueId value);
  ir::ValueId loadBit(const Place& place);
  void storeBit(const Place& place, ir::ValueId value);
  // If `cond` is 1, sets or resets the bit.
  void forceBit(const Place& place, ir::ValueId cond, bool value);
  // Two words as i64 or f64, the low word first (l.715).
  ir::ValueId loadDouble(const Place& place, ir::Type type);
  void storeDouble(const Place& place, ir::ValueId value);

  // A constant or a word; the `valid` of its place is combined into `valid`.
  ir::ValueId integer(const Operand& operand, ir::ValueId& valid);
  // The same for doubles: f64.
  ir::ValueId real(const Operand& operand, ir::ValueId& valid);

  // For instructions that iterate over words; `i` counts from the first one and must be inside.
  WordRange range(const Place& first, const Place& last);
  ir::ValueId loadIn(const WordRange& range, ir::ValueId i);
  void storeIn(const WordRange& range, ir::ValueId i, ir::ValueId value);
  ir::ValueId loadScratch(ir::ValueId index);
  void storeScratch(ir::ValueId index, ir::ValueId value);

  // Flags are written bit by bit: if a program uses FLAGS in no other way, each flag is a separate byte (ir/shape).
  void setFlag(Flag flag, ir::ValueId value); // invalid id: 0
  void setErrorFlag(bool value) { setFlag(kFlagEr, b_.bit(value)); }
  void raiseErrorFlag(ir::ValueId cond); // FL_ER := FL_ER or cond

  // a AND b, with invalid ids as 1.
  ir::ValueId both(ir::ValueId a, ir::ValueId b);
  // (word number, bit number) of the place as one i32: shows whether an index has changed (1.5).
  ir::ValueId bitAddress(const Place& place);
  const Config& config() const { return config_; }

private:
  Place place(const Address& address, AccessBound bound, uint32_t words);
  void compute(Place& place, const Address& address, AccessBound bound, uint32_t words);
  ir::ValueId loadRegister(uint32_t word);
  ir::ValueId upperWord(ir::ValueId value); // of a double
  bool dropped(const Place& place) const;
  bool masked(const Place& place) const;
  ir::Window maskWindow(const Place& place);
  ir::Place placeOf(Flag flag) const;

  ir::RungBuilder& b_;
  const Config& config_;
  const MemorySpaces& spaces_;
  WrittenRange& written_;
};

} // namespace rung::frontend::nct
