// Requests to services and their answers.
#include "tools/scenario/requests.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <utility>

#include "rtlib/load/program_info.h"
#include "rtlib/nc/control/control.h"
#include "rtlib/nc/nct/operand_block.h"
#include "rtlib/nc/nct/scope_symbols.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/text/hex.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "tools/scenario/values.h"

namespace rung::scenario {

using nc::technol::DeviceService;
using runtime::Instance;

nc::ServiceRow serviceRow(const rung_program& program, uint32_t service) {
  const char* text = program.services[service];
  const nc::ServiceRow* row = nc::serviceOf(program.dialect, nc::serviceKind(program.dialect, text));
  return row != nullptr ? *row : nc::ServiceRow(nc::kUnknownService, text);
}

namespace {

ServiceSignature signatureOf(const Instance& instance, const core::ServiceRequest& request) {
  const nc::ServiceRow* row = nc::serviceOf(instance.program().dialect, request.name->kind);
  return ServiceSignature(row != nullptr ? *row : nc::ServiceRow(nc::kUnknownService, request.name->text));
}

// Null: the request is not to a device.
const DeviceService* deviceServiceOf(const Instance& instance, const core::ServiceRequest& request) {
  return nc::technol::deviceServiceOf(instance.program().dialect, request.name->kind);
}

bool fetchesBytes(const Instance& instance, const core::ServiceRequest& request) {
  const DeviceService* asked = deviceServiceOf(instance, request);
  return asked != nullptr && asked->device == nc::technol::Device::Bytes;
}

constexpr size_t kMostKept = core::ServiceQueue::kRecords; // most answers whose bytes are stored

} // namespace

// Removes and returns the answer prepared for the request; nothing if there is none. While a task runs, its memory must
// not be read: then only answers that compare no word of the block are considered.
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
  if (!bytes_.empty() && fetchesBytes(instance, request)) {
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
  const DeviceService* service = deviceServiceOf(instance, request);
  if (service == nullptr) return false;
  Asked asked = askedNow(instance, ServiceSignature(service->service), request);
  if (service->answer.waits || service->answer.lasts) {
    queued_.push_back(std::move(asked));
    return false;
  }
  reply.ticket = request.ticket;
  reply.resultCount = static_cast<uint32_t>(std::size(service->answer.unanswered));
  std::ranges::copy(service->answer.unanswered, reply.results);
  asked.complete = true;
  waiting_.push_back(std::move(asked));
  return true;
}

// The request with the bytes that it had when it was made.
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
    if (isGone && !asked.complete)
      instance.services().complete({.ticket = asked.request.ticket, .state = RUNG_SERVICE_ERROR});
    return isGone;
  };
  for (std::vector<Asked>* list : {&waiting_, &taken_}) {
    std::vector<Asked> former;
    former.swap(*list);
    for (Asked& asked : former)
      if (!gone(asked)) list->push_back(std::move(asked));
  }
}

void Requests::restore(const Instance& instance, const Requests& saved) {
  *this = saved;
  const core::ServiceQueue& services = instance.services();
  for (Claimed& claimed : claimed_) services.setName(claimed.request);
  for (std::vector<Asked>* list : {&queued_, &waiting_, &taken_})
    for (Asked& asked : *list) services.setName(asked.request);
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

// An instruction with optional operands has several signatures of the same name.
std::string Requests::prepare(const Instance& instance, const Statement& s) {
  const rung_program& program = instance.program();
  std::string problem = fmt::format("this program never requests the service {}", s.name);
  for (uint32_t i = 0; i < program.service_count; ++i) {
    const ServiceSignature signature(serviceRow(program, i));
    if (!signature.isNamed(s.name)) continue;
    problem = keyProblem(signature, s.keys, s.results);
    if (!problem.empty()) continue;
    prepared_.push_back({s.name, s.keys, s.results});
    return problem;
  }
  return problem;
}

// Requests to services.

using runtime::Instance;
using Form = nc::ServiceForm;

namespace {

int64_t rawOf(const Value& value) {
  return value.kind == ValueKind::Real ? std::bit_cast<int64_t>(value.real) : value.integer;
}

// ---- words of operand blocks ---------------------------------------------------------------------------------------

struct BlockKey {
  uint32_t word = 0;
  bool isReal = false;
};

// "w4" and "d4".
std::optional<BlockKey> blockKey(const ServiceSignature& signature, std::string_view key) {
  if (!signature.hasBlock() || key.size() < 2 || (text::lower(key[0]) != 'w' && text::lower(key[0]) != 'd'))
    return std::nullopt;
  BlockKey parsed{.isReal = text::lower(key[0]) == 'd'};
  parsed.word = text::numberIn<uint32_t>(key.substr(1)).value_or(0);
  const uint32_t last = parsed.isReal ? nc::nct::kBlockWords - 2 : nc::nct::kBlockWords - 1;
  return parsed.word >= 1 && parsed.word <= last ? std::optional(parsed) : std::nullopt;
}

// The operand block of a request, read and written in the program's memory.
class Buffer {
public:
  Buffer(const Instance& instance, const ServiceSignature& signature, const core::ServiceRequest& request)
      : space_(runtime::findSpace(instance.program(), nc::nct::kBlockSpace)),
        first_(static_cast<uint32_t>(request.args[signature.argument("block")])) {
    for (uint32_t i = 0; i < words_.size(); ++i) words_[i] = static_cast<uint32_t>(instance.read(place(i)));
  }
  nc::nct::Block block() { return nc::nct::Block(words_); }
  void writeTo(Instance& instance) const {
    for (uint32_t i = 0; i < words_.size(); ++i) runtime::writeRaw(instance.memory(), place(i), words_[i]);
  }

private:
  runtime::Ref place(uint32_t word) const { return runtime::intRef(space_, (first_ + word) * 4, 32); }

  uint32_t space_;
  uint32_t first_;
  std::array<uint32_t, nc::nct::kBlockStride> words_{};
};

std::string blockDifference(const ServiceSignature& signature, nc::nct::Block block, BlockKey at, const KeyValue& key) {
  if (at.isReal) {
    const double found = block.real(at.word);
    return found == key.value.real
               ? std::string()
               : fmt::format("{}: {} is {}, expected {}", signature.name(), key.key, found, key.value.text);
  }
  const int32_t found = block.word(at.word);
  if (text::fitsBits(key.value.number, 32) && static_cast<uint32_t>(found) == static_cast<uint32_t>(key.value.integer))
    return {};
  return fmt::format("{}: {} is {} (0x{:X}), expected {}", signature.name(), key.key, found,
                     static_cast<uint32_t>(found), key.value.text);
}

// ---- arguments -----------------------------------------------------------------------------------------------------

// The bits of an argument that are compared.
uint64_t maskOf(const ServiceSignature& signature, const core::ServiceRequest& request, std::string_view key) {
  const int length = signature.argument("length");
  if (length < 0 || static_cast<uint32_t>(length) >= request.argCount || !text::equalsIgnoringCase(key, "data"))
    return UINT64_MAX;
  const int64_t bytes = request.args[length];
  return bytes > 0 && bytes < 8 ? (uint64_t{1} << (8 * bytes)) - 1 : UINT64_MAX;
}

// A quantity of SCP is identified by its name: the argument `symbol` is its index.
bool isScopeName(const ServiceSignature& signature, const KeyValue& key) {
  return key.value.kind == ValueKind::Text && text::equalsIgnoringCase(key.key, "symbol") && signature.isNamed("SCP");
}

std::string scopeDifference(const ServiceSignature& signature, int64_t found, const KeyValue& key) {
  const auto wanted = nc::nct::findScopeSymbol(key.value.text);
  if (!wanted) return fmt::format("'{}' is not a symbol of SCP", key.value.text);
  if (found == *wanted) return {};
  const auto symbols = nc::nct::scopeSymbols();
  const bool known = found >= 0 && static_cast<size_t>(found) < symbols.size();
  return fmt::format("{}: symbol is {}, expected {}", signature.name(),
                     known ? symbols[static_cast<size_t>(found)].name : "unknown", key.value.text);
}

// The number that a word of a program means.
int64_t wantedOf(const Value& value) {
  const auto word = value.kind == ValueKind::Text ? nc::technol::deviceWord(value.text) : std::nullopt;
  return word.value_or(rawOf(value));
}

// A number is compared with as many bytes as there are.
std::string bytesDifference(const ServiceSignature& signature, std::string_view found, const KeyValue& key) {
  auto wanted = bytesOf(key.value, text::equalsIgnoringCase(key.key, "data"));
  if (wanted && key.value.kind != ValueKind::Text) wanted->resize(std::min(wanted->size(), found.size()));
  return wanted == found ? std::string()
                         : fmt::format("{}: {} is {} (\"{}\"), expected {}", signature.name(), key.key,
                                       text::hexInPairs(found), nc::shownText(found), key.value.text);
}

std::string argumentDifference(const ServiceSignature& signature, const Asked& asked, int index, const KeyValue& key) {
  const core::ServiceRequest& request = asked.request;
  const int64_t found = request.args[index];
  if (isScopeName(signature, key)) return scopeDifference(signature, found, key);
  const Form form = signature.formOfArgument(index);
  if (form == Form::Text || form == Form::Bytes)
    return bytesDifference(
        signature, static_cast<size_t>(index) < asked.bytes.size() ? asked.bytes[static_cast<size_t>(index)] : "", key);
  if (form == Form::Real) {
    const double real = std::bit_cast<double>(found);
    return real == key.value.real && key.value.kind != ValueKind::Text
               ? std::string()
               : fmt::format("{}: {} is {}, expected {}", signature.name(), key.key, real, key.value.text);
  }
  if (found == nc::technol::kNotGiven)
    return fmt::format("{}: {} is not given, expected {}", signature.name(), key.key, key.value.text);
  const uint64_t difference = static_cast<uint64_t>(found) ^ static_cast<uint64_t>(wantedOf(key.value));
  return (difference & maskOf(signature, request, key.key)) == 0
             ? std::string()
             : fmt::format("{}: {} is {}, expected {}", signature.name(), key.key, found, key.value.text);
}

std::string unknownArgument(const ServiceSignature& signature, std::string_view key) {
  return fmt::format("{} has no argument '{}': it has {}", signature.name(), key, signature.argumentNames());
}

} // namespace

// ---- signatures ----------------------------------------------------------------------------------------------------

bool ServiceSignature::isNamed(std::string_view name) const { return text::equalsIgnoringCase(row_.name, name); }

int ServiceSignature::indexOf(const nc::ServiceValues& values, std::string_view key) {
  for (uint32_t i = 0; i < values.count(); ++i)
    if (text::equalsIgnoringCase(values[i].name, key)) return static_cast<int>(i);
  return text::equalsIgnoringCase(key, "data") || text::equalsIgnoringCase(key, "Val") ? dataOf(values) : -1;
}

int ServiceSignature::dataOf(const nc::ServiceValues& values) {
  for (uint32_t i = 0; i < values.count(); ++i)
    if (values[i].form == Form::Text || values[i].form == Form::Bytes) return static_cast<int>(i);
  return -1;
}

std::string ServiceSignature::namesOf(const nc::ServiceValues& values) const {
  std::string all;
  const auto add = [&](std::string_view name) {
    if (!all.empty()) all += ", ";
    all += name;
  };
  for (uint32_t i = 0; i < values.count(); ++i)
    if (values[i].name != "block") add(values[i].name);
  if (hasBlock()) add("wN, dN");
  return all;
}
std::string ServiceSignature::resultNames() const {
  const std::string names = namesOf(row_.results);
  return names.empty() ? "error" : names + ", error";
}

bool namesWords(const ServiceSignature& signature, const std::vector<KeyValue>& keys) {
  return std::ranges::any_of(
      keys, [&](const KeyValue& key) { return signature.argument(key.key) < 0 && blockKey(signature, key.key); });
}

std::string keyProblem(const ServiceSignature& signature, const std::vector<KeyValue>& arguments,
                       const std::vector<KeyValue>& results) {
  for (const KeyValue& key : arguments) {
    if (signature.argument(key.key) < 0 && !blockKey(signature, key.key)) return unknownArgument(signature, key.key);
    if (isScopeName(signature, key) && !nc::nct::findScopeSymbol(key.value.text))
      return fmt::format("'{}' is not a symbol of SCP", key.value.text);
  }
  for (const KeyValue& key : results) {
    const std::optional<BlockKey> word = blockKey(signature, key.key);
    if (key.key != "error" && signature.result(key.key) < 0 && !word)
      return fmt::format("{} has no result '{}': it has {}", signature.name(), key.key, signature.resultNames());
    if (word && !word->isReal && !text::fitsBits(key.value.number, 32))
      return fmt::format("{} is one word: expected an integer of 32 bits, not {}", key.key, key.value.text);
  }
  return {};
}

// ---- requests and replies ------------------------------------------------------------------------------------------

Asked askedNow(const Instance& instance, const ServiceSignature& signature, const core::ServiceRequest& request) {
  Asked asked{.request = request, .bytes = {}};
  for (int i = 0; i < signature.argumentCount(); ++i) {
    const Form form = signature.formOfArgument(i);
    if (form != Form::Text && form != Form::Bytes) continue;
    asked.bytes.resize(static_cast<size_t>(i) + 1);
    asked.bytes.back() = bytesAt(instance, request.args[i], form == Form::Text);
  }
  return asked;
}

std::string requestDifference(const ServiceSignature& signature, const Asked& asked, std::string_view service,
                              const std::vector<KeyValue>& keys, const Instance* instance) {
  const core::ServiceRequest& request = asked.request;
  if (!signature.isNamed(service)) return fmt::format("the next request is {}, expected {}", signature.name(), service);
  std::optional<Buffer> buffer;
  for (const KeyValue& key : keys) {
    std::string difference;
    const int index = signature.argument(key.key);
    const std::optional<BlockKey> word = blockKey(signature, key.key);
    if (index >= 0 && static_cast<uint32_t>(index) < request.argCount) {
      difference = argumentDifference(signature, asked, index, key);
    } else if (word && instance != nullptr) {
      if (!buffer) buffer.emplace(*instance, signature, request);
      difference = blockDifference(signature, buffer->block(), *word, key);
    } else {
      difference = unknownArgument(signature, key.key);
    }
    if (!difference.empty()) return difference;
  }
  return {};
}

namespace {

void setResult(core::ServiceReply& reply, int index, int64_t value) {
  if (index < 0 || index >= static_cast<int>(RUNG_MAX_SERVICE_ARGS)) return;
  reply.results[index] = value;
  reply.resultCount = std::max(reply.resultCount, static_cast<uint32_t>(index) + 1);
}

int64_t argumentOr(const ServiceSignature& signature, const core::ServiceRequest& request, std::string_view name,
                   int64_t otherwise) {
  const int index = signature.argument(name);
  return index < 0 || static_cast<uint32_t>(index) >= request.argCount ? otherwise : request.args[index];
}

// At most the requested number of bytes.
void setBytes(const ServiceSignature& signature, const core::ServiceRequest& request, const KeyValue& key,
              Answer& answer) {
  answer.bytes = bytesOf(key.value, text::equalsIgnoringCase(key.key, "data")).value_or("");
  const auto most = static_cast<uint64_t>(argumentOr(signature, request, "Len", INT64_MAX));
  if (answer.bytes.size() > most) answer.bytes.resize(most);
  setResult(answer.reply, signature.dataResult(), static_cast<int64_t>(answer.bytes.size()));
}

// Properties of the answer that the scenario does not give.
void setLengths(const ServiceSignature& signature, const core::ServiceRequest& request, Answer& answer) {
  const auto size = static_cast<int64_t>(answer.bytes.size());
  setResult(answer.reply, signature.result("Len"),
            signature.dataResult() >= 0 ? size : argumentOr(signature, request, "Len", 0));
  setResult(answer.reply, signature.result("ElemFl"), argumentOr(signature, request, "ElemFl", 0));
}

} // namespace

Answer answerOf(const ServiceSignature& signature, const core::ServiceRequest& request,
                const std::vector<KeyValue>& results) {
  Answer answer;
  answer.reply.ticket = request.ticket;
  for (const KeyValue& key : results)
    if (const int index = signature.result(key.key); index >= 0 && index == signature.dataResult())
      setBytes(signature, request, key, answer);
  setLengths(signature, request, answer);
  for (const KeyValue& key : results) {
    const int index = signature.result(key.key);
    if (key.key == "error")
      answer.reply.state = key.value.integer != 0 ? uint32_t{RUNG_SERVICE_ERROR} : answer.reply.state;
    else if (index >= 0 && index != signature.dataResult())
      setResult(answer.reply, index,
                signature.formOfResult(index) == Form::Real ? std::bit_cast<int64_t>(key.value.real)
                                                            : rawOf(key.value));
  }
  return answer;
}

void answerBlock(Instance& instance, const ServiceSignature& signature, const core::ServiceRequest& request,
                 const std::vector<KeyValue>& results) {
  if (!signature.hasBlock()) return;
  Buffer buffer(instance, signature, request);
  nc::nct::Block block = buffer.block();
  for (const KeyValue& key : results) {
    const std::optional<BlockKey> word = blockKey(signature, key.key);
    if (!word) continue;
    if (word->isReal)
      block.setReal(word->word, key.value.real);
    else
      block.setWord(word->word, static_cast<int32_t>(key.value.integer));
  }
  buffer.writeTo(instance);
}

} // namespace rung::scenario
