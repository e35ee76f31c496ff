// The requests to services of one running program: those that wait, those that a scenario has looked at, and the
// answers that it has prepared.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rtlib/host/instance.h"
#include "tools/scenario/scenario.h"
#include "tools/scenario/services.h"
#include "tools/sim/relocation.h"
#include "tools/sim/simulated_nc.h"

namespace rung::scenario {

class Requests final : public sim::Answers {
public:
  // While a task runs: answers a request with what is prepared for it. A request with an operand block is kept back and
  // answered by `take`. False: nothing is prepared.
  bool respond(host::Instance& instance, const rt::ServiceRequest& request, rt::ServiceReply& reply) override;
  // A device of TECHNOL that nobody has answered for: what continues at once gets the answer of its table, all else
  // waits.
  bool takeUnanswered(host::Instance& instance, const rt::ServiceRequest& request, rt::ServiceReply& reply) override;
  // Who learns what was answered between two scans. It outlives this.
  void report(sim::SimulatedNc& nc) { nc_ = &nc; }
  // Between two scans: takes what has entered the program's queue. Prepared answers to operand blocks are given here,
  // and what takes no answer is complete.
  void take(host::Instance& instance);
  // Another program has taken over: requests that wait are answered to it. Those of services that it does not have are
  // refused.
  void programChanged(host::Instance& instance, const sim::Relocation& relocation);
  void clear();

  // The statements of these names; each gives "" or what is wrong.
  std::string expectCall(host::Instance& instance, const Statement& s);
  std::string expectNoCall(host::Instance& instance, const Statement& s);
  std::string reply(host::Instance& instance, const Statement& s);
  std::string prepare(const host::Instance& instance, const Statement& s);

private:
  struct Claimed {
    rt::ServiceRequest request;
    Prepared answer;
  };
  std::optional<Prepared> takePrepared(const host::Instance& instance, const ServiceSignature& signature,
                                       const Asked& asked, bool running);
  Asked asAsked(const rt::ServiceRequest& request);
  void answer(host::Instance& instance, const ServiceSignature& signature, const rt::ServiceRequest& request,
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
