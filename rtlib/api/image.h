// A loaded program, shared by the image's handle, instances and replacements.
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

  std::unique_ptr<runtime::SoEngine> loaded; // null: the caller passed the program in memory
  const rung_program& program;
  void* engine = nullptr; // rung_ctx::engine
  void (*release)(void* owner) = nullptr;
  void* owner = nullptr;
  std::vector<uint32_t> symbols; // symbols of the author, by index in the program's table
  runtime::Footprint footprint;
  // The compiler attached to the image, set once, by any thread; null: none.
  mutable std::atomic<const rung_code_maker*> maker{nullptr};
};

// A program of an instance, with the cells and blocks of the host in it. Which program runs is one pointer to a
// generation. Whatever belongs to a program (messages, a fault, and the replacements, sets of forces and shadows
// prepared for it) refers to its generation.

class Generations;

struct Generation {
  // `lists` are the copy lists of the program. `all` outlives the generation.
  Generation(Generations& all, uint32_t ofInstance, std::shared_ptr<const Image> of,
             std::shared_ptr<const runtime::CopyLists> lists);
  ~Generation();
  Generation(const Generation&) = delete;
  Generation& operator=(const Generation&) = delete;

  const rung_program& program() const noexcept { return image->program; }
  // Add or remove a reference by a message or a fault. Any thread.
  void refer() noexcept { references_.fetch_add(1, std::memory_order_relaxed); }
  void forget() noexcept {
    [[maybe_unused]] const uint32_t before = references_.fetch_sub(1, std::memory_order_release);
    assert(before != 0);
  }
  bool isReferredTo() const noexcept { return references_.load(std::memory_order_acquire) != 0; }

  const uint32_t number; // among the programs of the instance, from 1, in the order in which they were prepared
  const std::shared_ptr<const Image> image;
  const std::shared_ptr<const runtime::CopyLists> copyLists; // used by cells and plan
  CellTable cells;
  BlockPlan blockPlan;
  runtime::ProfileClock clock; // for a program that counts and times its rungs

private:
  Generations& all_;
  std::atomic<uint32_t> references_{0};
};

// The generations of an instance: the running one, and all that are held or referred to.
class Generations {
public:
  // Adds a generation, and frees those that are not needed any more. Any thread, but not in real time.
  std::shared_ptr<Generation> add(const Environment& environment, std::shared_ptr<const Image> image,
                                  std::shared_ptr<const runtime::CopyLists> lists);
  // The generation that runs at this moment; the result keeps it alive, though another one may run by then.
  std::shared_ptr<Generation> running();
  // Calls `see` with the running generation; none is freed during the call.
  template <class See>
  void look(See see) const {
    const std::lock_guard lock(mutex_);
    see(now());
  }
  void release();

  // Scan thread: the running generation, and the change to the next one, which the caller keeps alive.
  Generation& now() const noexcept { return *now_.load(std::memory_order_acquire); }
  void enter(Generation& next) noexcept { now_.store(&next, std::memory_order_release); }

  // Names and blocks of all generations; each has its own places for them.
  CellNames names;
  HostBlocks blocks;

private:
  void releaseLocked();

  mutable std::mutex mutex_;
  uint32_t last_ = 0;
  std::vector<std::shared_ptr<Generation>> all_;
  std::atomic<Generation*> now_{nullptr};
};

// The names and numbers of the services of an instance's programs. A waiting request refers to one of them, even if
// another program runs by the time the request is taken, and the one that made it no longer exists.

class ServiceNames {
public:
  // By service number, valid as long as this object. Programs that number their services equally share a
  // list. Any thread, but not in real time.
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
