// Versions of a program (see programs.h).
#include "tests/host-sim/programs.h"

#include <algorithm>

#include "compiler/code_maker.h"
#include "compiler/compile.h"
#include "ir/support/check.h"
#include "ir/support/diag_render.h"
#include "rung/runtime.hpp"

namespace rung::host_sim {
namespace {

// SCANS is kept and counts them. GO lights LAMP, and its edges are counted in EDGES; SETS sets LATCH and CLEARS clears
// it; LATE comes 40 ms after WAIT; FAR comes over a connection and lights BEYOND; ASK reads a variable of the CNC, and
// TOLD says that it is done, well or not; STUCK lets the program never end.
constexpr const char* kHead = R"(dialect gsk
symbol GO X0.0
symbol STUCK X0.1
symbol SETS X0.2
symbol CLEARS X0.3
symbol WAIT X0.4
symbol OTHER X0.5
symbol FAR X0.6
symbol ASK X1.0
symbol LAMP Y0.0
symbol LATCH Y0.1
symbol LATE Y0.2
symbol SECOND Y0.3
symbol BEYOND Y0.4
symbol TOLD R10.0
symbol SCANS D100
symbol EDGES D110
symbol MORE D120
symbol NEVER R9.0
FUNC END1
)";
constexpr const char* kCount = R"(LD NEVER
LDI NEVER
FUNC ADDB
PRM 0004
PRM SCANS
PRM 1
PRM SCANS
OUT R0.0
)";
constexpr const char* kEdges = R"(LD GO
FUNC DIFU
PRM 0001
OUT R1.0
LD NEVER
LD R1.0
FUNC ADDB
PRM 0004
PRM EDGES
PRM 1
PRM EDGES
OUT R0.1
)";
constexpr const char* kOtherEdges = R"(LD OTHER
FUNC DIFU
PRM 0002
OUT R1.1
LD NEVER
LD R1.1
FUNC ADDB
PRM 0004
PRM MORE
PRM 1
PRM MORE
OUT R0.2
)";
constexpr const char* kOutputs = R"(LD GO
OUT LAMP
LD SETS
SET LATCH
LD CLEARS
RST LATCH
)";
constexpr const char* kLate = R"(LD WAIT
FUNC TMRB
PRM 1
PRM 40
OUT LATE
)";
constexpr const char* kBeyond = R"(LD FAR
OUT BEYOND
)";
constexpr const char* kAsk = R"(LD ASK
FUNC WINDR
PRM D0
PRM R20
OUT TOLD
)";
constexpr const char* kSecond = R"(LD LAMP
AND OTHER
OUT SECOND
)";
constexpr const char* kStuck = R"(FUNC LBL
PRM L1
LD STUCK
FUNC JMPB
PRM L1
)";
constexpr const char* kAlwaysStuck = R"(FUNC LBL
PRM L1
LDI NEVER
FUNC JMPB
PRM L1
)";

std::string join(std::initializer_list<const char*> parts) {
  std::string text;
  for (const char* part : parts) text += part;
  return text + "FUNC END2\n";
}

} // namespace

struct Programs::Made {
  compiler::Compiled compiled;
  std::unique_ptr<runtime::Engine> engine;
};

Programs::Programs() {
  const auto add = [this](Version version, const std::string& text) {
    auto made = std::make_unique<Made>();
    SourceManager sources;
    Diagnostics diagnostics;
    const FileId file = sources.addBuffer(version.name + ".pmc", text);
    std::optional<compiler::Compiled> compiled =
        compiler::compile(sources, {&file, 1}, {.keepBuilt = true}, diagnostics);
    RUNG_CHECK(compiled.has_value(), renderText(diagnostics, sources).c_str());
    made->compiled = std::move(*compiled);
    auto engine = compiler::makeEngine(compiler::EngineKind::Interp, made->compiled, {});
    RUNG_CHECK(engine.ok(), engine.error().c_str());
    made->engine = std::move(engine).value();
    versions_.push_back(std::move(version));
    made_.push_back(std::move(made));
  };
  add({"first"}, join({kHead, kCount, kEdges, kLate, kBeyond, kAsk, kOutputs, kStuck}));
  add({"above"}, // a rung above all
      join({kHead, kOtherEdges, kCount, kEdges, kLate, kBeyond, kAsk, kOutputs, kSecond, kStuck}));
  add({"below"}, join({kHead, kCount, kAsk, kLate, kEdges, kSecond, kOutputs, kBeyond, kStuck, kOtherEdges}));
  add({"plain", false}, join({kHead, kCount, kBeyond, kOutputs, kStuck}));
  add({"wrong"}, join({kHead, kCount, kEdges, kLate, kBeyond, kAsk, kOutputs, kAlwaysStuck})); // faults at once
}

Programs::~Programs() = default;

Image Programs::image(size_t version) const {
  const Made& made = *made_[version];
  Image image = Image::adopt(made.engine->program(), made.engine->context());
  check(compiler::serveImage(image.handle(), [&made] { return Result<const compiler::Compiled*>(&made.compiled); },
                             compiler::EngineKind::Interp, {}));
  return image;
}

std::optional<size_t> Programs::find(const std::string& name) const {
  const auto found = std::ranges::find(versions_, name, &Version::name);
  if (found == versions_.end()) return std::nullopt;
  return static_cast<size_t>(found - versions_.begin());
}

} // namespace rung::host_sim
