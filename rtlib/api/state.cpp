// The state of an instance as bytes, and its clock.
#include <span>

#include "rtlib/api/error.h"
#include "rtlib/api/replacing.h"
#include "rtlib/api/running.h"
#include "rtlib/core/archive.h"

namespace rung::api {

namespace {

constexpr int64_t kHourUs = 3'600'000'000;

// What the library itself knows beside the instance and the control.
struct OfLibrary {
  uint64_t scans = 0;
  uint32_t functionChannels = 0;
  bool ending = false;
  uint64_t lastScan = 0;

  template <class Archive>
  void state(Archive& archive) {
    archive(scans, functionChannels, ending, lastScan);
  }
};

int32_t failLoad(runtime::LoadResult result) noexcept {
  switch (result) {
  case runtime::LoadResult::OtherProgram:
    return fail(RUNG_REFUSED, "the state is that of another program, or of another version of it");
  case runtime::LoadResult::OtherForces:
    return fail(RUNG_WRONG_STATE, "other cells are forced than when the state was saved, or with other values");
  case runtime::LoadResult::Damaged:
  case runtime::LoadResult::Loaded: break;
  }
  return fail(RUNG_REFUSED, "the state is damaged, or was saved by another version of the library");
}

} // namespace

bool saveState(const rung_instance& instance, core::Saver& saver, Waiting waiting) noexcept {
  if (!instance.running.save(saver, waiting == Waiting::Included)) return false;
  instance.environment->save(saver);
  saver(OfLibrary{.scans = instance.scans,
                  .functionChannels = instance.functionChannels,
                  .ending = instance.ending,
                  .lastScan = instance.lastScan});
  return true;
}

int32_t loadState(rung_instance& instance, core::Loader& loader) {
  const runtime::LoadResult result = instance.running.load(loader);
  if (result == runtime::LoadResult::OtherProgram || result == runtime::LoadResult::OtherForces)
    return failLoad(result);
  endShadow(instance); // it repeats recorded scans, and this was none
  OfLibrary own;
  const bool isPossible = result == runtime::LoadResult::Loaded;
  if (isPossible) {
    instance.environment->load(instance.running, loader);
    loader(own);
  }
  if (!isPossible || !loader.good() || loader.left() != 0) {
    instance.on = false;
    return failLoad(runtime::LoadResult::Damaged);
  }
  instance.scans = own.scans;
  instance.functionChannels = own.functionChannels;
  instance.ending = own.ending;
  instance.lastScan = own.lastScan;
  instance.faultReported = instance.running.faulted();
  instance.pace.restart();
  settleForces(instance);
  if (instance.recorder) instance.recorder->changedWhole();
  return RUNG_OK;
}

} // namespace rung::api

using namespace rung;
using namespace rung::api;

int32_t rung_instance_save(const rung_instance* instance, void* bytes, size_t size, size_t* used) {
  const Call call(instance, When::On);
  if (!call.ok()) return call.status();
  if (used == nullptr || (bytes == nullptr && size != 0))
    return fail(RUNG_BAD_ARGUMENT, "the pointer that receives the state or its size is null");
  core::Saver saver({static_cast<uint8_t*>(bytes), size});
  if (!saveState(*call, saver, Waiting::Included)) return fail(RUNG_LATER, "a scan has not ended");
  *used = saver.size();
  if (saver.fits() || bytes == nullptr) return RUNG_OK;
  return fail(RUNG_BAD_ARGUMENT, "the state has %zu bytes, there is room for %zu", saver.size(), size);
}

int32_t rung_instance_load(rung_instance* instance, const void* bytes, size_t size) {
  const Call call(instance, When::On);
  if (!call.ok()) return call.status();
  if (bytes == nullptr) return fail(RUNG_BAD_ARGUMENT, "the state is null");
  core::Loader loader({static_cast<const uint8_t*>(bytes), size});
  return contained([&] { return loadState(*call, loader); });
}

int32_t rung_instance_set_clock(rung_instance* instance, int64_t now_us) {
  const Call call(instance, When::On);
  if (!call.ok()) return call.status();
  const int64_t now = call->running.nowUs();
  if (now_us < now || now_us - now > kHourUs)
    return fail(RUNG_BAD_ARGUMENT, "the clock advances by 0 to 3600000000 us, not from %lld to %lld",
                static_cast<long long>(now), static_cast<long long>(now_us));
  call->running.advanceClock(now_us - now);
  return RUNG_OK;
}
