// See messages.h.
#include "frontend/dialects/fanuc/read/messages.h"

#include <map>
#include <optional>

#include <fmt/format.h>

#include "frontend/dialects/fanuc/areas.h"
#include "frontend/dialects/fanuc/language.h"
#include "frontend/network/address.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "rtlib/text/blanks.h"
#include "rtlib/text/letters.h"

namespace rung::frontend::fanuc {
namespace {

// A0.1; nothing for anything else.
std::optional<uint32_t> bitOf(std::string_view text) {
  const auto address = network::parseAddress(languageOf(Pmc::MemD), text);
  if (!address || address->area != areas::kA || !address->isBit || address->byte >= kMessageState) return std::nullopt;
  return 8 * address->byte + address->bit;
}

// The number at the beginning of a text, which is then without it: 1000, AL1+000 (1000 + n) or OP1+000 (2000 + n).
std::optional<uint32_t> takeNumber(std::string_view& text) {
  const std::string upper = text::upper(text.substr(0, 4));
  const bool isAlarm = upper.starts_with("AL"), isOperator = upper.starts_with("OP");
  std::string_view rest = text;
  uint32_t base = 0;
  if ((isAlarm || isOperator) && upper.size() == 4 && text::isDigit(upper[2]) && upper[3] == '+') {
    base = isAlarm ? 1000 : 2000;
    rest.remove_prefix(4);
  }
  const size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
  const auto number = network::parseDigits(rest.substr(0, digits));
  if (!number || *number > 9999) return std::nullopt;
  rest.remove_prefix(digits);
  text = text::trimmed(rest.starts_with('=') ? rest.substr(1) : rest);
  return base + static_cast<uint32_t>(*number);
}

} // namespace

std::vector<Message> readMessages(const network::Language& language, const SourceManager& sources,
                                  const MnemonicFiles& files, Diagnostics& diagnostics) {
  std::vector<Message> messages;
  std::map<uint32_t, SourceRange> seen;
  const auto line = [&](const SourceLine& line) {
    std::string_view text = text::trimmed(line.text);
    if (text.empty() || text[0] == ';') return;
    const auto at = static_cast<size_t>(text.data() - line.text.data());
    const SourceRange range = line.range(at, at + text.size());
    const size_t blank = std::min(text.find_first_of(" \t"), text.size());
    const std::optional<uint32_t> bit = bitOf(text.substr(0, blank));
    if (!bit) {
      diagnostics.report(diag::BadListedMessage, range)
          << fmt::format("found '{}' in place of the bit of A", text.substr(0, blank));
      return;
    }
    if (language.at(areas::kA).room(*bit / 8) == 0) {
      diagnostics.report(diag::AddressOutOfRange, range)
          << text.substr(0, blank) << network::bytesText(language.at(areas::kA));
      return;
    }
    text = text::trimmed(text.substr(blank));
    const std::optional<uint32_t> number = takeNumber(text);
    if (!number) {
      diagnostics.report(diag::BadListedMessage, range) << fmt::format("found '{}' in place of the number", text);
      return;
    }
    const auto [first, isNew] = seen.emplace(*bit, range);
    if (!isNew)
      diagnostics.report(diag::DuplicateSymbol, range).note(first->second, "the first one is here")
          << fmt::format("the message of A{}.{}", *bit / 8, *bit % 8);
    else
      messages.push_back({*bit, *number, text, range});
  };
  for (const auto& file : files)
    for (const Section& section : file->sections())
      if (section.kind == Section::Kind::Messages) eachLine(sources, file->file(), section, line);
  return messages;
}

} // namespace rung::frontend::fanuc
