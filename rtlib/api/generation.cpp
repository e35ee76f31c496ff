// The programs of an instance (see generation.h).
#include "rtlib/api/generation.h"

#include <algorithm>
#include <utility>

namespace rung::api {

Generation::Generation(Generations& all, uint32_t ofInstance, std::shared_ptr<const Image> of,
                       std::shared_ptr<const runtime::CopyLists> lists)
    : number(ofInstance), image(std::move(of)), copyLists(std::move(lists)), cells(program(), copyLists->views()),
      blockPlan(program(), copyLists->views()), all_(all) {
  if (program().instrumented != 0) clock = runtime::calibratedClock();
}

Generation::~Generation() {
  all_.names.leave(cells);
  all_.blocks.leave(blockPlan);
}

std::shared_ptr<Generation> Generations::add(const Surroundings& around, std::shared_ptr<const Image> image,
                                             std::shared_ptr<const runtime::CopyLists> lists) {
  const std::lock_guard lock(mutex_);
  letGoLocked();
  auto made = std::make_shared<Generation>(*this, last_ + 1, std::move(image), std::move(lists));
  names.join(around, made->cells);
  blocks.join(around, made->blockPlan);
  all_.push_back(made);
  ++last_;
  return made;
}

std::shared_ptr<Generation> Generations::running() {
  const std::lock_guard lock(mutex_);
  const auto found = std::ranges::find(all_, now_.load(std::memory_order_acquire), &std::shared_ptr<Generation>::get);
  assert(found != all_.end()); // the one that runs is never let go
  return *found;
}

void Generations::letGo() {
  const std::lock_guard lock(mutex_);
  letGoLocked();
}

// One that may run again, a replacement holds.
void Generations::letGoLocked() {
  std::erase_if(all_, [this](const std::shared_ptr<Generation>& one) {
    return one.use_count() == 1 && !one->isReferredTo() && one.get() != now_.load(std::memory_order_acquire);
  });
}

} // namespace rung::api
