// Reads the file of message texts.
#include "frontend/dialects/gsk/read/messages.h"

#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "frontend/dialects/gsk/areas.h"
#include "frontend/dialects/gsk/language.h"
#include "frontend/syntax/word_lexer.h"
#include "ir/support/diag/nct.h"
#include "ir/support/diag/operand.h"
#include "ir/support/diag/pmc.h"
#include "ir/support/diag/source.h"

namespace rung::frontend::gsk {
namespace {

constexpr uint64_t kMessages = 256;

// Message number of a bit in A (P57).
constexpr uint64_t messageOf(uint64_t byte, uint64_t bit) { return 8 * byte + bit + 1; }

// Message number, written as a number or as its bit; nullopt for anything else.
std::optional<uint64_t> numberOf(std::string_view text) {
  if (const auto number = network::parseDigits(text)) return number;
  const auto split = network::splitAddress(kLanguage, text);
  if (!split || split->area != areas::kA || split->bit.size() != 1) return std::nullopt;
  if (split->bit[0] < '0' || split->bit[0] > '7') return std::nullopt;
  return messageOf(split->byte, static_cast<uint64_t>(split->bit[0] - '0'));
}

class MessageReader {
public:
  explicit MessageReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void line(const LineWords& line) {
    const std::vector<Word>& words = line.words;
    if (words.empty()) return;
    const auto number = words[0].quoted ? std::nullopt : numberOf(words[0].text);
    if (!number)
      bad(words[0], fmt::format("found '{}' in place of the number", words[0].text));
    else if (words.size() == 1)
      bad(words[0], "the text is missing");
    else if (!words[1].quoted)
      bad(words[1], fmt::format("'{}' has no quotation marks", words[1].text));
    else if (line.unterminatedQuote)
      bad(words.back(), "the closing quotation mark is missing");
    else if (words.size() > 2)
      bad(words[2], fmt::format("'{}' follows the text", words[2].text));
    else
      add(words[0], *number, words[1].text);
  }

  std::vector<ir::MessageText> result() const {
    std::vector<ir::MessageText> list;
    for (const auto& [number, entry] : texts_) list.push_back({number, std::string(entry.text)});
    return list;
  }

private:
  struct Entry {
    std::string_view text;
    SourceRange range;
  };

  void bad(const Word& at, std::string_view what) { diagnostics_.report(diag::BadMessage, at.range) << what; }

  void add(const Word& word, uint64_t number, std::string_view text) {
    if (number < 1 || number > kMessages) {
      diagnostics_.report(diag::ConstantOutOfRange, word.range)
          << word.text << fmt::format("1 to {} (A0.0 to A31.7)", kMessages);
      return;
    }
    const auto [at, isNew] = texts_.emplace(static_cast<uint32_t>(number), Entry{text, word.range});
    if (!isNew)
      diagnostics_.report(diag::DuplicateSymbol, word.range).note(at->second.range, "the first one is here")
          << fmt::format("message {}", word.text);
  }

  Diagnostics& diagnostics_;
  std::map<uint32_t, Entry> texts_;
};

} // namespace

std::vector<ir::MessageText> readMessages(SourceManager& sources, FileId program, std::string_view path,
                                          Diagnostics& diagnostics) {
  const std::filesystem::path folder = std::filesystem::path(sources.name(program)).parent_path();
  const std::string name = (folder / path).lexically_normal().string();
  const Result<FileId> file = sources.addFile(name);
  if (!file.ok()) {
    diagnostics.report(diag::FileNotFound) << name << file.error();
    return {};
  }
  if (!checkEncoding(sources, file.value(), diagnostics)) return {};
  MessageReader reader(diagnostics);
  LineReader lines(sources, file.value());
  SourceLine line;
  LineWords words;
  while (lines.next(line)) {
    splitWords(line, {}, words);
    reader.line(words);
  }
  return reader.result();
}

void checkTexts(const network::Program& program, const std::vector<ir::MessageText>& texts, Diagnostics& diagnostics) {
  std::set<uint64_t> known;
  for (const ir::MessageText& text : texts) known.insert(text.number);
  for (const network::Unit& unit : program.units)
    for (const network::Network& network : unit.networks)
      for (const network::CoilStep& coil : network.coils) {
        if (coil.bit.area != areas::kA || coil.kind == network::Coil::Reset) continue;
        const uint64_t number = messageOf(coil.bit.byte, coil.bit.bit);
        if (known.insert(number).second) diagnostics.report(diag::MessageWithoutText, coil.range) << number;
      }
}

} // namespace rung::frontend::gsk
