// The cells that a user forces to a value while a program runs: the bits of its memory that they occupy, and whether
// the program's own code would write these. Created and inspected outside real time; Instance::force activates it.
//
// A cell that process-image copies connect with others (an input and what a task reads of it, an output and its image)
// is forced together with all of these.
#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rtlib/core/runner.h"
#include "rtlib/load/ref.h"
#include "rtlib/load/written_bits.h"
#include "rung/program.h"

namespace rung::runtime {

struct ForcedCell {
  Ref ref;                    // a Bit, Int or Real; for an array its first element
  uint64_t bits = 0;          // the value; for an integer its lowest bits
  std::string_view name = {}; // for messages
};

class Forcing {
public:
  // `program` runs with its own code, whose chunks find `engine` in their context. It outlives this object.
  Forcing(const rung_program& program, void* engine, std::span<const ForcedCell> cells);

  // The same for bits of the block that another such object has held (`held`).
  Forcing(const rung_program& program, void* engine, std::span<const core::ForcedBits> bits);

  // Why the cells cannot be forced together; "" if they can.
  const std::string& problem() const { return problem_; }
  // The forced bytes, sorted by space and byte.
  const std::vector<rung_forced_byte>& bytes() const { return bytes_; }
  // Whether the program's own code may write some of the cells, so that other code has to replace it (setCode).
  bool needsCode() const { return needsCode_; }
  // Code for all chunks that leaves the forced bits as they are.
  void setCode(const core::Code& code) { code_ = code; }

  const core::Code& code() const { return code_; }
  std::span<const core::ForcedBits> held() const { return held_; }

private:
  struct Bits {
    uint8_t mask = 0;
    uint8_t value = 0;
  };
  void finish();
  void add(const ForcedCell& cell);
  void addByte(std::string_view name, uint32_t space, uint32_t byte, uint8_t mask, uint8_t value);
  void hold(std::string_view name, uint32_t offset, Bits bit);
  void nameBytes();
  bool isWritten(uint32_t offset, uint8_t mask) const;

  const rung_program& program_;
  std::string problem_;
  std::map<uint32_t, Bits> bits_;                               // by offset in the block
  std::map<std::pair<uint32_t, uint8_t>, std::string> holders_; // by offset and mask: name of the bit's force
  std::vector<core::ForcedBits> held_;
  std::vector<rung_forced_byte> bytes_;
  bool needsCode_ = false;
  core::Code code_;
};

} // namespace rung::runtime
