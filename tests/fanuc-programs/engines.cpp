// rung_fanuc_engines SCANS SEED FILE...: runs a FANUC program on all engines in step, each in a simulated control of
// its own, with the same random inputs of the machine, and tells the first difference in anything that a user could
// see.
#include <cstdlib>
#include <exception>
#include <iostream>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "compiler/engines.h"
#include "ir/support/diag_render.h"
#include "rtlib/change/shadow.h"
#include "rtlib/load/program_info.h"
#include "rtlib/nc/names/names.h"
#include "sim/machine.h"

namespace {

using namespace rung;

constexpr uint32_t kChangesAScan = 4;

template <class T>
T good(Result<T> result) {
  if (!result.ok()) throw std::runtime_error(result.error());
  return std::move(result).value();
}

compiler::Compiled compiled(const std::vector<std::string>& names) {
  SourceManager sources;
  compiler::CompileRequest request;
  const std::vector<FileId> files = good(compiler::addFiles(sources, names, request.options.config));
  Diagnostics diagnostics;
  auto program = compiler::compile(sources, files, request, diagnostics);
  if (!program) throw std::runtime_error(renderText(diagnostics, sources));
  return std::move(*program);
}

// A program on one engine in a control.
class Side {
public:
  Side(compiler::EngineKind kind, const compiler::Compiled& program)
      : engine_(good(compiler::makeEngine(kind, program, {.virtualClock = true}))),
        machine_(engine_->program(), engine_->context(), sim::makeSimulatedNc(engine_->program().dialect)),
        inputs_(runtime::findSpace(engine_->program(), "X")) {
    machine_.powerOn(nc::PowerOn::Cold);
  }

  uint32_t inputBytes() const { return engine_->program().spaces[inputs_].byte_count; }
  void write(uint32_t byte, uint8_t value) { machine_.inside().memory().writeByte(inputs_, byte, value); }
  void scan() { machine_.scan(); }
  const runtime::Instance& inside() const { return machine_.inside(); }
  std::string_view name() const { return engine_->name(); }

private:
  std::unique_ptr<runtime::Engine> engine_;
  sim::Machine machine_;
  uint32_t inputs_;
};

void run(const compiler::Compiled& program, size_t scans, uint64_t seed) {
  std::vector<std::unique_ptr<Side>> sides;
  for (const compiler::EngineKind kind : compiler::allEngines()) sides.push_back(std::make_unique<Side>(kind, program));
  std::mt19937_64 random(seed);
  for (size_t scan = 1; scan <= scans; ++scan) {
    for (uint32_t change = 0; change < kChangesAScan; ++change) {
      const auto byte = static_cast<uint32_t>(random() % sides[0]->inputBytes());
      const auto value = static_cast<uint8_t>(random());
      for (const auto& side : sides) side->write(byte, value);
    }
    for (const auto& side : sides) side->scan();
    if (sides[0]->inside().faulted()) throw std::runtime_error("a fault: " + sides[0]->inside().faultText());
    for (size_t i = 1; i < sides.size(); ++i)
      if (const auto found = runtime::firstDifference(sides[0]->inside(), sides[i]->inside(), nc::describe))
        throw std::runtime_error("scan " + std::to_string(scan) + ", " + std::string(sides[0]->name()) + " against " +
                                 std::string(sides[i]->name()) + ": " + *found);
  }
}

} // namespace

int main(int argc, char** argv) try {
  if (argc < 4) {
    std::cerr << "usage: rung_fanuc_engines SCANS SEED FILE...\n";
    return 2;
  }
  run(compiled({argv + 3, argv + argc}), std::strtoul(argv[1], nullptr, 10), std::strtoull(argv[2], nullptr, 10));
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "rung_fanuc_engines: " << problem.what() << '\n';
  return 1;
}
