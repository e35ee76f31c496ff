// The messages and service requests of a program to its host. Both directions are bounded; a message or request that
// does not fit is refused, and counted.
//
// The program's side of both classes belongs to the scan thread, the host's side to one other thread (or the same one).
// A completed request becomes visible to the program at `deliver`, between two scans; a responder answers at once.
#pragma once
#include <algorithm>
#include <cstdint>

#include "rtlib/core/archive.h"
#include "rtlib/core/handover.h"
#include "rung/program.h"

namespace rung::core {

inline constexpr uint32_t kMessageCapacity = 256;
using MessageQueue = FixedRing<rung_message, kMessageCapacity>;

// The name and kind of a service, valid whichever program runs when its request is read.
struct ServiceName {
  const char* text = "";
  uint32_t kind = 0; // its number, the same in all programs of the dialect; 0: unknown
};
inline constexpr ServiceName kUnknownService;

struct ServiceRequest {
  uint32_t ticket = 0;
  uint32_t service = 0;                       // in rung_program::services
  const ServiceName* name = &kUnknownService; // outlives the queue, see setServices
  uint32_t argCount = 0;
  int64_t args[RUNG_MAX_SERVICE_ARGS] = {};
  // The name follows from the service.
  bool operator==(const ServiceRequest& other) const {
    return ticket == other.ticket && service == other.service && argCount == other.argCount &&
           std::equal(args, args + RUNG_MAX_SERVICE_ARGS, other.args);
  }
  // Of the name only the service (ServiceQueue::setName).
  template <class Archive>
  void state(Archive& archive) {
    archive(ticket, service);
    archive.atMost(argCount, RUNG_MAX_SERVICE_ARGS);
    for (uint32_t i = 0; i < argCount; ++i) archive(args[i]);
  }
};

struct ServiceReply {
  uint32_t ticket = 0;
  uint32_t state = RUNG_SERVICE_DONE; // or RUNG_SERVICE_ERROR
  uint32_t resultCount = 0;
  int64_t results[RUNG_MAX_SERVICE_ARGS] = {};
};

// Called before a request is queued. True: the reply is filled in, and the request does not enter the queue. If the
// reply's state is RUNG_SERVICE_PENDING, the responder has kept the request and completes it later. It runs inside the
// task, so it must be bounded and must not run tasks itself. It may read the program's spaces, which are up to date,
// but not write them (see rung_host_api).
struct ServiceResponder {
  bool (*respond)(void* data, const ServiceRequest& request, ServiceReply& reply) = nullptr;
  void* data = nullptr;
};

// The state of one ticket, as the program sees it.
struct ServiceRecord {
  uint32_t ticket = 0; // 0: never used
  uint32_t state = RUNG_SERVICE_NONE;
  uint32_t resultCount = 0;
  int64_t results[RUNG_MAX_SERVICE_ARGS] = {};
  bool operator==(const ServiceRecord&) const = default;
};

class ServiceQueue {
public:
  static constexpr uint32_t kMaxPending = 64;
  // Records of tickets: a result stays readable for at least kRecords - kMaxPending younger requests.
  static constexpr uint32_t kRecords = 256;

  void setResponder(ServiceResponder responder) noexcept { responder_ = responder; }
  // Sets the names by service number; they outlive the queue. Scan thread.
  void setServices(const ServiceName* names, uint32_t count) noexcept {
    names_ = names;
    nameCount_ = count;
  }

  // Names a request that was loaded.
  void setName(ServiceRequest& request) const noexcept {
    request.name = request.service < nameCount_ ? &names_[request.service] : &kUnknownService;
  }

  // Program. `request` returns the ticket; 0 if kMaxPending requests are unanswered, or if requests from before a
  // restart still fill the queue. `poll` and `result` take constant time.
  uint32_t request(uint32_t service, const int64_t* args, uint32_t count) noexcept;
  uint32_t poll(uint32_t ticket) const noexcept; // enum rung_service_state
  int64_t result(uint32_t ticket, uint32_t index) const noexcept;
  // Scan thread, between scans: makes replies visible. Usually there are none.
  void deliver() noexcept {
    if (replies_.size() != 0) deliverAll();
  }

  // Host. Requests wait in order; a taken one is pending until `complete`. False: more replies than requests.
  uint32_t waiting() const noexcept { return requests_.size(); }
  const ServiceRequest* peek(uint32_t number = 0) const noexcept { return requests_.peek(number); }
  bool take(ServiceRequest& request) noexcept { return requests_.pop(request); }
  bool complete(const ServiceReply& reply) noexcept { return replies_.push(reply); }

  // Counts since the last restart: requests refused for lack of room, and stray replies, whose tickets were not
  // pending.
  uint32_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }
  uint32_t stray() const noexcept {
    return stray_.load(std::memory_order_relaxed) + replies_.lost() - lostBefore_.load(std::memory_order_relaxed);
  }
  uint32_t pending() const noexcept { return pending_; }

  const ServiceRecord& record(uint32_t number) const noexcept { return records_[number]; } // number < kRecords
  // Scan thread, between scans; the host's side may be active. Forgets all tickets: queued requests are dropped, and
  // replies to requests taken before count as stray.
  void restart() noexcept;

  // Scan thread: `delivered` is called for each reply that has become visible; null: nothing is.
  void setObserver(void (*delivered)(void* observer, const ServiceReply& reply), void* observer) noexcept {
    delivered_ = delivered;
    observer_ = observer;
  }

  // The tickets and, if `waiting`, the requests that wait and the replies that have not been delivered, which only then
  // must not be taken or given meanwhile. Scan thread, between scans. What a loaded queue asks its host for is what it
  // had asked for when it was saved; while it is loaded, the host's side must not be active. A state that is impossible
  // leaves the queue as after a restart.
  void save(Saver& saver, bool waiting) const noexcept;
  void load(Loader& loader) noexcept;

private:
  const ServiceRecord& recordOf(uint32_t ticket) const noexcept { return records_[ticket % kRecords]; }
  uint32_t freeTicket() noexcept;
  void deliverAll() noexcept;
  void loadRecords(Loader& loader) noexcept;
  void loadRequests(Loader& loader) noexcept;
  void loadReplies(Loader& loader) noexcept;

  ServiceRecord records_[kRecords];
  void (*delivered_)(void*, const ServiceReply&) = nullptr;
  void* observer_ = nullptr;
  uint32_t lastTicket_ = 0;
  uint32_t pending_ = 0;
  std::atomic<uint32_t> refused_{0};
  std::atomic<uint32_t> stray_{0};
  std::atomic<uint32_t> lostBefore_{0}; // replies that were lost before the last restart
  ServiceResponder responder_;
  const ServiceName* names_ = nullptr;
  uint32_t nameCount_ = 0;
  FixedRing<ServiceRequest, kMaxPending> requests_;
  FixedRing<ServiceReply, kMaxPending> replies_;
};

// The host side of one program instance: what rung_ctx::host_data points to when rung_ctx::host is hostApi().
struct HostPort {
  MessageQueue messages;
  ServiceQueue services;
};

// The function table for generated code, over a HostPort.
const rung_host_api& hostApi() noexcept;

} // namespace rung::core
