// A program of an instance, with what the instance's host has there. Who runs is one pointer to one of them. What a
// program has left, messages, a fault, refers to its generation, and so does what was prepared for it:
// replacements, sets of forces, shadows.
#pragma once
#include <atomic>
#include <cassert>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "rtlib/api/blocks.h"
#include "rtlib/api/cells.h"
#include "rtlib/api/image.h"
#include "rtlib/record/profile_clock.h"
#include "rtlib/run/copy_lists.h"

namespace rung::api {

class Generations;

struct Generation {
  // `lists`: of the program, as its memory is used. `all` outlives it.
  Generation(Generations& all, uint32_t ofInstance, std::shared_ptr<const Image> of,
             std::shared_ptr<const runtime::CopyLists> lists);
  ~Generation();
  Generation(const Generation&) = delete;
  Generation& operator=(const Generation&) = delete;

  const rung_program& program() const noexcept { return image->program; }
  // A message or a fault refers to it from now on, or does so no longer. Any thread.
  void refer() noexcept { references_.fetch_add(1, std::memory_order_relaxed); }
  void forget() noexcept {
    [[maybe_unused]] const uint32_t before = references_.fetch_sub(1, std::memory_order_release);
    assert(before != 0);
  }
  bool isReferredTo() const noexcept { return references_.load(std::memory_order_acquire) != 0; }

  const uint32_t number; // among the programs of the instance, from 1, in the order in which they were prepared
  const std::shared_ptr<const Image> image;
  const std::shared_ptr<const runtime::CopyLists> copyLists; // what cells and plan look at
  CellTable cells;
  BlockPlan blockPlan;
  runtime::ProfileClock clock; // of a program that counts and times its rungs

private:
  Generations& all_;
  std::atomic<uint32_t> references_{0};
};

// Those of an instance: the one that runs, and all that somebody holds or refers to.
class Generations {
public:
  // For any thread, but not in real time. Lets go what nobody needs any more.
  std::shared_ptr<Generation> add(const Surroundings& around, std::shared_ptr<const Image> image,
                                  std::shared_ptr<const runtime::CopyLists> lists);
  // The one that runs at this moment; it stays alive, and may run no longer.
  std::shared_ptr<Generation> running();
  // `see` gets that; none is let go meanwhile.
  template <class See>
  void look(See see) const {
    const std::lock_guard lock(mutex_);
    see(now());
  }
  void letGo();

  // Scan thread: which one runs. Somebody holds the next one.
  Generation& now() const noexcept { return *now_.load(std::memory_order_acquire); }
  void enter(Generation& next) noexcept { now_.store(&next, std::memory_order_release); }

  // What all of them have, each at places of its own.
  CellNames names;
  HostBlocks blocks;

private:
  void letGoLocked();

  mutable std::mutex mutex_;
  uint32_t last_ = 0;
  std::vector<std::shared_ptr<Generation>> all_;
  std::atomic<Generation*> now_{nullptr};
};

} // namespace rung::api
