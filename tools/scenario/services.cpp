// Requests to services (see services.h).
#include "tools/scenario/services.h"

#include <algorithm>
#include <array>
#include <bit>
#include <fmt/format.h>
#include <optional>
#include <sstream>

#include "rtlib/host/program_info.h"
#include "rtlib/nc/nct/operand_block.h"
#include "rtlib/nc/nct/scope_symbols.h"
#include "rtlib/text/letters.h"
#include "rtlib/text/number.h"
#include "tools/scenario/values.h"

namespace rung::scenario {

using host::Instance;

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

// The buffer of a request, read from and written to the memory of the program.
class Buffer {
public:
  Buffer(const Instance& instance, const ServiceSignature& signature, const rt::ServiceRequest& request)
      : space_(host::findSpace(instance.program(), nc::nct::kBlockSpace)),
        first_(static_cast<uint32_t>(request.args[signature.argument("block")])) {
    for (uint32_t i = 0; i < words_.size(); ++i) words_[i] = static_cast<uint32_t>(instance.read(place(i)));
  }
  nc::nct::Block block() { return nc::nct::Block(words_); }
  void writeTo(Instance& instance) const {
    for (uint32_t i = 0; i < words_.size(); ++i) host::writeRaw(instance.memory(), place(i), words_[i]);
  }

private:
  host::Ref place(uint32_t word) const { return host::intRef(space_, (first_ + word) * 4, 32); }

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
  if (key.value.kind == ValueKind::Int && static_cast<uint32_t>(found) == static_cast<uint32_t>(key.value.integer))
    return {};
  return fmt::format("{}: {} is {} (0x{:X}), expected {}", signature.name(), key.key, found,
                     static_cast<uint32_t>(found), key.value.text);
}

// ---- arguments -----------------------------------------------------------------------------------------------------

// Bits of an argument that count.
uint64_t maskOf(const ServiceSignature& signature, const rt::ServiceRequest& request, std::string_view key) {
  const int length = signature.argument("length");
  if (length < 0 || static_cast<uint32_t>(length) >= request.argCount || !text::equalsIgnoringCase(key, "data"))
    return UINT64_MAX;
  const int64_t bytes = request.args[length];
  return bytes > 0 && bytes < 8 ? (uint64_t{1} << (8 * bytes)) - 1 : UINT64_MAX;
}

// A quantity of SCP goes by its name: the argument `symbol` is its index.
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

std::string argumentDifference(const ServiceSignature& signature, const rt::ServiceRequest& request, int index,
                               const KeyValue& key) {
  const int64_t found = request.args[index];
  if (isScopeName(signature, key)) return scopeDifference(signature, found, key);
  if (signature.isRealArgument(index)) {
    const double real = std::bit_cast<double>(found);
    return real == key.value.real && key.value.kind != ValueKind::Text
               ? std::string()
               : fmt::format("{}: {} is {}, expected {}", signature.name(), key.key, real, key.value.text);
  }
  const uint64_t difference = static_cast<uint64_t>(found) ^ static_cast<uint64_t>(rawOf(key.value));
  return (difference & maskOf(signature, request, key.key)) == 0
             ? std::string()
             : fmt::format("{}: {} is {}, expected {}", signature.name(), key.key, found, key.value.text);
}

std::string unknownArgument(const ServiceSignature& signature, std::string_view key) {
  return fmt::format("{} has no argument '{}': it has {}", signature.name(), key, signature.argumentNames());
}

} // namespace

// ---- signatures ----------------------------------------------------------------------------------------------------

ServiceSignature::ServiceSignature(std::string_view text) {
  std::istringstream in{std::string(text)};
  in >> name_;
  for (std::string word; in >> word;) {
    if (word == "->") {
      takesNoAnswer_ = false;
      continue;
    }
    const bool isReal = word.ends_with(":f");
    if (isReal) word.resize(word.size() - 2);
    (takesNoAnswer_ ? arguments_ : results_).push_back({word, isReal});
  }
}

bool ServiceSignature::isNamed(std::string_view name) const { return text::equalsIgnoringCase(name_, name); }
int ServiceSignature::argument(std::string_view key) const { return indexOf(arguments_, key); }
int ServiceSignature::result(std::string_view key) const { return indexOf(results_, key); }

int ServiceSignature::indexOf(const std::vector<Name>& names, std::string_view key) {
  for (size_t i = 0; i < names.size(); ++i)
    if (text::equalsIgnoringCase(names[i].text, key)) return static_cast<int>(i);
  return -1;
}

std::string ServiceSignature::namesOf(const std::vector<Name>& names) const {
  std::string all;
  const auto add = [&](std::string_view name) {
    if (!all.empty()) all += ", ";
    all += name;
  };
  for (const Name& name : names)
    if (name.text != "block") add(name.text);
  if (hasBlock()) add("wN, dN");
  return all;
}
std::string ServiceSignature::argumentNames() const { return namesOf(arguments_); }
std::string ServiceSignature::resultNames() const {
  const std::string names = namesOf(results_);
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
    if (word && !word->isReal && key.value.kind != ValueKind::Int)
      return fmt::format("{} is one word: expected an integer, not {}", key.key, key.value.text);
  }
  return {};
}

// ---- requests and replies ------------------------------------------------------------------------------------------

std::string requestDifference(const ServiceSignature& signature, const rt::ServiceRequest& request,
                              std::string_view service, const std::vector<KeyValue>& keys, const Instance* instance) {
  if (!signature.isNamed(service)) return fmt::format("the next request is {}, expected {}", signature.name(), service);
  std::optional<Buffer> buffer;
  for (const KeyValue& key : keys) {
    std::string difference;
    const int index = signature.argument(key.key);
    const std::optional<BlockKey> word = blockKey(signature, key.key);
    if (index >= 0 && static_cast<uint32_t>(index) < request.argCount) {
      difference = argumentDifference(signature, request, index, key);
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

rt::ServiceReply replyOf(const ServiceSignature& signature, uint32_t ticket, const std::vector<KeyValue>& results) {
  rt::ServiceReply reply;
  reply.ticket = ticket;
  for (const KeyValue& key : results) {
    if (key.key == "error") {
      if (key.value.integer != 0) reply.state = RUNG_SERVICE_ERROR;
      continue;
    }
    const int index = signature.result(key.key);
    if (index < 0 || index >= static_cast<int>(RUNG_MAX_SERVICE_ARGS)) continue;
    reply.results[index] = signature.isRealResult(index) ? std::bit_cast<int64_t>(key.value.real) : rawOf(key.value);
    reply.resultCount = std::max(reply.resultCount, static_cast<uint32_t>(index) + 1);
  }
  return reply;
}

void answerBlock(Instance& instance, const ServiceSignature& signature, const rt::ServiceRequest& request,
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
