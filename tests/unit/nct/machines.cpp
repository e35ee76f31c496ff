// See machines.h.
#include "tests/unit/nct/machines.h"

#include <bit>

#include "ir/support/check.h"
#include "ir/support/diag_render.h"
#include "rtlib/change/shadow.h"
#include "rtlib/nc/names/names.h"

namespace rung::frontend::nct::test {

using compiler::EngineKind;

Machine::Machine(const compiler::Compiled& compiled, EngineKind kind) : name_(compiler::engineName(kind)) {
  auto engine = compiler::makeEngine(kind, compiled, {});
  RUNG_CHECK(engine.ok(), engine.error().c_str());
  engine_ = std::move(engine.value());
  instance_ = std::make_unique<runtime::Instance>(*engine_);
  memory_ = runtime::findSpace(instance_->program(), "M");
  slice_ = runtime::findSpace(instance_->program(), "TS");
}

uint32_t Machine::word(uint32_t number) const {
  return static_cast<uint32_t>(instance_->read(runtime::intRef(memory_, number * 4, 32)));
}

uint32_t Machine::slice(uint32_t number) const {
  return static_cast<uint32_t>(instance_->read(runtime::intRef(slice_, number * 4, 32)));
}

void Machine::setWord(uint32_t number, uint32_t value) {
  runtime::writeRaw(instance_->memory(), runtime::intRef(memory_, number * 4, 32), value);
  if (number >= 2 && number < kNcEnd)
    runtime::writeRaw(instance_->memory(), runtime::intRef(slice_, number * 4, 32), value);
}

double Machine::real(uint32_t number) const {
  return std::bit_cast<double>(uint64_t{word(number + 1)} << 32 | word(number));
}

void Machine::setReal(uint32_t number, double value) {
  const uint64_t bits = std::bit_cast<uint64_t>(value);
  setWord(number, static_cast<uint32_t>(bits));
  setWord(number + 1, static_cast<uint32_t>(bits >> 32));
}

void Machine::run() { RUNG_CHECK(instance_->runTask("MAIN"), "MAIN stopped with a fault"); }

void Machine::scan() { instance_->scan(); }
void Machine::fast() { instance_->fast(); }

Machines::Machines(const std::string& body, const std::vector<EngineKind>& kinds) {
  SourceManager sources;
  Diagnostics diagnostics;
  const FileId file = sources.addBuffer("test.lad", "dialect nct\nmodule MAIN\n" + body);
  auto compiled = compiler::compile(sources, {&file, 1}, {}, diagnostics);
  RUNG_CHECK(compiled.has_value(), renderText(diagnostics, sources).c_str());
  compiled_ = std::move(*compiled);
  for (EngineKind kind : kinds) machines_.emplace_back(compiled_, kind);
}

std::vector<EngineKind> Machines::everyEngine() {
  const auto kinds = compiler::allEngines();
  return {kinds.begin(), kinds.end()};
}

std::vector<EngineKind> Machines::interpreterAndJit() { return {EngineKind::Interp, EngineKind::Jit}; }

std::string Machines::difference() const {
  for (const Machine& machine : machines_)
    if (const auto found = runtime::firstDifference(machines_.front().instance(), machine.instance(), nc::describe))
      return machine.name() + ": " + *found;
  return {};
}

} // namespace rung::frontend::nct::test
