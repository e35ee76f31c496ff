// See parameters.h.
#include "frontend/dialects/fanuc/read/parameters.h"

#include "frontend/dialects/fanuc/read/ladder_text.h"
#include "frontend/network/address.h"
#include "rtlib/text/blanks.h"

namespace rung::frontend::fanuc {

std::optional<Word> systemParameter(const SourceManager& sources, const MnemonicFile& file, uint32_t number) {
  std::optional<Word> found;
  const auto read = [&](const SourceLine& line) {
    const std::string_view text = text::trimmed(line.text);
    const size_t blank = text.find_first_of(" \t");
    if (found || blank == std::string_view::npos || network::parseDigits(text.substr(0, blank)) != number) return;
    const std::string_view value = text::trimmed(text.substr(blank));
    const auto at = static_cast<size_t>(value.data() - line.text.data());
    found = Word{value, line.range(at, at + value.size()), false};
  };
  if (isLadderText(sources, file.file())) {
    eachStatement(sources, file.file(), "data", [&](const Word& section, const Word& line) {
      if (section.text == kParametersCode) read({.text = line.text, .begin = {line.range.begin.value + 1}});
    });
    return found;
  }
  for (const Section& section : file.sections())
    if (section.kind == Section::Kind::Parameters) eachLine(sources, file.file(), section, read);
  return found;
}

} // namespace rung::frontend::fanuc
