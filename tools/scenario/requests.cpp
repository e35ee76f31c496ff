// Requests to services and their answers (see requests.h).
#include "tools/scenario/requests.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "rtlib/host/program_info.h"
#include "rtlib/nc/control/refuse.h"

namespace rung::scenario {

using host::Instance;

namespace {

ServiceSignature signatureOf(const Instance& instance, const rt::ServiceRequest& request) {
  return ServiceSignature(host::serviceName(instance.program(), request.service));
}

void answer(Instance& instance, const ServiceSignature& signature, const rt::ServiceRequest& request,
            const std::vector<KeyValue>& results) {
  answerBlock(instance, signature, request, results);
  instance.services().complete(replyOf(signature, request.ticket, results));
}

} // namespace

// The answer prepared for the request, taken out; nothing when there is none. A running task has its memory for itself:
// then only answers that ask for no word of the block are looked at.
std::optional<Prepared> Requests::takePrepared(const Instance& instance, const ServiceSignature& signature,
                                               const rt::ServiceRequest& request, bool running) {
  for (size_t i = 0; i < prepared_.size(); ++i) {
    if (running && namesWords(signature, prepared_[i].keys)) continue;
    if (!requestDifference(signature, request, prepared_[i].service, prepared_[i].keys, &instance).empty()) continue;
    Prepared found = std::move(prepared_[i]);
    prepared_.erase(prepared_.begin() + static_cast<std::ptrdiff_t>(i));
    return found;
  }
  return std::nullopt;
}

bool Requests::respond(Instance& instance, const rt::ServiceRequest& request, rt::ServiceReply& reply) {
  if (prepared_.empty()) return false;
  const ServiceSignature signature = signatureOf(instance, request);
  const auto prepared = takePrepared(instance, signature, request, true);
  if (!prepared) return false;
  if (signature.hasBlock()) {
    claimed_.push_back({request, *prepared});
    reply.state = RUNG_SERVICE_PENDING;
  } else {
    reply = replyOf(signature, request.ticket, prepared->results);
  }
  return true;
}

void Requests::take(Instance& instance) {
  for (const Claimed& claimed : claimed_)
    answer(instance, signatureOf(instance, claimed.request), claimed.request, claimed.answer.results);
  claimed_.clear();
  rt::ServiceRequest request;
  while (instance.services().take(request)) {
    const ServiceSignature signature = signatureOf(instance, request);
    if (signature.takesNoAnswer()) answer(instance, signature, request, {});
    const auto prepared = signature.hasBlock() ? takePrepared(instance, signature, request, false) : std::nullopt;
    if (prepared)
      answer(instance, signature, request, prepared->results);
    else
      waiting_.push_back(request);
  }
}

void Requests::programChanged(Instance& instance, const sim::Relocation& relocation) {
  const auto gone = [&](rt::ServiceRequest& request) {
    relocation.renumber(request);
    if (request.service == RUNG_NONE) instance.services().complete(nc::refuse(instance.program(), request));
    return request.service == RUNG_NONE;
  };
  for (std::vector<rt::ServiceRequest>* list : {&waiting_, &taken_}) {
    std::vector<rt::ServiceRequest> former;
    former.swap(*list);
    for (rt::ServiceRequest& request : former)
      if (!gone(request)) list->push_back(request);
  }
}

void Requests::clear() {
  claimed_.clear();
  waiting_.clear();
  taken_.clear();
  prepared_.clear();
}

std::string Requests::expectCall(Instance& instance, const Statement& s) {
  take(instance);
  if (waiting_.empty()) return fmt::format("no request is pending; expected {}", s.name);
  const rt::ServiceRequest next = waiting_.front();
  const ServiceSignature signature = signatureOf(instance, next);
  std::string difference = requestDifference(signature, next, s.name, s.keys, &instance);
  if (!difference.empty()) return difference;
  waiting_.erase(waiting_.begin());
  calledOneWay_ = signature.takesNoAnswer();
  if (!calledOneWay_) taken_.push_back(next);
  return {};
}

std::string Requests::expectNoCall(Instance& instance, const Statement& s) {
  take(instance);
  for (const rt::ServiceRequest& waiting : waiting_) {
    const ServiceSignature signature = signatureOf(instance, waiting);
    if (s.name.empty() || signature.isNamed(s.name)) return fmt::format("a request {} is pending", signature.name());
  }
  return {};
}

std::string Requests::reply(Instance& instance, const Statement& s) {
  take(instance);
  if (std::exchange(calledOneWay_, false) && s.results.empty()) return {}; // it is complete
  std::vector<rt::ServiceRequest>& pending = taken_.empty() ? waiting_ : taken_;
  const auto next = std::ranges::find_if(
      pending, [&](const auto& request) { return !signatureOf(instance, request).takesNoAnswer(); });
  if (next == pending.end()) return "no request is pending";
  const rt::ServiceRequest request = *next;
  const ServiceSignature signature = signatureOf(instance, request);
  std::string problem = keyProblem(signature, {}, s.results);
  if (!problem.empty()) return problem;
  pending.erase(next);
  answer(instance, signature, request, s.results);
  return {};
}

std::string Requests::prepare(const Instance& instance, const Statement& s) {
  const rung_program& program = instance.program();
  for (uint32_t i = 0; i < program.service_count; ++i) {
    const ServiceSignature signature(host::serviceName(program, i));
    if (!signature.isNamed(s.name)) continue;
    std::string problem = keyProblem(signature, s.keys, s.results);
    if (problem.empty()) prepared_.push_back({s.name, s.keys, s.results});
    return problem;
  }
  return fmt::format("this program asks for no service {}", s.name);
}

} // namespace rung::scenario
