// Reading, writing and comparing by the rules of the scenario format: integers modulo their width, reals by tolerance,
// texts as they are; and requests to services by the names of their arguments.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "rtlib/core/queues.h"
#include "rtlib/host/instance.h"
#include "rtlib/nc/model/nc_model.h"
#include "tools/scenario/scenario.h"

namespace rung::scenario {

// What a name holds now.
struct Reading {
  ValueKind kind = ValueKind::Int;
  uint64_t integer = 0;
  uint32_t width = 64; // bits of the integer
  double real = 0;
  std::string text;
};

// `wantReal`: two words or eight bytes are read as one double.
Reading readValue(const host::Instance& instance, const host::Ref& place, bool wantReal);
Reading realReading(double value);

// Each gives "" or what is wrong.
std::string writeValue(host::Instance& instance, const host::Ref& place, const Value& value);
std::string checkValue(const Reading& reading, const Statement& expect);
std::string checkRange(const Reading& reading, const Statement& expect);
std::string messageDifference(const nc::ShownMessage& message, const std::vector<KeyValue>& keys);

std::vector<nc::NcArgument> arguments(const std::vector<KeyValue>& keys);

// A service as rung_program names it: "NAME arg1 arg2 -> result1 result2".
class ServiceSignature {
public:
  explicit ServiceSignature(std::string_view text);
  const std::string& name() const { return name_; }
  bool isNamed(std::string_view name) const; // whatever the case
  // Index of an argument or result; -1 when there is none of this name.
  int argument(std::string_view key) const;
  int result(std::string_view key) const;

private:
  std::string name_;
  std::vector<std::string> arguments_;
  std::vector<std::string> results_;
};

// An answer that waits for its request.
struct Prepared {
  std::string service;
  std::vector<KeyValue> keys;
  std::vector<KeyValue> results;
};

// "" when the service knows these arguments and results; a result may also be `error`.
std::string keyProblem(const ServiceSignature& signature, const std::vector<KeyValue>& arguments,
                       const std::vector<KeyValue>& results);
// "" when the request is this service with these arguments; keys that are not given are not compared. `data` of a
// request that has a `length` compares modulo so many bytes.
std::string requestDifference(const ServiceSignature& signature, const rt::ServiceRequest& request,
                              std::string_view service, const std::vector<KeyValue>& keys);
bool matches(const ServiceSignature& signature, const rt::ServiceRequest& request, std::string_view service,
             const std::vector<KeyValue>& keys);
// Results in the order of the signature; `error=1` gives the state Error.
rt::ServiceReply replyOf(const ServiceSignature& signature, uint32_t ticket, const std::vector<KeyValue>& results);

} // namespace rung::scenario
