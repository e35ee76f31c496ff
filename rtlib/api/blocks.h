// Blocks of the host's memory for bytes of a space (rung_instance_bind_blocks), and which bytes of them lie
// where in each program that the instance has or may get.
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

// What is wrong with a program for a block.
enum class BlockState : uint8_t {
  Good,
  Gone,        // the program does not have the name
  Constant,    // it has no memory
  WithinByte,  // it does not begin with a byte
  TooLong,     // longer than the rest of its space, or than a cell that the compiler placed
  Overwritten, // another place is copied over its input
};

// The first byte of a block.
struct BlockPlace {
  BlockState state = BlockState::Gone;
  uint32_t space = RUNG_NONE;
  uint32_t byte = 0;
};
BlockPlace locateBlock(const Environment& environment, const rung_program& program, const HostBlock& block);

// The blocks in one program. Copying allocates nothing.
class BlockPlan {
public:
  // `copies`: of this program; their lists outlive the plan.
  BlockPlan(const rung_program& program, const core::NeededCopies& copies)
      : program_(&program), copies_(copies), reads_(program.task_count) {}

  void add(const Environment& environment, const HostBlock& block);

  // What a run of the task reads; and what no task of the schedule reads, which others may look at.
  void latch(uint8_t* memory, uint32_t task) const noexcept { copyIn(reads_[task], memory); }
  void readRest(uint8_t* memory) const noexcept { copyIn(rest_, memory); }
  void write(const uint8_t* memory) const noexcept;
  void clear() const noexcept;
  // One of the blocks has bytes that the copies leave out.
  bool seesLeftOut() const noexcept { return seesLeftOut_; }

private:
  static constexpr uint32_t kNowhere = RUNG_NONE; // as an offset: the program does not have the bytes
  // Bytes of a block that lie together in the program's memory.
  struct Piece {
    uint8_t* host;
    uint32_t offset; // in the memory block
    uint32_t bytes;
    bool expanded; // there: a byte a bit
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
  std::vector<std::vector<Piece>> reads_; // by task
  std::vector<Piece> rest_;
  std::vector<Piece> outputs_;
};

// The blocks, and every plan that has them. For any thread, but not in real time.
class HostBlocks {
public:
  // Adds to every plan. The instance of the plans' programs does not run meanwhile.
  void add(const Environment& environment, const std::vector<HostBlock>& blocks);
  // From now on the plan has all blocks.
  void join(const Environment& environment, BlockPlan& plan);
  void leave(BlockPlan& plan);

private:
  std::mutex mutex_;
  std::vector<HostBlock> blocks_;
  std::vector<BlockPlan*> plans_;
};

// A block in the program that runs: RUNG_OK, or what is wrong.
int32_t checkPlace(const rung_instance& instance, const HostBlock& block);
// Blocks whose places are good.
void addBlocks(rung_instance& instance, const std::vector<HostBlock>& given);

} // namespace rung::api
