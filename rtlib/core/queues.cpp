// Tickets and the function table for generated code.
#include "rtlib/core/queues.h"

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
  if (service < nameCount_) request.name = &names_[service];
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

} // namespace rung::core
