// Requests to services by the names of their arguments: compared by expect_call, answered by reply and prepare.
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

// The table row of a program's service; for a service in no table, a row made from its text.
nc::ServiceRow serviceRow(const rung_program& program, uint32_t service);

// A service with the names of its arguments and results. Texts and bytes among them are also called `data`. With an
// argument `block`, the request has an operand block (see rtlib/nc/nct/operand_block.h), whose words are arguments and
// results too: w4, or d4 for the double in words 4 and 5.
class ServiceSignature {
public:
  explicit ServiceSignature(const nc::ServiceRow& row) : row_(row) {}
  std::string_view name() const { return row_.name; }
  bool isNamed(std::string_view name) const; // ignores case
  // Index of an argument or result; -1 if there is no such name.
  int argument(std::string_view key) const { return indexOf(row_.arguments, key); }
  int result(std::string_view key) const { return indexOf(row_.results, key); }
  nc::ServiceForm formOfArgument(int index) const { return row_.arguments[static_cast<uint32_t>(index)].form; }
  nc::ServiceForm formOfResult(int index) const { return row_.results[static_cast<uint32_t>(index)].form; }
  int argumentCount() const { return static_cast<int>(row_.arguments.count()); }
  // Index of the result that is a text or bytes, or -1.
  int dataResult() const { return dataOf(row_.results); }
  bool takesNoAnswer() const { return !row_.takesAnswer; }
  bool hasBlock() const { return argument("block") >= 0; }
  // For messages: "function, address".
  std::string argumentNames() const { return namesOf(row_.arguments); }
  std::string resultNames() const;

private:
  static int dataOf(const nc::ServiceValues& values);
  static int indexOf(const nc::ServiceValues& values, std::string_view key);
  std::string namesOf(const nc::ServiceValues& values) const;

  nc::ServiceRow row_;
};

// A prepared answer that waits for its request.
struct Prepared {
  std::string service;
  std::vector<KeyValue> keys;
  std::vector<KeyValue> results;
};

// Whether some key is a word of the operand block.
bool namesWords(const ServiceSignature& signature, const std::vector<KeyValue>& keys);

// "" if the service has these arguments and results; a result may also be `error`.
std::string keyProblem(const ServiceSignature& signature, const std::vector<KeyValue>& arguments,
                       const std::vector<KeyValue>& results);
// "" if the request is to this service with these arguments; keys that are not given are not compared. `data` of a
// request with a `length` is compared up to that many bytes. Words of a block are read from the instance's memory.
std::string requestDifference(const ServiceSignature& signature, const Asked& asked, std::string_view service,
                              const std::vector<KeyValue>& keys, const runtime::Instance* instance = nullptr);
// The request with the bytes of its arguments, read now.
Asked askedNow(const runtime::Instance& instance, const ServiceSignature& signature,
               const core::ServiceRequest& request);

// An answer; `bytes` belong to the result that is a text or bytes.
struct Answer {
  core::ServiceReply reply;
  std::string bytes;
};
// Puts the results in the order of the signature; `error=1` gives the state Error. A length that is not given is that
// of the bytes, or the requested one.
Answer answerOf(const ServiceSignature& signature, const core::ServiceRequest& request,
                const std::vector<KeyValue>& results);
// Writes the words among the results to the request's block, before the request is completed.
void answerBlock(runtime::Instance& instance, const ServiceSignature& signature, const core::ServiceRequest& request,
                 const std::vector<KeyValue>& results);

// The requests to services of one running program: those that wait, those that a scenario has checked, and the answers
// that it has prepared.

class Requests final : public sim::Answers {
public:
  // Called while a task runs: answers a request with a prepared answer. A request with an operand block is answered
  // later, by `take`. False: no answer is prepared.
  bool respond(runtime::Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) override;
  // A request to a TECHNOL device without a scripted answer: one that continues at once is answered from the device's
  // table, all others wait.
  bool takeUnanswered(runtime::Instance& instance, const core::ServiceRequest& request,
                      core::ServiceReply& reply) override;
  // Sets the NC that is notified of answers given between two scans. It must outlive this.
  void report(sim::SimulatedNc& nc) { nc_ = &nc; }
  // Called between two scans: takes the requests from the program's queue. Prepared answers to requests with operand
  // blocks are given here, and requests that take no answer are complete.
  void take(runtime::Instance& instance);
  // Another program has taken over: waiting requests are moved to it. Those to services that it does not have are
  // refused.
  void programChanged(runtime::Instance& instance, const sim::Relocation& relocation);
  void clear();
  // Continues with a copy that was made while the same program ran.
  void restore(const runtime::Instance& instance, const Requests& saved);

  // The statements of these names; each function returns "" or what is wrong.
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
  // Stores bytes that the program may fetch later; the oldest are dropped.
  void keepBytes(uint32_t ticket, std::string bytes);

  sim::SimulatedNc* nc_ = nullptr;
  std::vector<Claimed> claimed_;                        // requests with an operand block, answered after the scan
  std::vector<Asked> queued_;                           // requests with bytes that are in the program's queue
  std::vector<Asked> waiting_;                          // requests that no statement has checked, oldest first
  std::vector<Asked> taken_;                            // requests that expect_call took, oldest first
  std::vector<Prepared> prepared_;                      // answers that wait for their request
  std::vector<std::pair<uint32_t, std::string>> bytes_; // of answers, by ticket
  bool calledOneWay_ = false; // the last request that expect_call took needs no answer, or has one
};

} // namespace rung::scenario
