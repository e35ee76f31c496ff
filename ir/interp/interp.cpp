// Chunks and exits of the reference interpreter (see interp.h); operations are in rung_run.cpp.
#include "ir/interp/interp.h"

#include <algorithm>
#include <array>

#include "ir/core/ops.h"
#include "ir/interp/rung_run.h"
#include "ir/support/check.h"

namespace rung::ir {
namespace {

constexpr size_t kOnStack = 4096; // values and operands on the stack: 32 kB

// Returns the destination, which is the caller's chunk if `to` has none.
Destination reach(Destination to, rung_ctx& ctx) {
  if (to.chunk == RUNG_NONE) to.chunk = ctx.stack[--ctx.sp];
  return to;
}

Destination leave(const Exit& exit, std::span<const uint64_t> values, rung_ctx& ctx) {
  if (exit.cond.valid() && values[exit.cond.index] == 0) return reach(exit.otherwise, ctx);
  switch (exit.kind) {
  case TransferKind::Next: return reach(exit.otherwise, ctx);
  case TransferKind::Goto: return exit.taken;
  case TransferKind::Call:
    // After a call at the end of a routine there is nowhere to return to: the callee returns to the routine's caller.
    if (exit.otherwise.chunk != RUNG_NONE) ctx.stack[ctx.sp++] = exit.otherwise.chunk;
    return exit.taken;
  case TransferKind::Ret: return reach({}, ctx);
  case TransferKind::End: break;
  case TransferKind::Switch: {
    const uint64_t value = values[exit.value.index];
    return exit.targets[value < exit.targets.size() ? value : 0];
  }
  }
  return {.chunk = RUNG_PC_DONE};
}

} // namespace

InterpEngine::InterpEngine(const Layout& layout, uint64_t codeHash, Counting counting)
    : layout_(layout), counting_(counting), image_(layout, codeHash),
      functions_(layout.partition().chunks().size(), &chunkFunction), exits_(layout.partition().rungCount()),
      regions_(layout.partition().rungCount()) {
  image_.program().chunk_fns = functions_.data();
  const std::vector<Routine>& routines = layout.module().routines;
  for (uint32_t r = 0; r < routines.size(); ++r)
    for (uint32_t i = 0; i < routines[r].rungs.size(); ++i) {
      const uint32_t number = layout.partition().rungNumber(RoutineId{r}, i);
      exits_[number] = exitOf(layout.partition(), RoutineId{r}, i);
      if (!findRegions(routines[r].rungs[i], regions_[number])) regions_[number].clear();
      mostValues_ = std::max(mostValues_, routines[r].rungs[i].values.size());
      for (const Op& op : routines[r].rungs[i].ops) mostArgs_ = std::max<size_t>(mostArgs_, op.argCount);
    }
}

bool InterpEngine::allocates() const { return mostValues_ + mostArgs_ > kOnStack; }

uint32_t InterpEngine::chunkFunction(uint8_t* mem, rung_ctx* ctx, uint32_t chunk) {
  RUNG_CHECK(ctx->engine != nullptr, "rung_ctx::engine is not set to the interpreter");
  return static_cast<const InterpEngine*>(ctx->engine)->runChunk(mem, *ctx, chunk);
}

uint32_t InterpEngine::runChunk(uint8_t* mem, rung_ctx& ctx, uint32_t chunk) const {
  const Chunk& place = layout_.partition().chunks()[chunk];
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-member-init): cleared a rung at a time
  std::array<uint64_t, kOnStack> few;
  std::vector<uint64_t> many;
  if (allocates()) many.resize(mostValues_ + mostArgs_);
  const std::span<uint64_t> room = allocates() ? std::span<uint64_t>(many) : std::span<uint64_t>(few);
  uint32_t extra = 0;
  Destination next{.rung = place.firstRung};
  while (next.inside()) {
    const Rung& rung = layout_.module().at(place.routine).rungs[next.rung];
    const uint32_t number = layout_.partition().rungNumber(place.routine, next.rung);
    const std::span<uint64_t> values = room.first(rung.values.size());
    std::ranges::fill(values, uint64_t{0});
    RungRun run(layout_.memory(), rung, number, regions_[number], mem, ctx, values, room.last(mostArgs_), counting_,
                observer_.get());
    const bool completed = run.run();
    if (observer_ != nullptr) observer_->rungRan(number, completed ? values : std::span<const uint64_t>());
    if (!completed) return RUNG_PC_FAULT;
    next = leave(exits_[number], values, ctx);
    extra += next.extra;
  }
  ctx.extra_weight = extra;
  return next.chunk;
}

} // namespace rung::ir
