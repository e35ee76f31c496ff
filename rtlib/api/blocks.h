// Blocks of the host's memory that are bound to bytes of a space (rung_instance_bind_blocks), and their places in every
// program that the instance runs or may run.
#pragma once
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "rtlib/api/environment.h"
#include "rtlib/core/memory.h"
#include "rung/runtime.h"

namespace rung::api {

struct HostBlock {
  std::string name;
  uint8_t* address = nullptr;
  uint32_t bytes = 0;
  bool input = false;
};

// Whether a block can be bound in a program, or why not.
enum class BlockState : uint8_t {
  Good,
  Gone,        // the program does not have the name
  Constant,    // it has no memory
  WithinByte,  // it does not begin with a byte
  TooLong,     // longer than the rest of its space, or than a cell that the compiler placed
  Overwritten, // another place is copied over its input
};

// The place of a block's first byte in a program.
struct BlockPlace {
  BlockState state = BlockState::Gone;
  uint32_t space = RUNG_NONE;
  uint32_t byte = 0;
};
BlockPlace locateBlock(const Environment& environment, const rung_program& program, const HostBlock& block);

// The copies between all blocks and one program. Scan thread, except add; copying allocates nothing.
class BlockPlan {
public:
  // `copies` belongs to this program; its lists outlive the plan.
  BlockPlan(const rung_program& program, const core::NeededCopies& copies)
      : program_(&program), copies_(copies), reads_(program.task_count) {}

  void add(const Environment& environment, const HostBlock& block);

  // Copy input blocks: `latch` the bytes that a run of the task reads; `readRest` the bytes that no task of the
  // schedule reads but a host may inspect.
  void latch(uint8_t* memory, uint32_t task) const noexcept { copyIn(reads_[task], memory); }
  void readRest(uint8_t* memory) const noexcept { copyIn(rest_, memory); }
  void write(const uint8_t* memory) const noexcept;
  void clear() const noexcept;
  bool hasInputs() const noexcept { return hasInputs_; }
  // Whether a block contains bytes that process-image copies leave out.
  bool seesLeftOut() const noexcept { return seesLeftOut_; }

private:
  static constexpr uint32_t kNowhere = RUNG_NONE; // the offset of bytes that the program does not have
  // Bytes of a block that are adjacent in the program's memory.
  struct Piece {
    uint8_t* host;
    uint32_t offset; // in the memory block
    uint32_t bytes;
    bool expanded; // in the program's memory each bit has a byte
  };
  static void copyIn(const std::vector<Piece>& pieces, uint8_t* memory) noexcept;
  static void append(std::vector<Piece>& pieces, const Piece& byte);
  void addInput(const HostBlock& block, const BlockPlace& place);
  void addOutput(const HostBlock& block, const BlockPlace& place);
  Piece byteOf(const HostBlock& block, const BlockPlace& place, uint32_t i) const;
  bool reads(uint32_t task, const Piece& byte) const;

  const rung_program* program_;
  core::NeededCopies copies_;
  bool seesLeftOut_ = false;
  bool hasInputs_ = false;
  std::vector<std::vector<Piece>> reads_; // by task
  std::vector<Piece> rest_;
  std::vector<Piece> outputs_;
};

// All blocks of an instance, and every plan that contains them. Any thread, but not in real time.
class HostBlocks {
public:
  // Adds the blocks to every plan. The programs of the plans must not run at the same time.
  void add(const Environment& environment, const std::vector<HostBlock>& blocks);
  // From now on the plan contains all blocks.
  void join(const Environment& environment, BlockPlan& plan);
  void leave(BlockPlan& plan);

private:
  std::mutex mutex_;
  std::vector<HostBlock> blocks_;
  std::vector<BlockPlan*> plans_;
};

// Checks a block in the running program. Returns RUNG_OK, or an error with its sentence.
int32_t checkPlace(const rung_instance& instance, const HostBlock& block);
// Adds blocks whose places have been checked.
void addBlocks(rung_instance& instance, const std::vector<HostBlock>& given);

} // namespace rung::api
