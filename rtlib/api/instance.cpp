// Creation, freeing and switching on and off; calls and their threads; hooks of the schedule (see instance.h).
#include "rtlib/api/instance.h"

#include <pthread.h>

#include "rtlib/api/error.h"
#include "rtlib/api/replacing.h"
#include "rtlib/api/running.h"
#include "rtlib/load/program_info.h"

namespace rung::api {

// ---- who is inside -----------------------------------------------------------------------------------------------

rung_instance* instanceOf(const rung_instance* handle) noexcept {
  return const_cast<rung_instance*>(checked(handle, kInstanceMark));
}

Call::Call(const rung_instance* handle, When when) noexcept : instance_(instanceOf(handle)) {
  if (instance_ == nullptr) {
    status_ = failHandle("an instance");
    return;
  }
  const auto self = static_cast<uintptr_t>(pthread_self());
  uintptr_t other = 0;
  if (instance_->inside.compare_exchange_strong(other, self, std::memory_order_acquire)) {
    entered_ = true;
    if (when == When::On && !instance_->on)
      status_ = fail(RUNG_WRONG_STATE, "the program is not switched on: call rung_instance_power_on");
  } else if (other != self) {
    status_ = fail(RUNG_WRONG_THREAD, "another thread is inside a call for this instance");
  } else if (when != When::Always) {
    status_ = failCallback();
  }
  if (ok()) instance_->bringInWhatIsSeen();
}

bool isInCallback(const rung_instance& instance) noexcept {
  return instance.inside.load(std::memory_order_relaxed) == static_cast<uintptr_t>(pthread_self());
}

int32_t failCallback() noexcept { return fail(RUNG_WRONG_STATE, "a callback of the instance may only read it"); }

// ---- the schedule ------------------------------------------------------------------------------------------------

// The control must know all messages that it reports as shown, so earlier messages are passed to it first.
void Hooks::onHook(runtime::Instance& running, uint32_t work) {
  takeMessages(instance_);
  instance_.environment->onHook(running, work);
}

uint32_t Hooks::works() const { return instance_.environment->works(); }

void Hooks::onFault(runtime::Instance& running) { instance_.environment->onFault(running); }

void Hooks::onLatch(runtime::Instance& running, uint32_t task) {
  instance_.now().blockPlan.latch(running.block().data(), task);
}

bool Hooks::respond(runtime::Instance& running, const core::ServiceRequest& request, core::ServiceReply& reply) {
  if (request.service != nc::Control::kOwnService) shadowRequest(instance_, request);
  const rung_instance_options& options = instance_.options;
  int32_t answer = (options.flags & RUNG_QUEUE_REQUESTS) != 0 ? RUNG_QUEUE : RUNG_REFUSE;
  if (options.request != nullptr) {
    const rung_request asked = shown(request, *instance_.control);
    rung_reply given{.size = sizeof given, .ticket = request.ticket};
    answer = options.request(options.user, &instance_, &asked, &given);
    if (answer == RUNG_ANSWER) reply = taken(given);
    reply.ticket = request.ticket;
  }
  if (instance_.recorder) instance_.recorder->decided(answer, reply);
  if (answer == RUNG_ANSWER) return true;
  return answer != RUNG_QUEUE && instance_.environment->respond(running, request, reply);
}

// ---- power -------------------------------------------------------------------------------------------------------

namespace {

void log(const rung_instance& instance, rung_log_level level, const std::string& text) {
  if (instance.options.log != nullptr && !text.empty())
    instance.options.log(instance.options.user, level, text.c_str());
}

// Loads the retained memory, after saving that of the former power-on (after a fault, that of the last whole scan). If
// it cannot be saved, the program stays off, and the image is kept for the next attempt.
int32_t loadRetained(rung_instance& instance, nc::PowerOn& kind) {
  std::string report, error;
  std::optional<nc::PowerOn> found;
  {
    const std::lock_guard lock(instance.retentionChanges);
    if (instance.retention)
      if (const std::string unsaved = instance.retention->finish(); !unsaved.empty())
        return fail(RUNG_FAILED, "%s", unsaved.c_str());
    instance.retention.reset();
    instance.retention = std::make_unique<nc::Retention>(*instance.control, instance.running, instance.retainFile,
                                                         &runtime::takeRetainedOf, instance.outside);
    found = instance.retention->load(report, error);
    if (!found) instance.retention.reset();
  }
  log(instance, RUNG_LOG_WARNING, report);
  if (!found) return fail(RUNG_FAILED, "%s", error.c_str());
  if (kind == nc::PowerOn::Warm) kind = *found;
  return RUNG_OK;
}

int32_t powerOn(rung_instance& instance, nc::PowerOn kind) {
  instance.on = false;
  clearOutputs(instance); // until the first slice ends, or if a fault prevents it
  endShadow(instance);
  if (!instance.retainFile.empty()) {
    if (const int32_t status = loadRetained(instance, kind); status != RUNG_OK) return status;
  } else if (!instance.wasOn) {
    kind = nc::PowerOn::Cold;
  }
  instance.running.setStopped(false);
  instance.running.clearProfile();
  instance.environment->powerOn(instance.running, kind);
  takeMessages(instance);
  settleForces(instance);
  instance.pace.restart();
  instance.functionChannels = 0;
  instance.scans = 0;
  instance.passNs = instance.lastPassNs = instance.worstPassNs = 0;
  instance.on = instance.wasOn = true;
  instance.ending = false;
  instance.faultReported = false;
  if (instance.recorder) instance.recorder->changedWhole();
  if (Generation* faulted = instance.faulted.exchange(nullptr); faulted != nullptr) faulted->forget();
  reportFault(instance);
  return statusOf(instance);
}

// Begins the power-off if necessary. Returns whether the program still needs scans for it.
bool needsLastScans(rung_instance& instance) noexcept {
  nc::Control& control = *instance.control;
  if (!instance.ending) {
    if (instance.recorder) instance.recorder->partBegins(runtime::PartKind::PowerOff, RUNG_NONE, false);
    const bool needs = !instance.running.faulted() && control.beginPowerOff(instance.running);
    instance.ending = true;
    instance.lastScan = instance.scans + (needs ? nc::Control::kMostLastScans : 0);
    takeMessages(instance);
    if (instance.recorder) instance.recorder->partEnds();
  }
  return instance.scans < instance.lastScan && !instance.running.faulted() && control.endsLater(instance.running);
}

int32_t powerOff(rung_instance& instance) {
  // Saved before the last scans, because a fault in them would make the retained memory unusable.
  if (instance.retention && !instance.running.faulted()) (void)instance.retention->finish();
  while (needsLastScans(instance)) {
    do runPart(instance, runtime::PartKind::Slice, [&] { instance.running.slice(); });
    while (!instance.running.atListStart() && !instance.running.faulted());
  }
  instance.on = false;
  clearOutputs(instance);
  const std::string error = instance.retention ? instance.retention->finish() : std::string();
  return error.empty() ? int32_t{RUNG_OK} : fail(RUNG_FAILED, "%s", error.c_str());
}

} // namespace
} // namespace rung::api

using namespace rung;
using namespace rung::api;

namespace {

runtime::PaceOptions paceOf(const rung_instance_options& given) noexcept {
  runtime::PaceOptions options;
  if (given.catch_up != 0) options.catchUp = given.catch_up;
  if (given.most_overruns != 0) options.mostOverruns = given.most_overruns == RUNG_NONE ? 0 : given.most_overruns;
  return options;
}

} // namespace

rung_instance::rung_instance(std::shared_ptr<const Image> from, const rung_instance_options& given,
                             std::unique_ptr<Environment> own, bool alone)
    : options(given), dialect(from->program.dialect), environment(std::move(own)), control(&environment->control()),
      controlAlone(alone), hooks(*this),
      running({from->program, from->engine, static_cast<uint8_t*>(given.memory), serviceNames.of(from->program)},
              &hooks),
      pace(running, paceOf(given)) {
  generations.enter(*generations.add(*environment, std::move(from), running.copyLists()));
  control->onReplace(running); // a replacement before the first power-on exchanges places
  beginLeavingOut();
}

rung_instance::~rung_instance() { recording.reset(); }

namespace rung::api {

int32_t newInstance(rung_image* image, const rung_instance_options* options, std::unique_ptr<Environment> environment,
                    rung_instance** instance) {
  const rung_image* handle = checked(image, kImageMark);
  if (handle == nullptr) return failHandle("an image");
  if (instance == nullptr) return fail(RUNG_BAD_ARGUMENT, "the pointer that receives the instance is null");
  rung_instance_options given{};
  if (!takeStruct(options, given)) return failSize("rung_instance_options");
  constexpr uint32_t kFlags = RUNG_MEASURE | RUNG_QUEUE_REQUESTS | RUNG_SAVE_AT_ONCE;
  if ((given.flags & ~kFlags) != 0)
    return fail(RUNG_BAD_ARGUMENT, "the flags %u are not all those of enum rung_instance_flags", given.flags);
  if (const int32_t status = checkMemory(handle->image->program, given.memory, given.memory_bytes); status != RUNG_OK)
    return status;
  return contained([&] {
    const bool alone = environment == nullptr;
    if (alone) environment = controlAlone(handle->image->program.dialect);
    *instance = new rung_instance(handle->image, given, std::move(environment), alone);
    return int32_t{RUNG_OK};
  });
}

} // namespace rung::api

int32_t rung_instance_new(rung_image* image, const rung_instance_options* options, rung_instance** instance) {
  return newInstance(image, options, nullptr, instance);
}

int32_t rung_instance_free(rung_instance* instance) {
  if (instance == nullptr) return RUNG_OK;
  {
    const Call call(instance);
    if (!call.ok()) return call.status();
  }
  release(instance);
  return RUNG_OK;
}

int32_t rung_instance_power_on(rung_instance* instance, int32_t power) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (power != RUNG_COLD && power != RUNG_WARM)
    return fail(RUNG_BAD_ARGUMENT, "the power-on is RUNG_COLD or RUNG_WARM, not %d", power);
  return contained([&] { return powerOn(*call, power == RUNG_WARM ? nc::PowerOn::Warm : nc::PowerOn::Cold); });
}

int32_t rung_instance_begin_power_off(rung_instance* instance) {
  const Call call(instance, When::On);
  if (!call.ok()) return call.status();
  return needsLastScans(*call) ? RUNG_LATER : RUNG_OK;
}

int32_t rung_instance_power_off(rung_instance* instance) {
  const Call call(instance, When::On);
  if (!call.ok()) return call.status();
  return contained([&] { return powerOff(*call); });
}

int32_t rung_instance_keep(rung_instance* instance, const char* path) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (path == nullptr || *path == 0) return fail(RUNG_BAD_ARGUMENT, "retained memory needs the name of a file");
  if (call->wasOn) return fail(RUNG_WRONG_STATE, "where retained memory is kept is said before the first power-on");
  return contained([&] {
    call->retainFile = path;
    return int32_t{RUNG_OK};
  });
}

int32_t rung_instance_unsaved(const rung_instance* instance, char* text, size_t bytes) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  if (text == nullptr || bytes == 0) return fail(RUNG_BAD_ARGUMENT, "the place for the text is null or has no bytes");
  return contained([&] {
    const std::lock_guard lock(handle->retentionChanges);
    if (!handle->retention || !handle->retention->memory().failing()) return int32_t{RUNG_EMPTY};
    text[handle->retention->memory().problem({text, bytes - 1})] = 0;
    return int32_t{RUNG_OK};
  });
}

int32_t rung_instance_flush(rung_instance* instance) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  if (!call->retention) return fail(RUNG_WRONG_STATE, "no retained memory is kept: see rung_instance_keep");
  return contained([&] {
    if (call->retention->flush()) return int32_t{RUNG_OK};
    return fail(RUNG_FAILED, "%s", call->retention->memory().problem().c_str());
  });
}
