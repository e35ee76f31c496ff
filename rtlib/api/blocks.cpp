// Maps blocks of the host to pieces of the memory block, and copies them (see blocks.h).
#include "rtlib/api/blocks.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "rtlib/api/error.h"
#include "rtlib/api/values.h"
#include "rtlib/core/bits.h"
#include "rtlib/run/loaded_program.h"

namespace rung::api {
namespace {

// Whether the schedule runs the task, and not only the control.
bool isScheduled(const rung_program& program, uint32_t task) {
  const auto runs = [&](const rung_step& step) { return step.task == task; };
  return std::ranges::any_of(std::span(program.scan, program.scan_count), runs) ||
         std::ranges::any_of(std::span(program.fast, program.fast_count), runs) ||
         std::ranges::any_of(std::span(program.slices, program.slice_count), runs);
}

} // namespace

BlockPlace locateBlock(const Environment& environment, const rung_program& program, const HostBlock& block) {
  const std::optional<runtime::Ref> ref = environment.writePlace(program, block.name); // as the machine sees it
  if (!ref) return {};
  const auto wrong = [](BlockState state) { return BlockPlace{.state = state}; };
  if (ref->kind == runtime::RefKind::Constant) return wrong(BlockState::Constant);
  if (ref->kind == runtime::RefKind::Bit && ref->bit != 0) return wrong(BlockState::WithinByte);
  const rung_space& space = program.spaces[ref->space];
  const bool allocated = (space.flags & RUNG_SPACE_ALLOCATED) != 0;
  const uint64_t bits = uint64_t{ref->width} * ref->count; // other cells may follow
  if (allocated && bits % 8 != 0) return wrong(BlockState::WithinByte);
  const uint64_t room = allocated ? bits / 8 : uint64_t{space.byte_count} - ref->byte;
  if (block.bytes > room) return wrong(BlockState::TooLong);
  const runtime::Overwritten overwritten(program);
  for (uint32_t i = 0; block.input && i < block.bytes; ++i)
    if (overwritten.source(runtime::intRef(ref->space, ref->byte + i, 8))) return wrong(BlockState::Overwritten);
  return {.state = BlockState::Good, .space = ref->space, .byte = ref->byte};
}

// ---- one program -------------------------------------------------------------------------------------------------

void BlockPlan::add(const Environment& environment, const HostBlock& block) {
  const BlockPlace place = locateBlock(environment, *program_, block);
  if (!block.input)
    addOutput(block, place);
  else if (place.state == BlockState::Good)
    addInput(block, place);
}

BlockPlan::Piece BlockPlan::byteOf(const HostBlock& block, const BlockPlace& place, uint32_t i) const {
  const rung_range& range = *core::Memory(*program_, nullptr).rangeOf(place.space, place.byte + i);
  const bool expanded = range.repr == RUNG_REPR_BYTE_PER_BIT;
  const uint32_t into = place.byte + i - range.first_byte;
  return {block.address + i, range.offset + into * (expanded ? 8 : 1), 1, expanded};
}

bool BlockPlan::reads(uint32_t task, const Piece& byte) const {
  const rung_task& t = program_->tasks[task];
  const uint32_t end = byte.offset + (byte.expanded ? 8 : 1);
  const std::span spans(program_->reads + t.read_first, t.read_count);
  const auto after = std::ranges::lower_bound(spans, end, {}, &rung_span::offset);
  return after != spans.begin() && std::prev(after)->offset + std::prev(after)->size > byte.offset;
}

void BlockPlan::append(std::vector<Piece>& pieces, const Piece& byte) {
  if (!pieces.empty()) {
    Piece& last = pieces.back();
    if (last.expanded == byte.expanded && last.host + last.bytes == byte.host &&
        last.offset + last.bytes * (last.expanded ? 8 : 1) == byte.offset) {
      ++last.bytes;
      return;
    }
  }
  pieces.push_back(byte);
}

void BlockPlan::addInput(const HostBlock& block, const BlockPlace& place) {
  hasInputs_ = true;
  for (uint32_t i = 0; i < block.bytes; ++i) {
    const Piece byte = byteOf(block, place, i);
    bool any = false;
    for (uint32_t task = 0; task < reads_.size(); ++task) {
      if (!reads(task, byte)) continue;
      append(reads_[task], byte);
      any = any || isScheduled(*program_, task);
    }
    if (!any) append(rest_, byte);
  }
}

void BlockPlan::addOutput(const HostBlock& block, const BlockPlace& place) {
  if (place.state != BlockState::Good) return outputs_.push_back({block.address, kNowhere, block.bytes, false});
  for (uint32_t i = 0; i < block.bytes; ++i) {
    const Piece byte = byteOf(block, place, i);
    seesLeftOut_ = seesLeftOut_ || copies_.leavesOut(byte.offset, byte.expanded ? 8 : 1);
    append(outputs_, byte);
  }
}

void BlockPlan::copyIn(const std::vector<Piece>& pieces, uint8_t* memory) noexcept {
  for (const Piece& piece : pieces) {
    uint8_t* to = memory + piece.offset;
    if (piece.expanded)
      for (uint32_t i = 0; i < piece.bytes; ++i) core::unpackBits(piece.host[i], to + size_t{8} * i);
    else
      std::memcpy(to, piece.host, piece.bytes);
  }
}

void BlockPlan::write(const uint8_t* memory) const noexcept {
  for (const Piece& piece : outputs_) {
    if (piece.offset == kNowhere) {
      std::memset(piece.host, 0, piece.bytes);
      continue;
    }
    const uint8_t* from = memory + piece.offset;
    if (piece.expanded)
      for (uint32_t i = 0; i < piece.bytes; ++i) piece.host[i] = core::packBits(from + size_t{8} * i);
    else
      std::memcpy(piece.host, from, piece.bytes);
  }
}

void BlockPlan::clear() const noexcept {
  for (const Piece& piece : outputs_) std::memset(piece.host, 0, piece.bytes);
}

// ---- all programs ------------------------------------------------------------------------------------------------

void HostBlocks::add(const Environment& environment, const std::vector<HostBlock>& blocks) {
  const std::lock_guard lock(mutex_);
  for (const HostBlock& block : blocks) {
    for (BlockPlan* plan : plans_) plan->add(environment, block);
    blocks_.push_back(block);
  }
}

void HostBlocks::join(const Environment& environment, BlockPlan& plan) {
  const std::lock_guard lock(mutex_);
  for (const HostBlock& block : blocks_) plan.add(environment, block);
  plans_.push_back(&plan);
}

void HostBlocks::leave(BlockPlan& plan) {
  const std::lock_guard lock(mutex_);
  std::erase(plans_, &plan);
}

namespace {

int32_t checkBlock(const rung_block& b, uint32_t number) noexcept {
  if (b.name == nullptr || b.address == nullptr || b.bytes == 0)
    return fail(RUNG_BAD_ARGUMENT, "block %u has no name, no address or no bytes", number);
  if (b.direction > RUNG_FROM_PROGRAM)
    return fail(RUNG_BAD_ARGUMENT, "block %u, %s: %u is not an enum rung_direction", number, b.name, b.direction);
  return RUNG_OK;
}

int32_t failBlock(const rung_instance& instance, const HostBlock& block, BlockState state) {
  const char* name = block.name.c_str();
  switch (state) {
  case BlockState::Good: break;
  case BlockState::Gone: return failName(instance.running.program(), name);
  case BlockState::Constant: return fail(RUNG_WRONG_TYPE, "%s is a constant: it has no memory", name);
  case BlockState::WithinByte:
    return fail(RUNG_BAD_ARGUMENT, "%s does not begin with a byte: a block is made of whole bytes", name);
  case BlockState::TooLong:
    return fail(RUNG_BAD_ARGUMENT, "there are not %u bytes from %s on for a block", block.bytes, name);
  case BlockState::Overwritten:
    return fail(RUNG_OVERWRITTEN, "another place is copied over the %u bytes from %s on, or over some of them",
                block.bytes, name);
  }
  return RUNG_OK;
}

} // namespace

int32_t checkPlace(const rung_instance& instance, const HostBlock& block) {
  const BlockState state = locateBlock(*instance.environment, instance.running.program(), block).state;
  return state == BlockState::Good ? int32_t{RUNG_OK} : failBlock(instance, block, state);
}

void addBlocks(rung_instance& instance, const std::vector<HostBlock>& given) {
  instance.generations.blocks.add(*instance.environment, given);
  if (std::ranges::any_of(given, &HostBlock::input)) instance.running.setLatching(true);
}

} // namespace rung::api

using namespace rung::api;

int32_t rung_instance_bind_blocks(rung_instance* instance, const rung_block* blocks, uint32_t count) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (blocks == nullptr && count != 0) return fail(RUNG_BAD_ARGUMENT, "the blocks are null, their number is not 0");
  return contained([&] {
    std::vector<HostBlock> given;
    for (uint32_t i = 0; i < count; ++i) {
      if (const int32_t status = checkBlock(blocks[i], i); status != RUNG_OK) return status;
      const HostBlock& block = given.emplace_back(HostBlock{.name = blocks[i].name,
                                                            .address = static_cast<uint8_t*>(blocks[i].address),
                                                            .bytes = blocks[i].bytes,
                                                            .input = blocks[i].direction == RUNG_TO_PROGRAM});
      if (const int32_t status = checkPlace(*call, block); status != RUNG_OK) return status;
    }
    addBlocks(*call, given);
    return int32_t{RUNG_OK};
  });
}
