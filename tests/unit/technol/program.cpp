// Compiling and running programs in tests (see program.h).
#include "tests/unit/technol/program.h"

#include <gtest/gtest.h>

#include "ir/support/check.h"
#include "ir/support/diag_render.h"
#include "ir/verify/verify.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/nc/technol/services.h"
#include "rtlib/nc/technol/signals.h"

namespace rung::technol_test {
namespace {

std::string module(const std::string& name, const std::string& text) {
  return "MODULE_" + name + "\n" + text + "MODULE_" + name + "_END\n";
}

std::vector<std::string> reported(const Compilation& c, Severity severity) {
  std::vector<std::string> lines;
  for (const Diagnostic* d : c.diagnostics->sorted()) {
    if (d->severity != severity) continue;
    std::string place = "-:0";
    if (d->range.valid()) {
      const LineCol at = c.sources->lineCol(d->range.begin);
      place = std::string(at.file) + ":" + std::to_string(at.line);
    }
    lines.push_back(place + " " + std::string(diagInfo(d->id).code));
  }
  return lines;
}

// Interface cells that the program does not use are found by their place in the block.
std::optional<runtime::Ref> interfaceCell(std::string_view name) {
  const nc::Signal* s = nc::findSignal(nc::technolSignals(), name, "I");
  if (!s) return std::nullopt;
  if (s->type == nc::SignalType::Bit) return runtime::bitRef(0, s->byteOffset, s->bit);
  return runtime::intRef(0, s->byteOffset, nc::elementBytes(s->type) * 8);
}

} // namespace

std::string programText(const Parts& p) {
  std::string text = "DATA\n" + p.data + "DATA_END\n" + module("INPUT", p.input) + module("MAIN", p.main);
  text += module("BLOCK_INIT", p.blockInit) + module("BLOCK_DONE", p.blockDone) + module("INIT", p.init) +
          module("CLEAR", p.clear) + module("HALT", p.halt);
  if (!p.fast.empty()) text += module("FAST", p.fast);
  if (!p.done.empty()) text += module("DONE", p.done);
  if (!p.cont.empty()) text += module("CONT", p.cont);
  return text + "STOP\n";
}

std::vector<std::string> Compilation::errors() const { return reported(*this, Severity::Error); }
std::vector<std::string> Compilation::warnings() const { return reported(*this, Severity::Warning); }
std::string Compilation::text() const { return renderText(*diagnostics, *sources); }

Compilation compile(const std::vector<std::string>& files, const frontend::CompileOptions& options) {
  Compilation c{std::make_unique<SourceManager>(), std::make_unique<Diagnostics>(), nullptr};
  std::vector<FileId> ids;
  for (size_t i = 0; i < files.size(); ++i) ids.push_back(c.sources->addBuffer(std::to_string(i), files[i]));
  c.module = frontend::technol::kTechnol.compile(*c.sources, ids, options, *c.diagnostics);
  if (c.module) {
    const auto errors = ir::verify(*c.module, ir::Mode::Built);
    EXPECT_TRUE(errors.empty()) << ir::render(*c.module, errors);
  }
  return c;
}

Machine::Machine(const std::vector<std::string>& files, const frontend::CompileOptions& options)
    : compilation_(compile(files, options)) {
  EXPECT_TRUE(compilation_.module) << compilation_.text();
  RUNG_CHECK(compilation_.module != nullptr, "the program of a test does not compile");
  layout_ = std::make_unique<ir::Layout>(*compilation_.module, ir::LayoutOptions{});
  engine_ = std::make_unique<ir::InterpEngine>(*layout_, 1);
  instance_ = std::make_unique<runtime::Instance>(*engine_, this);
  start();
}

void Machine::start() { instance_->runTask("INIT"); }

void Machine::scan(int times) {
  for (int i = 0; i < times; ++i) instance_->scan();
}

runtime::Ref Machine::resolve(std::string_view name) const {
  const auto ref = nc::resolve(instance_->program(), name, interfaceCell);
  EXPECT_TRUE(ref) << name;
  return ref.value_or(runtime::Ref{});
}

int64_t Machine::get(std::string_view name) const {
  const runtime::Ref ref = resolve(name);
  return ref.width == 1 ? static_cast<int64_t>(instance_->read(ref)) : runtime::readSigned(instance_->memory(), ref);
}

double Machine::real(std::string_view name) const {
  return instance_->readReal(*runtime::asReal(instance_->memory(), resolve(name)));
}
void Machine::set(std::string_view name, int64_t value) {
  EXPECT_EQ(instance_->write(resolve(name), static_cast<uint64_t>(value)), std::nullopt);
}
void Machine::setReal(std::string_view name, double value) {
  EXPECT_EQ(instance_->writeReal(*runtime::asReal(instance_->memory(), resolve(name)), value), std::nullopt);
}

std::vector<std::string> Machine::messages() {
  std::vector<std::string> lines;
  rung_message m;
  while (instance_->messages().pop(m)) {
    const nc::technol::MessageValues values = nc::technol::valuesOf(m);
    std::string line = (m.op == RUNG_MESSAGE_CLEAR ? "-" : "") + std::to_string(values.number);
    if (m.number & nc::technol::kPersistentWanted) line += 'p';
    if (m.number & nc::technol::kByBit) line += 'b';
    line += "/" + std::to_string(values.subId);
    for (const uint32_t par : values.par) line += "/" + std::to_string(par);
    lines.push_back(std::move(line));
  }
  return lines;
}

void Machine::onHook(runtime::Instance& instance, uint32_t work) {
  if (work != 1) return;
  if (blockInit) {
    instance.runTask("BLOCK_INIT");
    blockInit = get("@BLOCK_INIT.DONE") == 0;
  }
  if (blockDone) {
    instance.runTask("BLOCK_DONE");
    blockDone = get("@BLOCK_DONE.DONE") == 0;
  }
}

} // namespace rung::technol_test
