// libFuzzer target: any bytes through the ladder parser. Beside not crashing, what it returns must be consistent.
#include <cstddef>
#include <cstdint>

#include "frontend/ladder/text/ladder_file.h"
#include "ir/support/diag_render.h"

namespace {

using namespace rung;
using namespace rung::frontend::ladder;

/// The rows of some boxes, so that fuzzing reaches the grouping by names as well.
const frontend::InstructionInfo* findBox(std::string_view mnemonic) {
  using frontend::PinInfo;
  static constexpr frontend::InstructionInfo kCounter = {
      .pins = {PinInfo{.name = "CLK"}, PinInfo{.name = "U/D"}, PinInfo{.name = "R"}}};
  static constexpr frontend::InstructionInfo kPlain = {.pins = {PinInfo{.name = "EN"}}};
  if (mnemonic == "CNT") return &kCounter;
  if (mnemonic == "MOV" || mnemonic == "RET") return &kPlain;
  return nullptr;
}

void checkRung(const Rung& rung) {
  RUNG_CHECK(rung.bad || !rung.elements.empty(), "a good rung has elements");
  for (uint32_t i = 0; i < rung.elements.size(); ++i) {
    const Element& element = rung.elements[i];
    RUNG_CHECK(element.pins.count >= 1, "an element has a pin");
    RUNG_CHECK(rung.bad || element.kind != ElementKind::Error, "what cannot be read makes a rung bad");
    if (rung.bad) continue;
    for (const Pin& pin : rung.pinsOf(element)) {
      for (const ElementId driver : rung.driversOf(pin.input)) RUNG_CHECK(driver.index < i, "drivers come first");
      RUNG_CHECK(pin.input == kRail || !rung.driversOf(pin.input).empty(), "a net has a driver");
    }
    if (element.output.valid()) RUNG_CHECK(!rung.consumersOf(element.output).empty(), "a net has a consumer");
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  SourceManager sources;
  Diagnostics diags;
  const FileId file = sources.addBuffer("fuzz", std::string(reinterpret_cast<const char*>(data), size));
  const LadderFile ladder = parseLadder(sources, file, diags, findBox);
  bool anyBad = ladder.dialect.empty();
  for (const Rung& rung : ladder.rungs) {
    anyBad |= rung.bad;
    checkRung(rung);
    dumpRung(rung);
  }
  RUNG_CHECK(!anyBad || diags.hasErrors(), "whatever is bad was reported");
  renderText(diags, sources);
  renderJson(diags, sources);
  return 0;
}
