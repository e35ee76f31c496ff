// What the tests of ladder text share: parse a text, look at rungs and diagnostics.
#pragma once

#include <string>
#include <utility>

#include "frontend/ladder/text/ladder_file.h"

namespace rung::frontend::ladder {

/// The rows of a few boxes, in the manner of a dialect's table.
inline const frontend::InstructionInfo* testBox(std::string_view mnemonic) {
  using frontend::PinInfo;
  static constexpr frontend::InstructionInfo kCounter = {
      .pins = {PinInfo{.name = "CLK"}, PinInfo{.name = "U/D"}, PinInfo{.name = "R"}}};
  static constexpr frontend::InstructionInfo kPlain = {.pins = {PinInfo{.name = "EN"}}};
  if (mnemonic == "CNT") return &kCounter;
  if (mnemonic == "MOV" || mnemonic == "RET" || mnemonic == "END" || mnemonic == "TOND") return &kPlain;
  return nullptr;
}

/// A parsed text; the views in `ladder` look into `sources`.
struct Parsed {
  SourceManager sources;
  Diagnostics diags;
  LadderFile ladder;

  explicit Parsed(std::string text, FindBox findBox = testBox) {
    const FileId file = sources.addBuffer("t.lad", std::move(text));
    ladder = parseLadder(sources, file, diags, findBox);
  }

  /// One diagnostic a line: "3:5 unclosed-element".
  std::string errors() const {
    std::string text;
    for (const Diagnostic* d : diags.sorted()) {
      const LineCol at = sources.lineCol(d->range.begin);
      text +=
          std::to_string(at.line) + ":" + std::to_string(at.column) + " " + std::string(diagInfo(d->id).code) + "\n";
    }
    return text;
  }
};

/// The drawing as the only rung of a file; it begins in line 4.
inline Parsed parseDrawing(const std::string& drawing, FindBox findBox = testBox) {
  return Parsed("dialect test\nmodule MAIN\nrung\n" + drawing, findBox);
}

/// Elements and nets of a drawing, without the heading; the diagnostics when it is bad.
inline std::string elementsOf(const std::string& drawing, FindBox findBox = testBox) {
  const Parsed parsed = parseDrawing(drawing, findBox);
  if (!parsed.errors().empty()) return parsed.errors();
  const std::string dump = dumpRung(parsed.ladder.rungs.at(0));
  return dump.substr(dump.find('\n') + 1);
}

} // namespace rung::frontend::ladder
