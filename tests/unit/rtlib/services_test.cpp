// Service tickets, and the function table that generated code calls.
#include "rtlib/core/queues.h"

#include <gtest/gtest.h>

#include <memory>
#include <thread>

namespace {

using namespace rung::core;

class Services : public testing::Test {
protected:
  ServiceReply reply(uint32_t ticket, int64_t value, uint32_t state = RUNG_SERVICE_DONE) {
    ServiceReply r;
    r.ticket = ticket;
    r.state = state;
    r.resultCount = 2;
    r.results[0] = value;
    r.results[1] = -value;
    return r;
  }
  std::unique_ptr<ServiceQueue> queue = std::make_unique<ServiceQueue>();
};

TEST_F(Services, ReplyBecomesVisibleAtDeliver) {
  const int64_t args[] = {3, -4};
  const uint32_t ticket = queue->request(1, args, 2);
  ASSERT_NE(ticket, 0u);
  EXPECT_EQ(queue->poll(ticket), RUNG_SERVICE_PENDING);
  ServiceRequest request;
  ASSERT_TRUE(queue->take(request));
  EXPECT_EQ(request.ticket, ticket);
  EXPECT_EQ(request.service, 1u);
  EXPECT_EQ(request.argCount, 2u);
  EXPECT_EQ(request.args[1], -4);
  EXPECT_TRUE(queue->complete(reply(ticket, 9)));
  EXPECT_EQ(queue->poll(ticket), RUNG_SERVICE_PENDING);
  queue->deliver();
  EXPECT_EQ(queue->poll(ticket), RUNG_SERVICE_DONE);
  EXPECT_EQ(queue->result(ticket, 0), 9);
  EXPECT_EQ(queue->result(ticket, 1), -9);
  EXPECT_EQ(queue->result(ticket, 2), 0);
  EXPECT_EQ(queue->pending(), 0u);
}

TEST_F(Services, ErrorStateReachesTheProgram) {
  const uint32_t ticket = queue->request(0, nullptr, 0);
  queue->complete(reply(ticket, 6, RUNG_SERVICE_ERROR));
  queue->deliver();
  EXPECT_EQ(queue->poll(ticket), RUNG_SERVICE_ERROR);
  EXPECT_EQ(queue->result(ticket, 0), 6);
}

TEST_F(Services, UnknownTicketsAreNone) {
  EXPECT_EQ(queue->poll(0), RUNG_SERVICE_NONE);
  EXPECT_EQ(queue->poll(77), RUNG_SERVICE_NONE);
  const uint32_t ticket = queue->request(0, nullptr, 0);
  EXPECT_EQ(queue->poll(ticket + ServiceQueue::kRecords), RUNG_SERVICE_NONE);
  EXPECT_EQ(queue->result(ticket + ServiceQueue::kRecords, 0), 0);
}

TEST_F(Services, FullQueueRefusesAndCounts) {
  for (uint32_t i = 0; i < ServiceQueue::kMaxPending; ++i) EXPECT_NE(queue->request(0, nullptr, 0), 0u);
  EXPECT_EQ(queue->request(0, nullptr, 0), 0u);
  EXPECT_EQ(queue->request(0, nullptr, 0), 0u);
  EXPECT_EQ(queue->refused(), 2u);
  EXPECT_EQ(queue->waiting(), ServiceQueue::kMaxPending);
  // Taking alone makes no room: the request is still unanswered.
  ServiceRequest request;
  queue->take(request);
  EXPECT_EQ(queue->request(0, nullptr, 0), 0u);
  queue->complete(reply(request.ticket, 1));
  queue->deliver();
  EXPECT_NE(queue->request(0, nullptr, 0), 0u);
}

TEST_F(Services, PendingTicketsOutliveManyYoungerOnes) {
  const uint32_t old = queue->request(5, nullptr, 0);
  for (uint32_t i = 0; i < 3 * ServiceQueue::kRecords; ++i) {
    const uint32_t ticket = queue->request(0, nullptr, 0);
    ASSERT_NE(ticket, 0u);
    ASSERT_NE(ticket % ServiceQueue::kRecords, old % ServiceQueue::kRecords);
    ServiceRequest request;
    do ASSERT_TRUE(queue->take(request));
    while (request.ticket != ticket);
    queue->complete(reply(ticket, i));
    queue->deliver();
    ASSERT_EQ(queue->result(ticket, 0), i);
  }
  EXPECT_EQ(queue->poll(old), RUNG_SERVICE_PENDING);
  queue->complete(reply(old, 42));
  queue->deliver();
  EXPECT_EQ(queue->result(old, 0), 42);
}

TEST_F(Services, NewTicketDoesNotShowResultsOfAnOldOne) {
  for (uint32_t i = 0; i < ServiceQueue::kRecords; ++i) {
    ServiceRequest request;
    queue->request(0, nullptr, 0);
    ASSERT_TRUE(queue->take(request));
    queue->complete(reply(request.ticket, 7));
    queue->deliver();
  }
  const uint32_t ticket = queue->request(0, nullptr, 0);
  EXPECT_EQ(queue->poll(ticket), RUNG_SERVICE_PENDING);
  EXPECT_EQ(queue->result(ticket, 0), 0);
}

TEST_F(Services, RepliesToNothingAreCounted) {
  const uint32_t ticket = queue->request(0, nullptr, 0);
  queue->complete(reply(ticket + 1, 1));
  queue->complete(reply(ticket, 1));
  queue->complete(reply(ticket, 2)); // answered already
  queue->deliver();
  EXPECT_EQ(queue->stray(), 2u);
  EXPECT_EQ(queue->result(ticket, 0), 1);
  EXPECT_EQ(queue->pending(), 0u);
}

TEST_F(Services, LateReplyToARequestFromBeforeARestartIsThrownAway) {
  const uint32_t before = queue->request(0, nullptr, 0);
  ServiceRequest request;
  ASSERT_TRUE(queue->take(request));
  queue->restart();
  const uint32_t after = queue->request(0, nullptr, 0);
  EXPECT_NE(after, before);
  queue->complete(reply(before, 5));
  queue->deliver();
  EXPECT_EQ(queue->poll(after), RUNG_SERVICE_PENDING);
  EXPECT_EQ(queue->poll(before), RUNG_SERVICE_NONE);
  EXPECT_EQ(queue->stray(), 1u);
  EXPECT_EQ(queue->pending(), 1u);
}

// Requests that nobody has taken keep their room after a restart until the host looks.
TEST_F(Services, ARestartWhileRequestsWait) {
  for (uint32_t i = 0; i < ServiceQueue::kMaxPending; ++i) EXPECT_NE(queue->request(0, nullptr, 0), 0u);
  queue->complete(reply(1, 1));
  queue->complete(reply(1, 1));
  queue->restart();
  EXPECT_EQ(queue->waiting(), 0u);
  EXPECT_EQ(queue->pending(), 0u);
  EXPECT_EQ(queue->request(0, nullptr, 0), 0u);
  EXPECT_EQ(queue->refused(), 1u);
  EXPECT_EQ(queue->pending(), 0u);
  ServiceRequest request;
  EXPECT_FALSE(queue->take(request));
  const uint32_t ticket = queue->request(0, nullptr, 0);
  EXPECT_NE(ticket, 0u);
  ASSERT_TRUE(queue->take(request));
  EXPECT_EQ(request.ticket, ticket);
  queue->deliver();
  EXPECT_EQ(queue->stray(), 0u) << "replies from before are gone";
  EXPECT_EQ(queue->poll(ticket), RUNG_SERVICE_PENDING);
}

TEST_F(Services, LostRepliesOfBeforeARestartDoNotCount) {
  for (uint32_t i = 0; i < ServiceQueue::kMaxPending; ++i) EXPECT_TRUE(queue->complete(reply(1, 1)));
  EXPECT_FALSE(queue->complete(reply(1, 1)));
  EXPECT_EQ(queue->stray(), 1u);
  queue->restart();
  EXPECT_EQ(queue->stray(), 0u);
}

TEST_F(Services, ResponderAnswersInTheSameScan) {
  queue->setResponder({[](void*, const ServiceRequest& request, ServiceReply& r) {
                         if (request.service != 1) return false;
                         r.resultCount = 1;
                         r.results[0] = request.args[0] * 2;
                         return true;
                       },
                       nullptr});
  const int64_t arg = 21;
  const uint32_t ticket = queue->request(1, &arg, 1);
  EXPECT_EQ(queue->poll(ticket), RUNG_SERVICE_DONE);
  EXPECT_EQ(queue->result(ticket, 0), 42);
  EXPECT_EQ(queue->waiting(), 0u);
  EXPECT_EQ(queue->poll(queue->request(0, &arg, 1)), RUNG_SERVICE_PENDING);
  EXPECT_EQ(queue->waiting(), 1u);
}

TEST_F(Services, ResponderMayKeepARequestAndAnswerLater) {
  queue->setResponder({[](void*, const ServiceRequest& request, ServiceReply& r) {
                         r.state = RUNG_SERVICE_PENDING;
                         return request.service == 1;
                       },
                       nullptr});
  const uint32_t ticket = queue->request(1, nullptr, 0);
  EXPECT_EQ(queue->poll(ticket), RUNG_SERVICE_PENDING);
  EXPECT_EQ(queue->waiting(), 0u);
  EXPECT_EQ(queue->pending(), 1u);
  ServiceReply reply;
  reply.ticket = ticket;
  reply.resultCount = 1;
  reply.results[0] = 7;
  EXPECT_TRUE(queue->complete(reply));
  queue->deliver();
  EXPECT_EQ(queue->poll(ticket), RUNG_SERVICE_DONE);
  EXPECT_EQ(queue->result(ticket, 0), 7);
  EXPECT_EQ(queue->pending(), 0u);
}

TEST_F(Services, TooManyArgumentsAreCut) {
  const int64_t args[RUNG_MAX_SERVICE_ARGS + 4] = {1};
  queue->request(0, args, RUNG_MAX_SERVICE_ARGS + 4);
  EXPECT_EQ(queue->peek()->argCount, RUNG_MAX_SERVICE_ARGS);
}

TEST_F(Services, HostAnswersFromAnotherThread) {
  constexpr int kRequests = 20'000;
  std::thread host([this] {
    for (int answered = 0; answered < kRequests;) {
      ServiceRequest request;
      if (!queue->take(request)) {
        std::this_thread::yield();
        continue;
      }
      while (!queue->complete(reply(request.ticket, request.args[0] + 1))) std::this_thread::yield();
      ++answered;
    }
  });
  int wrong = 0;
  for (int64_t i = 0; i < kRequests; ++i) {
    const uint32_t ticket = queue->request(0, &i, 1);
    while (queue->poll(ticket) == RUNG_SERVICE_PENDING) {
      queue->deliver();
      std::this_thread::yield();
    }
    if (queue->result(ticket, 0) != i + 1) ++wrong;
  }
  host.join();
  EXPECT_EQ(wrong, 0);
}

TEST(HostApi, CallsReachThePortOfTheContext) {
  const auto port = std::make_unique<HostPort>();
  rung_ctx ctx{};
  ctx.host = &hostApi();
  ctx.host_data = port.get();
  rung_message message{};
  message.op = RUNG_MESSAGE_SHOW;
  message.number = 20;
  for (uint32_t i = 0; i <= kMessageCapacity; ++i) ctx.host->message(&ctx, &message);
  EXPECT_EQ(port->messages.size(), kMessageCapacity);
  EXPECT_EQ(port->messages.lost(), 1u);
  EXPECT_EQ(port->messages.peek()->number, 20u);
  const int64_t arg = 5;
  const uint32_t ticket = ctx.host->service_request(&ctx, 1, &arg, 1);
  EXPECT_EQ(ctx.host->service_poll(&ctx, ticket), RUNG_SERVICE_PENDING);
  EXPECT_EQ(ctx.host->service_result(&ctx, ticket, 0), 0);
  EXPECT_EQ(port->services.peek()->args[0], 5);
  EXPECT_EQ(ctx.host->size, sizeof(rung_host_api));
}

} // namespace
