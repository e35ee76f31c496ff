// See messages.h.
#include "frontend/dialects/fanuc/read/messages.h"

#include <map>
#include <optional>

#include <fmt/format.h>

#include "frontend/dialects/fanuc/areas.h"
#include "frontend/dialects/fanuc/language.h"
#include "frontend/dialects/fanuc/read/ladder_text.h"
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

std::string notA(std::string_view text, std::string_view expected) {
  return text.empty() ? fmt::format("{} is missing", expected)
                      : fmt::format("found '{}' in place of {}", text, expected);
}

class MessageReader {
public:
  MessageReader(const network::Language& language, Diagnostics& diagnostics)
      : language_(language), diagnostics_(diagnostics) {}

  void add(const Word& place, const Word& line) {
    const SourceRange range = join(place.range, line.range);
    const network::AreaInfo& area = language_.at(areas::kA);
    const std::optional<uint32_t> bit = bitOf(place.text);
    if (!bit) {
      diagnostics_.report(diag::BadListedMessage, range) << notA(place.text, "the bit of A");
      return;
    }
    if (area.room(*bit / 8) == 0) {
      diagnostics_.report(diag::AddressOutOfRange, range) << place.text << network::bytesText(area);
      return;
    }
    std::string_view text = text::trimmed(line.text);
    const std::optional<uint32_t> number = takeNumber(text);
    if (!number) {
      diagnostics_.report(diag::BadListedMessage, range) << notA(text, "the number");
      return;
    }
    const auto [first, isNew] = seen_.emplace(*bit, range);
    if (!isNew)
      diagnostics_.report(diag::DuplicateSymbol, range).note(first->second, "the first one is here")
          << fmt::format("the message of A{}.{}", *bit / 8, *bit % 8);
    else
      messages_.push_back({*bit, *number, text, range});
  }
  std::vector<Message> take() { return std::move(messages_); }

private:
  const network::Language& language_;
  Diagnostics& diagnostics_;
  std::vector<Message> messages_;
  std::map<uint32_t, SourceRange> seen_;
};

} // namespace

std::optional<MessageLine> messageIn(const SourceLine& line) {
  const std::string_view text = text::trimmed(line.text);
  if (text.empty() || text[0] == ';') return std::nullopt;
  const auto wordOf = [&](std::string_view part) {
    const auto at = static_cast<size_t>(part.data() - line.text.data());
    return Word{part, line.range(at, at + part.size()), false};
  };
  const size_t blank = std::min(text.find_first_of(" \t"), text.size());
  const size_t rest = std::min(text.find_first_not_of(" \t", blank), text.size()); // a line of one word has no text
  return MessageLine{wordOf(text.substr(0, blank)), wordOf(text.substr(rest))};
}

std::vector<Message> readMessages(const network::Language& language, const SourceManager& sources,
                                  const MnemonicFiles& files, Diagnostics& diagnostics) {
  MessageReader reader(language, diagnostics);
  const auto read = [&](const SourceLine& line) {
    if (const auto message = messageIn(line)) reader.add(message->place, message->text);
  };
  for (const auto& file : files) {
    if (isLadderText(sources, file->file())) {
      eachStatement(sources, file->file(), "message",
                    [&](const Word& place, const Word& text) { reader.add(place, text); });
      continue;
    }
    for (const Section& section : file->sections())
      if (section.kind == Section::Kind::Messages) eachLine(sources, file->file(), section, read);
  }
  return reader.take();
}

} // namespace rung::frontend::fanuc
