// libFuzzer target: any bytes as a GSK program, a command list or, beginning with "dialect gsk", ladder text. What
// compiles converts to both forms and back; the conversion itself looks that it made the same program.
#include <cstddef>
#include <cstdint>
#include <string>

#include "frontend/dialects/gsk/gsk.h"
#include "frontend/dialects/gsk/language.h"
#include "frontend/network/convert/convert.h"
#include "ir/support/check.h"
#include "ir/support/diag_render.h"
#include "ir/verify/verify.h"

namespace {

using namespace rung;
using frontend::network::Form;

constexpr size_t kMaxDrawn = 20'000; // of a list: branches are as wide as what they span

std::string nameOf(Form form) { return form == Form::List ? "fuzz.pmc" : "fuzz.lad"; }

std::string convert(const std::string& text, Form from, Form to) {
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer(nameOf(from), text);
  const bool compiles = frontend::gsk::kGsk.compile(sources, std::span(&file, 1), {}, diagnostics) != nullptr;
  RUNG_CHECK(compiles, "what was converted compiles");
  const auto result =
      frontend::network::convertProgram(frontend::gsk::kLanguage, sources, std::span(&file, 1), to, diagnostics);
  RUNG_CHECK(result.has_value(), "what compiles converts");
  return *result;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  const Form form = text.starts_with("dialect gsk") ? Form::Ladder : Form::List;
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer(nameOf(form), text);
  const auto module = frontend::gsk::kGsk.compile(sources, std::span(&file, 1), {}, diagnostics);
  renderText(diagnostics, sources);
  RUNG_CHECK((module == nullptr) == diagnostics.hasErrors(), "no module without a reason");
  if (module == nullptr || size > kMaxDrawn) return 0;
  RUNG_CHECK(ir::verify(*module, ir::Mode::Built).empty(), "a module that was built is valid");
  const std::string list = convert(text, form, Form::List);
  const std::string ladder = convert(text, form, Form::Ladder);
  convert(list, Form::List, Form::Ladder);
  convert(ladder, Form::Ladder, Form::List);
  return 0;
}
