// Requests to services by the names of their arguments: what expect_call, reply and prepare compare and write.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/core/queues.h"
#include "rtlib/run/instance.h"
#include "tools/scenario/device_bytes.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

// A service as rung_program names it: "NAME arg1 arg2 -> result1 result2". A name with ":f" after it is a real, whose
// bits travel, with ":s" a text and with ":b" bytes, of which the result is the number; these are also called `data`.
// Without "->" the service takes no answer. With an argument `block` the request has an operand block (see
// rtlib/nc/nct/operand_block.h), whose words are arguments and results too: w4, or d4 for the double in words 4 and 5.
class ServiceSignature {
public:
  explicit ServiceSignature(std::string_view text);
  const std::string& name() const { return name_; }
  bool isNamed(std::string_view name) const; // whatever the case
  // Index of an argument or result; -1 when there is none of this name.
  int argument(std::string_view key) const;
  int result(std::string_view key) const;
  enum class Form : uint8_t { Integer, Real, Text, Bytes };
  Form formOfArgument(int index) const { return arguments_[static_cast<size_t>(index)].form; }
  Form formOfResult(int index) const { return results_[static_cast<size_t>(index)].form; }
  int argumentCount() const { return static_cast<int>(arguments_.size()); }
  // The result that is a text or bytes, or -1.
  int dataResult() const { return dataOf(results_); }
  bool takesNoAnswer() const { return takesNoAnswer_; }
  bool hasBlock() const { return argument("block") >= 0; }
  // "function, address": for messages.
  std::string argumentNames() const;
  std::string resultNames() const;

private:
  struct Name {
    std::string text;
    Form form = Form::Integer;
  };
  static int dataOf(const std::vector<Name>& names);
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

} // namespace rung::scenario
