// The requests to services of one running program: those that wait, those that a scenario has looked at, and the
// answers that it has prepared.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rtlib/run/instance.h"
#include "sim/relocation.h"
#include "sim/simulated_nc.h"
#include "tools/scenario/scenario.h"
#include "tools/scenario/services.h"

namespace rung::scenario {

class Requests final : public sim::Answers {
public:
  // While a task runs: answers a request with what is prepared for it. A request with an operand block is kept back and
  // answered by `take`. False: nothing is prepared.
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override;
  // A device of TECHNOL that nobody has answered for: what continues at once gets the answer of its table, all else
  // waits.
  bool takeUnanswered(runtime::Instance& instance, const core::ServiceRequest& request,
                      core::ServiceReply& reply) override;
  // Who learns what was answered between two scans. It outlives this.
  void report(sim::SimulatedNc& nc) { nc_ = &nc; }
  // Between two scans: takes what has entered the program's queue. Prepared answers to operand blocks are given here,
  // and what takes no answer is complete.
  void take(runtime::Instance& instance);
  // Another program has taken over: requests that wait are answered to it. Those of services that it does not have are
  // refused.
  void programChanged(runtime::Instance& instance, const sim::Relocation& relocation);
  void clear();

  // The statements of these names; each gives "" or what is wrong.
  std::string expectCall(runtime::Instance& instance, const Statement& s);
  std::string expectNoCall(runtime::Instance& instance, const Statement& s);
  std::string reply(runtime::Instance& instance, const Statement& s);
  std::string prepare(const runtime::Instance& instance, const Statement& s);

private:
  struct Claimed {
    core::ServiceRequest request;
    Prepared answer;
  };
  std::optional<Prepared> takePrepared(const runtime::Instance& instance, const ServiceSignature& signature,
                                       const Asked& asked, bool running);
  Asked asAsked(const core::ServiceRequest& request);
  void answer(runtime::Instance& instance, const ServiceSignature& signature, const core::ServiceRequest& request,
              const std::vector<KeyValue>& results);
  // Bytes that the program may still fetch; the oldest are dropped.
  void keepBytes(uint32_t ticket, std::string bytes);

  sim::SimulatedNc* nc_ = nullptr;
  std::vector<Claimed> claimed_;   // requests with an operand block, answered when the scan is over
  std::vector<Asked> queued_;      // what is in the program's queue, as far as it has bytes
  std::vector<Asked> waiting_;     // requests that nobody has looked at, oldest first
  std::vector<Asked> taken_;       // requests that expect_call consumed, oldest first
  std::vector<Prepared> prepared_; // answers that wait for their request
  std::vector<std::pair<uint32_t, std::string>> bytes_; // of answers, by their ticket
  bool calledOneWay_ = false; // the last request that expect_call consumed takes no answer, or has it
};

} // namespace rung::scenario
