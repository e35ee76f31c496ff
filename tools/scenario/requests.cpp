// Requests to services and their answers (see requests.h).
#include "tools/scenario/requests.h"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/control/refuse.h"
#include "rtlib/nc/technol/services.h"

namespace rung::scenario {

using runtime::Instance;

namespace {

ServiceSignature signatureOf(const Instance& instance, const core::ServiceRequest& request) {
  return ServiceSignature(runtime::serviceName(instance.program(), request.service));
}

constexpr size_t kMostKept = core::ServiceQueue::kRecords; // answers whose bytes are still there

} // namespace

// The answer prepared for the request, taken out; nothing when there is none. A running task has its memory for itself:
// then only answers that ask for no word of the block are looked at.
std::optional<Prepared> Requests::takePrepared(const Instance& instance, const ServiceSignature& signature,
                                               const Asked& asked, bool running) {
  for (size_t i = 0; i < prepared_.size(); ++i) {
    if (running && namesWords(signature, prepared_[i].keys)) continue;
    if (!requestDifference(signature, asked, prepared_[i].service, prepared_[i].keys, &instance).empty()) continue;
    Prepared found = std::move(prepared_[i]);
    prepared_.erase(prepared_.begin() + static_cast<std::ptrdiff_t>(i));
    return found;
  }
  return std::nullopt;
}

void Requests::keepBytes(uint32_t ticket, std::string bytes) {
  if (bytes.empty()) return;
  if (bytes_.size() == kMostKept) bytes_.erase(bytes_.begin());
  bytes_.emplace_back(ticket, std::move(bytes));
}

void Requests::answer(Instance& instance, const ServiceSignature& signature, const core::ServiceRequest& request,
                      const std::vector<KeyValue>& results) {
  answerBlock(instance, signature, request, results);
  Answer made = answerOf(signature, request, results);
  if (nc_ != nullptr) nc_->answered(instance, request, made.bytes);
  keepBytes(request.ticket, std::move(made.bytes));
  instance.services().complete(made.reply);
}

bool Requests::respond(Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) {
  if (!bytes_.empty() && runtime::serviceName(instance.program(), request.service) == nc::technol::kDataService) {
    const auto found =
        std::ranges::find(bytes_, static_cast<uint32_t>(request.args[0]), &decltype(bytes_)::value_type::first);
    if (found != bytes_.end()) return putPart(found->second, request, reply), true;
  }
  if (prepared_.empty()) return false;
  const ServiceSignature signature = signatureOf(instance, request);
  const auto prepared = takePrepared(instance, signature, askedNow(instance, signature, request), true);
  if (!prepared) return false;
  if (signature.hasBlock()) {
    claimed_.push_back({request, *prepared});
    reply.state = RUNG_SERVICE_PENDING;
  } else {
    Answer made = answerOf(signature, request, prepared->results);
    reply = made.reply;
    keepBytes(request.ticket, std::move(made.bytes));
  }
  return true;
}

bool Requests::takeUnanswered(Instance& instance, const core::ServiceRequest& request, core::ServiceReply& reply) {
  const std::string_view name = runtime::serviceName(instance.program(), request.service);
  const nc::technol::DeviceService* service = nc::technol::findDeviceService(name);
  if (service == nullptr) return false;
  Asked asked = askedNow(instance, ServiceSignature(name), request);
  if (service->waits || service->lasts) {
    queued_.push_back(std::move(asked));
    return false;
  }
  reply.ticket = request.ticket;
  reply.resultCount = static_cast<uint32_t>(std::size(service->unanswered));
  std::ranges::copy(service->unanswered, reply.results);
  asked.complete = true;
  waiting_.push_back(std::move(asked));
  return true;
}

// With the bytes that it had when it was made.
Asked Requests::asAsked(const core::ServiceRequest& request) {
  const auto found =
      std::ranges::find_if(queued_, [&](const Asked& asked) { return asked.request.ticket == request.ticket; });
  if (found == queued_.end()) return {.request = request, .bytes = {}};
  Asked asked = std::move(*found);
  queued_.erase(found);
  return asked;
}

void Requests::take(Instance& instance) {
  for (const Claimed& claimed : claimed_)
    answer(instance, signatureOf(instance, claimed.request), claimed.request, claimed.answer.results);
  claimed_.clear();
  core::ServiceRequest request;
  while (instance.services().take(request)) {
    const ServiceSignature signature = signatureOf(instance, request);
    if (signature.takesNoAnswer()) answer(instance, signature, request, {});
    Asked asked = asAsked(request);
    const auto prepared = signature.hasBlock() ? takePrepared(instance, signature, asked, false) : std::nullopt;
    if (prepared)
      answer(instance, signature, request, prepared->results);
    else
      waiting_.push_back(std::move(asked));
  }
}

void Requests::programChanged(Instance& instance, const sim::Relocation& relocation) {
  const auto gone = [&](Asked& asked) {
    relocation.renumber(asked.request);
    const bool isGone = asked.request.service == RUNG_NONE;
    if (isGone && !asked.complete) instance.services().complete(nc::refuse(instance.program(), asked.request));
    return isGone;
  };
  for (std::vector<Asked>* list : {&waiting_, &taken_}) {
    std::vector<Asked> former;
    former.swap(*list);
    for (Asked& asked : former)
      if (!gone(asked)) list->push_back(std::move(asked));
  }
}

void Requests::clear() {
  claimed_.clear();
  queued_.clear();
  bytes_.clear();
  waiting_.clear();
  taken_.clear();
  prepared_.clear();
}

std::string Requests::expectCall(Instance& instance, const Statement& s) {
  take(instance);
  if (waiting_.empty()) return fmt::format("no request is pending; expected {}", s.name);
  Asked next = waiting_.front();
  const ServiceSignature signature = signatureOf(instance, next.request);
  std::string difference = requestDifference(signature, next, s.name, s.keys, &instance);
  if (!difference.empty()) return difference;
  waiting_.erase(waiting_.begin());
  calledOneWay_ = signature.takesNoAnswer() || next.complete;
  if (!calledOneWay_) taken_.push_back(std::move(next));
  return {};
}

std::string Requests::expectNoCall(Instance& instance, const Statement& s) {
  take(instance);
  for (const Asked& waiting : waiting_) {
    const ServiceSignature signature = signatureOf(instance, waiting.request);
    if (s.name.empty() || signature.isNamed(s.name)) return fmt::format("a request {} is pending", signature.name());
  }
  return {};
}

std::string Requests::reply(Instance& instance, const Statement& s) {
  take(instance);
  if (std::exchange(calledOneWay_, false) && s.results.empty()) return {}; // it is complete
  std::vector<Asked>& pending = taken_.empty() ? waiting_ : taken_;
  const auto next = std::ranges::find_if(pending, [&](const Asked& asked) {
    return !asked.complete && !signatureOf(instance, asked.request).takesNoAnswer();
  });
  if (next == pending.end()) return "no request is pending";
  const core::ServiceRequest request = next->request;
  const ServiceSignature signature = signatureOf(instance, request);
  std::string problem = keyProblem(signature, {}, s.results);
  if (!problem.empty()) return problem;
  pending.erase(next);
  answer(instance, signature, request, s.results);
  return {};
}

// An instruction whose operands may be left out has several signatures of its name.
std::string Requests::prepare(const Instance& instance, const Statement& s) {
  const rung_program& program = instance.program();
  std::string problem = fmt::format("this program never requests the service {}", s.name);
  for (uint32_t i = 0; i < program.service_count; ++i) {
    const ServiceSignature signature(runtime::serviceName(program, i));
    if (!signature.isNamed(s.name)) continue;
    problem = keyProblem(signature, s.keys, s.results);
    if (!problem.empty()) continue;
    prepared_.push_back({s.name, s.keys, s.results});
    return problem;
  }
  return problem;
}

} // namespace rung::scenario
