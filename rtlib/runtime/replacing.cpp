// Another program for an instance: prepared outside real time, put in its place between two passes.
#include <atomic>
#include <cstring>
#include <string>
#include <utility>

#include "rtlib/host/replacement.h"
#include "rtlib/host/scan_bound.h"
#include "rtlib/runtime/error.h"
#include "rtlib/runtime/replacing.h"
#include "rtlib/runtime/running.h"
#include "rtlib/runtime/structs.h"

using namespace rung;
using namespace rung::runtime;

struct rung_replacement {
  rung_replacement(rung_instance& of, std::shared_ptr<const Image> next, uint8_t* memory)
      : instance(of), image(std::move(next)),
        replacement(*of.program.load(std::memory_order_acquire), {image->program, image->engine, memory}),
        places(of.control->locate(image->program)), placesAround(of.around->locate(image->program)),
        cells(std::make_unique<CellTable>(image->program, replacement.neededCopies())),
        blockPlan(std::make_unique<BlockPlan>(image->program, replacement.neededCopies())),
        lane(std::make_unique<host::RetainLane>(host::RetainMap(image->program))) {
    if (image->program.instrumented != 0) clock = profile::calibratedClock();
    bound = host::measureBound({image->program, image->engine});
    boundText = host::boundText(bound, image->program);
    join();
  }
  ~rung_replacement() {
    rung_replacement* self = this;
    instance.former.compare_exchange_strong(self, nullptr);
    instance.puttingBack.wait();
    instance.names.leave(*cells);
    instance.blocks.leave(*blockPlan);
    const std::lock_guard lock(instance.retentionChanges);
    if (instance.retention) instance.retention->settle();
  }

  // At last: what has joined is looked at by others until it leaves.
  void join() {
    instance.images.add(image);
    instance.names.join(*instance.around, *cells);
    try {
      instance.blocks.join(*instance.around, *blockPlan);
    } catch (...) {
      instance.names.leave(*cells);
      throw;
    }
  }

  uint32_t mark = kReplacementMark;
  rung_instance& instance;
  std::shared_ptr<const Image> image;
  host::Replacement replacement;
  std::unique_ptr<nc::Places> places;       // of the control
  std::unique_ptr<nc::Places> placesAround; // of the surroundings
  std::unique_ptr<CellTable> cells;
  std::unique_ptr<BlockPlan> blockPlan;
  std::unique_ptr<host::RetainLane> lane; // what is kept of the program
  bool holdsFormer = false;               // the program that it was made to replace
  profile::Clock clock;
  host::ScanBound bound; // of the new program
  std::string boundText;
  std::atomic<bool> mayBeLate{false};
};

namespace rung::runtime {
namespace {

int32_t failOther() noexcept { return fail(RUNG_BAD_ARGUMENT, "the replacement was made for another instance"); }

host::ReplaceResult exchange(rung_instance& instance, rung_replacement& replacement) noexcept {
  const host::ReplaceResult result = instance.running.replace(replacement.replacement);
  if (result != host::ReplaceResult::Replaced) return result;
  instance.control->exchangePlaces(instance.running, replacement.places);
  instance.around->exchangePlaces(replacement.placesAround);
  instance.around->programChanged(instance.running, instance.image->program);
  std::swap(instance.image, replacement.image);
  std::swap(instance.cells, replacement.cells);
  std::swap(instance.blockPlan, replacement.blockPlan);
  instance.beginLeavingOut();
  std::swap(instance.clock, replacement.clock);
  settleForces(instance);
  if (instance.retention) instance.retention->programChanged(replacement.lane);
  instance.program.store(&instance.image->program, std::memory_order_release);
  instance.pace.programChanged();
  replacement.holdsFormer = !replacement.holdsFormer;
  instance.former.store(replacement.holdsFormer ? &replacement : nullptr);
  return result;
}

} // namespace

int32_t imageOf(const rung_instance& instance, const rung_replacement* replacement,
                std::shared_ptr<const Image>& image) {
  const rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  if (&handle->instance != &instance) return failOther();
  image = handle->image;
  return RUNG_OK;
}

int32_t failLater(const rung_instance& instance, host::ReplaceResult result,
                  const host::StateTransfer& transfer) noexcept {
  if (result == host::ReplaceResult::WithinPass)
    return fail(RUNG_LATER, "the program is within a pass of its schedule");
  if (result == host::ReplaceResult::RequestsWait)
    return fail(RUNG_LATER, "a request waits for its answer, and the new program numbers its services otherwise");
  return fail(RUNG_LATER, "%s waits at an instruction that the new program does not have",
              transfer.waiting(instance.running.block().data()));
}

int32_t checkDialect(const rung_instance& instance, const rung_program& program) noexcept {
  const char* dialect = instance.program.load(std::memory_order_acquire)->dialect; // that of all its programs
  if (std::strcmp(dialect, program.dialect) == 0) return RUNG_OK;
  return fail(RUNG_REFUSED, "%s is a program of %s, the one that runs is of %s", program.name, program.dialect,
              dialect);
}

void putFormerBack(rung_instance& instance) noexcept {
  instance.puttingBack.enter();
  if (rung_replacement* former = instance.former.exchange(nullptr); former != nullptr) {
    std::shared_ptr<const Image> faulty = instance.image;
    instance.fault = instance.running.fault();
    if (exchange(instance, *former) == host::ReplaceResult::Replaced) instance.faultImage.swap(faulty);
  }
  instance.puttingBack.leave();
}

} // namespace rung::runtime

int32_t rung_replacement_new(rung_instance* instance, rung_image* image, void* memory, size_t memory_bytes,
                             rung_replacement** replacement) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  const rung_image* next = checked(image, kImageMark);
  if (next == nullptr) return failHandle("an image");
  if (replacement == nullptr) return fail(RUNG_BAD_ARGUMENT, "the pointer that receives the replacement is null");
  const rung_program& program = next->image->program;
  if (const int32_t status = checkDialect(*handle, program); status != RUNG_OK) return status;
  if (const int32_t status = checkMemory(program, memory, memory_bytes); status != RUNG_OK) return status;
  if (const int32_t status = handle->structs.check(program); status != RUNG_OK) return status;
  return contained([&] {
    *replacement = new rung_replacement(*handle, next->image, static_cast<uint8_t*>(memory));
    return int32_t{RUNG_OK};
  });
}

int32_t rung_replacement_free(rung_replacement* replacement) {
  return endHandle(replacement, kReplacementMark, "a replacement");
}

int32_t rung_replacement_report(const rung_replacement* replacement, rung_replacement_info* info) {
  const rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  const host::StateTransfer& transfer = handle->replacement.transfer();
  return giveStruct(info, rung_replacement_info{.kept_cells = transfer.keptCells(),
                                                .kept_states = transfer.keptSlots(),
                                                .changes = static_cast<uint32_t>(transfer.changes().size()),
                                                .bytes = handle->replacement.bytes(),
                                                .steps = handle->bound.weight,
                                                .slice_ns = static_cast<uint64_t>(handle->bound.ns),
                                                .period_ns = static_cast<uint64_t>(handle->bound.periodNs),
                                                .bound = handle->boundText.c_str()});
}

int32_t rung_replacement_allow_late(rung_replacement* replacement) {
  rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  handle->mayBeLate = true;
  return RUNG_OK;
}

int32_t rung_replacement_change(const rung_replacement* replacement, uint32_t index, rung_change* change) {
  const rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  const std::span<const host::StateChange> changes = handle->replacement.transfer().changes();
  if (index >= changes.size()) return RUNG_EMPTY;
  const host::StateChange& c = changes[index];
  return giveStruct(change, rung_change{.kind = static_cast<uint32_t>(c.kind),
                                        .is_state = c.slot ? 1u : 0u,
                                        .name = c.name.c_str(),
                                        .former = c.formerName.c_str()});
}

int32_t rung_instance_replace(rung_instance* instance, rung_replacement* replacement) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  rung_replacement* handle = checked(replacement, kReplacementMark);
  if (handle == nullptr) return failHandle("a replacement");
  if (&handle->instance != &*call) return failOther();
  if (!handle->holdsFormer && !handle->bound.fits() && !handle->mayBeLate)
    return fail(RUNG_REFUSED, "a slice of the new program may last %s", handle->boundText.c_str());
  const host::ReplaceResult result = exchange(*call, *handle);
  if (result == host::ReplaceResult::Replaced) return RUNG_OK;
  if (result == host::ReplaceResult::OtherProgram)
    return fail(RUNG_WRONG_STATE, "the replacement was made for another program than the one that runs");
  return failLater(*call, result, handle->replacement.transfer());
}
