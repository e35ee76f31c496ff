// Configuration and constants (see configuration.h).
#include "sim/technol/configuration.h"

#include <algorithm>
#include <bit>

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/nc/control/technol/values.h"
#include "rtlib/nc/technol/code_page.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::sim::technol {
namespace {

// Returns the bytes of a text one at a time: its characters, or the bytes of pairs of hexadecimal digits with blanks
// between them.
class Bytes {
public:
  Bytes(std::string_view text, bool binary) : text_(text), hex_(binary && isHex(text::trimmed(text))) {
    if (hex_) text_ = text::trimmed(text);
  }
  bool next(uint8_t& byte) {
    while (hex_ && at_ < text_.size() && text_[at_] == ' ') ++at_;
    if (at_ >= text_.size()) return false;
    if (hex_) {
      byte = static_cast<uint8_t>(text::hexDigit(text_[at_]) * 16 + text::hexDigit(text_[at_ + 1]));
      at_ += 2;
    } else {
      byte = static_cast<uint8_t>(text_[at_++]);
    }
    return true;
  }

private:
  static bool isHex(std::string_view text) {
    for (size_t i = 0; i < text.size();) {
      if (text[i] == ' ') {
        ++i;
        continue;
      }
      if (i + 1 >= text.size() || text::hexDigit(text[i]) < 0 || text::hexDigit(text[i + 1]) < 0) return false;
      i += 2;
    }
    return true;
  }

  std::string_view text_;
  bool hex_;
  size_t at_ = 0;
};

// Writes the length of the whole text and the bytes of one part to the reply.
void putText(Bytes bytes, uint64_t part, core::ServiceReply& reply) {
  const uint64_t from = part * nc::kConfigurationBytes;
  uint64_t count = 0;
  for (uint8_t byte = 0; bytes.next(byte); ++count) {
    if (count < from || count - from >= nc::kConfigurationBytes) continue;
    int64_t& word = reply.results[nc::kConfigurationHead + (count - from) / 8];
    word = static_cast<int64_t>(static_cast<uint64_t>(word) | uint64_t{byte} << (count - from) % 8 * 8);
  }
  reply.results[1] = static_cast<int64_t>(count);
}

} // namespace

std::string Configuration::set(std::string_view key, std::string_view value) {
  constexpr std::string_view kConstant = "const.", kLicence = "licence.";
  if (key.starts_with(kConstant)) return setConstant(key.substr(kConstant.size()), value);
  if (key.starts_with(kLicence)) return setLicence(key.substr(kLicence.size()), value);
  parameters_.insert_or_assign(nc::memoryText(key), nc::memoryText(value));
  return {};
}

// Numbers that a file assigns explicitly are not assigned to its other constants.
std::string Configuration::define(std::span<const host::ParameterDefinition> parameters,
                                  std::span<const host::ConstantDefinition> constants) {
  for (const host::ParameterDefinition& parameter : parameters)
    parameters_.insert_or_assign(nc::memoryText(parameter.id), nc::memoryText(parameter.value));
  for (const host::ConstantDefinition& constant : constants)
    if (const auto number = nc::technol::integerOf(constant.value)) commands_.insert(*number);
  for (const host::ConstantDefinition& constant : constants)
    if (const std::string wrong = setConstant(constant.id, constant.value); !wrong.empty())
      return constant.place + ": " + wrong;
  return {};
}

// Offsets in shared area 0 and codes of commands are numbered in order of occurrence (man. l.16290-16301).
std::string Configuration::setConstant(std::string_view id, std::string_view value) {
  int64_t number = 0;
  if (value == "SA0INT") {
    number = nextOffset_;
    nextOffset_ += 4;
  } else if (value == "SA0REAL") {
    number = nextOffset_;
    nextOffset_ += 8;
  } else if (value == "PLCCOMMAND") {
    number = nextCommand();
  } else if (const auto given = nc::technol::integerOf(value)) {
    number = *given;
  } else {
    return "the constant '" + std::string(id) + "' is not a number, SA0INT, SA0REAL or PLCCOMMAND: '" +
           std::string(value) + "'";
  }
  constants_.insert_or_assign(nc::memoryText(id), number);
  commands_.insert(number);
  return {};
}

std::string Configuration::setLicence(std::string_view name, std::string_view value) {
  if (value != "0" && value != "1")
    return "licence '" + std::string(name) + "' is 0 or 1, not '" + std::string(value) + "'";
  std::string_view rest = nc::kLicences;
  for (uint32_t bit = 1; !rest.empty(); bit <<= 1) {
    const size_t end = std::min(rest.find(' '), rest.size());
    if (text::equalsIgnoringCase(name, rest.substr(0, end))) {
      licences_ = value == "1" ? licences_ | bit : licences_ & ~bit;
      return {};
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return "there is no licence '" + std::string(name) + "'; known are " + std::string(nc::kLicences);
}

int64_t Configuration::nextCommand() {
  while (commands_.contains(nextCommand_)) ++nextCommand_;
  return nextCommand_;
}

std::optional<int64_t> Configuration::constant(std::string_view id) const {
  return constantInMemory(nc::memoryText(id));
}

std::optional<int64_t> Configuration::constantInMemory(std::string_view id) const {
  const auto found = constants_.find(id);
  return found == constants_.end() ? std::nullopt : std::optional(found->second);
}

// A value of another kind than requested counts as not found.
void Configuration::respond(const core::ServiceRequest& request, core::ServiceReply& reply) const {
  char room[nc::kConfigurationBytes];
  const std::string_view id = nc::technol::charactersOf(std::span(request.args).subspan(nc::kConfigurationHead), room);
  reply.ticket = request.ticket;
  reply.state = RUNG_SERVICE_DONE;
  reply.resultCount = RUNG_MAX_SERVICE_ARGS;
  int64_t& value = reply.results[nc::kConfigurationHead];
  const auto answer = [&](bool found) { reply.results[0] = found ? 1 : 0; };
  const auto kind = static_cast<nc::ConfigurationKind>(request.args[0]);
  if (kind == nc::ConfigurationKind::Constant) {
    const auto number = constantInMemory(id);
    value = number.value_or(0);
    return answer(number.has_value());
  }
  const auto parameter = parameters_.find(id);
  if (parameter == parameters_.end()) return answer(false);
  const std::string& text = parameter->second;
  switch (kind) {
  case nc::ConfigurationKind::Integer:
  case nc::ConfigurationKind::Bit: {
    const auto number = nc::technol::integerOf(text);
    value = number.value_or(0);
    if (kind == nc::ConfigurationKind::Bit) value = value != 0 ? 1 : 0;
    return answer(number.has_value());
  }
  case nc::ConfigurationKind::Real: {
    const auto number = nc::technol::realOf(text);
    value = std::bit_cast<int64_t>(number.value_or(0));
    return answer(number.has_value());
  }
  case nc::ConfigurationKind::Text:
  case nc::ConfigurationKind::Binary:
    putText(Bytes(text, kind == nc::ConfigurationKind::Binary), static_cast<uint64_t>(request.args[1]), reply);
    return answer(true);
  case nc::ConfigurationKind::Constant: return;
  }
}

} // namespace rung::sim::technol
