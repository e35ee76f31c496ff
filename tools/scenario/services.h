// Requests to services by the names of their arguments: what expect_call, reply and prepare compare and write.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/core/queues.h"
#include "rtlib/host/instance.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

// A service as rung_program names it: "NAME arg1 arg2 -> result1 result2". A name with ":f" after it is a real, whose
// bits travel. Without "->" the service takes no answer. With an argument `block` the request has an operand block (see
// rtlib/nc/nct/operand_block.h), whose words are arguments and results too: w4, or d4 for the double in words 4 and 5.
class ServiceSignature {
public:
  explicit ServiceSignature(std::string_view text);
  const std::string& name() const { return name_; }
  bool isNamed(std::string_view name) const; // whatever the case
  // Index of an argument or result; -1 when there is none of this name.
  int argument(std::string_view key) const;
  int result(std::string_view key) const;
  bool isRealArgument(int index) const { return arguments_[static_cast<size_t>(index)].isReal; }
  bool isRealResult(int index) const { return results_[static_cast<size_t>(index)].isReal; }
  bool takesNoAnswer() const { return takesNoAnswer_; }
  bool hasBlock() const { return argument("block") >= 0; }
  // "function, address": for messages.
  std::string argumentNames() const;
  std::string resultNames() const;

private:
  struct Name {
    std::string text;
    bool isReal = false;
  };
  static int indexOf(const std::vector<Name>& names, std::string_view key);
  std::string namesOf(const std::vector<Name>& names) const;

  std::string name_;
  std::vector<Name> arguments_;
  std::vector<Name> results_;
  bool takesNoAnswer_ = true;
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
std::string requestDifference(const ServiceSignature& signature, const rt::ServiceRequest& request,
                              std::string_view service, const std::vector<KeyValue>& keys,
                              const host::Instance* instance = nullptr);
// Results in the order of the signature; `error=1` gives the state Error.
rt::ServiceReply replyOf(const ServiceSignature& signature, uint32_t ticket, const std::vector<KeyValue>& results);
// Writes the words among the results into the request's block, before it is completed.
void answerBlock(host::Instance& instance, const ServiceSignature& signature, const rt::ServiceRequest& request,
                 const std::vector<KeyValue>& results);

} // namespace rung::scenario
