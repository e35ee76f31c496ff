// Requests to services by the names of their arguments: what expect_call, reply and prepare compare and write.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rtlib/core/queues.h"
#include "rtlib/nc/service.h"
#include "rtlib/run/instance.h"
#include "sim/retained_tables.h"
#include "sim/simulated_nc.h"
#include "tools/scenario/device_bytes.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

// The row of a program's service; of one that no table knows, what its text says.
nc::ServiceRow serviceRow(const rung_program& program, uint32_t service);

// A service by the names of its arguments and results. Those that are a text or bytes are also called `data`. With an
// argument `block` the request has an operand block (see rtlib/nc/nct/operand_block.h), whose words are arguments and
// results too: w4, or d4 for the double in words 4 and 5.
class ServiceSignature {
public:
  explicit ServiceSignature(const nc::ServiceRow& row) : row_(row) {}
  std::string_view name() const { return row_.name; }
  bool isNamed(std::string_view name) const; // whatever the case
  // Index of an argument or result; -1 when there is none of this name.
  int argument(std::string_view key) const { return indexOf(row_.arguments, key); }
  int result(std::string_view key) const { return indexOf(row_.results, key); }
  nc::ServiceForm formOfArgument(int index) const { return row_.arguments[static_cast<uint32_t>(index)].form; }
  nc::ServiceForm formOfResult(int index) const { return row_.results[static_cast<uint32_t>(index)].form; }
  int argumentCount() const { return static_cast<int>(row_.arguments.count()); }
  // The result that is a text or bytes, or -1.
  int dataResult() const { return dataOf(row_.results); }
  bool takesNoAnswer() const { return !row_.takesAnswer; }
  bool hasBlock() const { return argument("block") >= 0; }
  // "function, address": for messages.
  std::string argumentNames() const { return namesOf(row_.arguments); }
  std::string resultNames() const;

private:
  static int dataOf(const nc::ServiceValues& values);
  static int indexOf(const nc::ServiceValues& values, std::string_view key);
  std::string namesOf(const nc::ServiceValues& values) const;

  nc::ServiceRow row_;
};

// An answer that waits for its request.
struct Prepared {
  std::string service;
  std::vector<KeyValue> keys;
  std::vector<KeyValue> results;
};

// Some key is a word of the operand block.
bool namesWords(const ServiceSignature& signature, const std::vector<KeyValue>& keys);

// "" when the service knows these arguments and results; a result may also be `error`.
std::string keyProblem(const ServiceSignature& signature, const std::vector<KeyValue>& arguments,
                       const std::vector<KeyValue>& results);
// "" when the request is this service with these arguments; keys that are not given are not compared. `data` of a
// request that has a `length` compares modulo so many bytes. Words of a block are those in the instance's memory.
std::string requestDifference(const ServiceSignature& signature, const Asked& asked, std::string_view service,
                              const std::vector<KeyValue>& keys, const runtime::Instance* instance = nullptr);
// The bytes of its arguments, read now.
Asked askedNow(const runtime::Instance& instance, const ServiceSignature& signature,
               const core::ServiceRequest& request);

// An answer; `bytes` are those of the result that is a text or bytes.
struct Answer {
  core::ServiceReply reply;
  std::string bytes;
};
// Results in the order of the signature; `error=1` gives the state Error. A length that is not given is that of the
// bytes, or the one that was asked for.
Answer answerOf(const ServiceSignature& signature, const core::ServiceRequest& request,
                const std::vector<KeyValue>& results);
// Writes the words among the results into the request's block, before it is completed.
void answerBlock(runtime::Instance& instance, const ServiceSignature& signature, const core::ServiceRequest& request,
                 const std::vector<KeyValue>& results);

// The requests to services of one running program: those that wait, those that a scenario has looked at, and the
// answers that it has prepared.

class Requests final : public sim::Answers {
public:
  // While a task runs: answers a request with what is prepared for it. A request with an operand block is kept back and
  // answered by `take`. False: nothing is prepared.
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override;
  // A device of TECHNOL without a scripted answer: what continues at once gets the answer of its table, all else waits.
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
  std::vector<Asked> waiting_;     // requests that no statement has looked at, oldest first
  std::vector<Asked> taken_;       // requests that expect_call consumed, oldest first
  std::vector<Prepared> prepared_; // answers that wait for their request
  std::vector<std::pair<uint32_t, std::string>> bytes_; // of answers, by their ticket
  bool calledOneWay_ = false; // the last request that expect_call consumed takes no answer, or has it
};

} // namespace rung::scenario
