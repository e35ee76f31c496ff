// A program that instances run, shared by the image's handle, instances and replacements.
#pragma once
#include <atomic>
#include <cassert>
#include <cstdint>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "rtlib/api/blocks.h"
#include "rtlib/api/cells.h"
#include "rtlib/api/error.h"
#include "rtlib/load/so_engine.h"
#include "rtlib/record/profile_clock.h"
#include "rtlib/run/footprint.h"
#include "rtlib/run/loaded_program.h"
#include "rung/program.h"
#include "rung/runtime.h"

namespace rung::api {

struct Image {
  explicit Image(std::unique_ptr<runtime::SoEngine> file);
  Image(const rung_program& inMemory, void* context, void (*releases)(void*), void* ownedBy);
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  ~Image();

  std::unique_ptr<runtime::SoEngine> loaded; // null: the program was in memory
  const rung_program& program;
  void* engine = nullptr; // rung_ctx::engine
  void (*release)(void* owner) = nullptr;
  void* owner = nullptr;
  std::vector<uint32_t> symbols; // the author's, in the program's table
  runtime::Footprint footprint;
  // Entered once, by any thread; null: no compiler serves the image.
  mutable std::atomic<const rung_code_maker*> maker{nullptr};
};

// A program of an instance, with what the instance's host has there. Who runs is one pointer to one of them. What a
// program has left, messages, a fault, refers to its generation, and so does what was prepared for it:
// replacements, sets of forces, shadows.

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
  std::shared_ptr<Generation> add(const Environment& environment, std::shared_ptr<const Image> image,
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

// What the services of an instance's programs are. A request that waits has one of the names, whichever program runs
// when it is taken, and whether the one that asks for it exists still.

class ServiceNames {
public:
  // By the numbers of the services; valid as long as this. Programs that number them alike have one list. Any thread,
  // but not in real time.
  const core::ServiceName* of(const rung_program& program);

private:
  struct List {
    std::vector<std::string> texts;
    std::vector<core::ServiceName> names;
  };
  std::mutex mutex_;
  std::list<List> lists_;
};

} // namespace rung::api

struct rung_image {
  uint32_t mark = rung::api::kImageMark;
  std::shared_ptr<const rung::api::Image> image;
};
