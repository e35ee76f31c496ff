// Tickets and the function table for generated code.
#include "rtlib/core/queues.h"

#include <cassert>
#include <type_traits>

namespace rung::core {

namespace {

HostPort& portOf(rung_ctx* ctx) noexcept { return *static_cast<HostPort*>(ctx->host_data); }

void message(rung_ctx* ctx, const rung_message* message) { portOf(ctx).messages.push(*message); }

uint32_t serviceRequest(rung_ctx* ctx, uint32_t service, const int64_t* args, uint32_t count) {
  return portOf(ctx).services.request(service, args, count);
}

uint32_t servicePoll(rung_ctx* ctx, uint32_t ticket) { return portOf(ctx).services.poll(ticket); }

int64_t serviceResult(rung_ctx* ctx, uint32_t ticket, uint32_t index) {
  return portOf(ctx).services.result(ticket, index);
}

constexpr rung_host_api kHostApi = {sizeof(rung_host_api), 0, message, serviceRequest, servicePoll, serviceResult};

uint32_t bounded(uint32_t count) noexcept { return count < RUNG_MAX_SERVICE_ARGS ? count : RUNG_MAX_SERVICE_ARGS; }

void fill(ServiceRecord& record, const ServiceReply& reply) noexcept {
  record.state = reply.state == RUNG_SERVICE_ERROR ? RUNG_SERVICE_ERROR : RUNG_SERVICE_DONE;
  record.resultCount = bounded(reply.resultCount);
  for (uint32_t i = 0; i < RUNG_MAX_SERVICE_ARGS; ++i)
    record.results[i] = i < record.resultCount ? reply.results[i] : 0;
}

} // namespace

const rung_host_api& hostApi() noexcept { return kHostApi; }

// The next number whose record has no pending request. It exists because at most kMaxPending of kRecords records have
// one.
uint32_t ServiceQueue::freeTicket() noexcept {
  for (uint32_t tries = 0; tries <= kMaxPending + 1; ++tries) {
    if (++lastTicket_ == 0) continue; // 0 is not a ticket
    if (recordOf(lastTicket_).state != RUNG_SERVICE_PENDING) return lastTicket_;
  }
  return 0;
}

uint32_t ServiceQueue::request(uint32_t service, const int64_t* args, uint32_t count) noexcept {
  // Checked first, so that a program gets the same refusals with and without a responder.
  if (pending_ == kMaxPending) {
    refused_.store(refused() + 1, std::memory_order_relaxed);
    return 0;
  }
  ServiceRequest request;
  request.ticket = freeTicket();
  request.service = service;
  setName(request);
  request.argCount = bounded(count);
  for (uint32_t i = 0; i < request.argCount; ++i) request.args[i] = args[i];

  ServiceRecord& record = records_[request.ticket % kRecords];
  record = {};
  record.ticket = request.ticket;
  ServiceReply reply;
  const bool claimed = responder_.respond != nullptr && responder_.respond(responder_.data, request, reply);
  if (claimed && reply.state != RUNG_SERVICE_PENDING) {
    fill(record, reply);
    return request.ticket;
  }
  if (!claimed && !requests_.push(request)) { // the host has not skipped the requests from before a restart yet
    record = {};
    refused_.store(refused() + 1, std::memory_order_relaxed);
    return 0;
  }
  record.state = RUNG_SERVICE_PENDING;
  ++pending_;
  return request.ticket;
}

uint32_t ServiceQueue::poll(uint32_t ticket) const noexcept {
  const ServiceRecord& record = recordOf(ticket);
  return ticket != 0 && record.ticket == ticket ? record.state : static_cast<uint32_t>(RUNG_SERVICE_NONE);
}

int64_t ServiceQueue::result(uint32_t ticket, uint32_t index) const noexcept {
  const ServiceRecord& record = recordOf(ticket);
  return ticket != 0 && record.ticket == ticket && index < record.resultCount ? record.results[index] : 0;
}

void ServiceQueue::deliverAll() noexcept {
  ServiceReply reply;
  for (uint32_t i = 0; i < kMaxPending && replies_.pop(reply); ++i) {
    ServiceRecord& record = records_[reply.ticket % kRecords];
    if (reply.ticket == 0 || record.ticket != reply.ticket || record.state != RUNG_SERVICE_PENDING) {
      stray_.store(stray_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      continue;
    }
    fill(record, reply);
    --pending_;
    if (delivered_ != nullptr) delivered_(observer_, reply);
  }
}

// Ticket numbers continue, so a late reply to a request from before finds no record.
void ServiceQueue::restart() noexcept {
  for (ServiceRecord& record : records_) record = {};
  pending_ = 0;
  refused_.store(0, std::memory_order_relaxed);
  stray_.store(0, std::memory_order_relaxed);
  requests_.drop();
  ServiceReply reply;
  for (uint32_t i = 0; i < kMaxPending && replies_.pop(reply);) ++i;
  lostBefore_.store(replies_.lost(), std::memory_order_relaxed);
}

// ---- state -------------------------------------------------------------------------------------------------------

namespace {

// Only the values that are used.
template <class Archive, class Value>
void archiveValues(Archive& archive, Value* values, uint32_t count) {
  using Byte = std::conditional_t<std::is_const_v<Value>, const uint8_t, uint8_t>;
  archive.bytes({reinterpret_cast<Byte*>(values), count * sizeof *values});
}

template <class T>
uint32_t lengthOf(const Ring<T>& ring) noexcept {
  uint32_t length = 0;
  while (ring.peek(length) != nullptr) ++length;
  return length;
}

bool isPossible(const Loader& loader, uint32_t count, uint32_t most) noexcept { return loader.good() && count <= most; }

} // namespace

void ServiceQueue::save(Saver& saver, bool waiting) const noexcept {
  const auto used = static_cast<uint32_t>(
      std::ranges::count_if(records_, [](uint32_t ticket) { return ticket != 0; }, &ServiceRecord::ticket));
  saver(lastTicket_, used);
  for (const ServiceRecord& record : records_) {
    if (record.ticket == 0) continue;
    saver(record.ticket, record.state, record.resultCount);
    archiveValues(saver, record.results, record.resultCount);
  }
  const uint32_t asked = waiting ? lengthOf(requests_) : 0;
  saver(asked);
  for (uint32_t i = 0; i < asked; ++i) {
    saver(*requests_.peek(i));
  }
  const uint32_t answered = waiting ? lengthOf(replies_) : 0;
  saver(answered);
  for (uint32_t i = 0; i < answered; ++i) {
    ServiceReply reply = *replies_.peek(i);
    reply.resultCount = bounded(reply.resultCount);
    saver(reply.ticket, reply.state, reply.resultCount);
    archiveValues(saver, reply.results, reply.resultCount);
  }
}

void ServiceQueue::load(Loader& loader) noexcept {
  restart();
  for (ServiceRequest dropped; requests_.pop(dropped);) assert(false); // only skips those of before
  loader(lastTicket_);
  loadRecords(loader);
  loadRequests(loader);
  loadReplies(loader);
  if (!loader.good()) restart();
}

void ServiceQueue::loadRecords(Loader& loader) noexcept {
  uint32_t count = 0;
  loader(count);
  if (!isPossible(loader, count, kRecords)) return loader.fail();
  for (; count != 0 && loader.good(); --count) {
    ServiceRecord record;
    loader(record.ticket, record.state, record.resultCount);
    if (!isPossible(loader, record.resultCount, RUNG_MAX_SERVICE_ARGS)) return loader.fail();
    archiveValues(loader, record.results, record.resultCount);
    if (record.ticket == 0 || record.state > RUNG_SERVICE_ERROR) return loader.fail();
    pending_ += record.state == RUNG_SERVICE_PENDING ? 1 : 0;
    records_[record.ticket % kRecords] = record;
  }
  if (pending_ > kMaxPending) loader.fail();
}

void ServiceQueue::loadRequests(Loader& loader) noexcept {
  uint32_t count = 0;
  loader(count);
  if (!isPossible(loader, count, kMaxPending)) return loader.fail();
  for (; count != 0 && loader.good(); --count) {
    ServiceRequest request;
    loader(request);
    setName(request);
    if (!loader.good() || !requests_.push(request)) return loader.fail();
  }
}

void ServiceQueue::loadReplies(Loader& loader) noexcept {
  uint32_t count = 0;
  loader(count);
  if (!isPossible(loader, count, kMaxPending)) return loader.fail();
  for (; count != 0 && loader.good(); --count) {
    ServiceReply reply;
    loader(reply.ticket, reply.state, reply.resultCount);
    if (!isPossible(loader, reply.resultCount, RUNG_MAX_SERVICE_ARGS)) return loader.fail();
    archiveValues(loader, reply.results, reply.resultCount);
    if (!replies_.push(reply)) return loader.fail();
  }
}

} // namespace rung::core
