// See programs.h.
#include "tests/truth/programs.h"

#include <cstdlib>
#include <span>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "ir/support/diag_render.h"
#include "tests/unit/fanuc/program_generator.h"
#include "tests/unit/gsk/program_generator.h"
#include "tools/bench/generated/form.h"

namespace rung::truth {
namespace {

constexpr bench::Kind kKinds[] = {bench::Kind::Bits,       bench::Kind::Arrays,   bench::Kind::TimersRunning,
                                  bench::Kind::Counters,   bench::Kind::Integers, bench::Kind::Reals,
                                  bench::Kind::Indexed,    bench::Kind::Signals,  bench::Kind::MechanismsWaiting,
                                  bench::Kind::Mechanisms, bench::Kind::Full};

} // namespace

bool isLarge() {
  const char* form = std::getenv("RUNG_TRUTH");
  return form != nullptr && std::string_view(form) == "large";
}

std::vector<Text> drawnTexts() {
  std::vector<Text> texts;
  for (uint64_t seed = 1; seed <= (isLarge() ? 400u : 12u); ++seed) {
    texts.push_back({fmt::format("drawn-{}.pmc", seed), frontend::gsk::test::ProgramGenerator(seed).list()});
    texts.push_back({fmt::format("drawn-{}.mne", seed), frontend::fanuc::test::ProgramGenerator(seed).list()});
  }
  const std::vector<uint32_t> sizes = isLarge() ? std::vector<uint32_t>{13, 40, 100, 200} : std::vector<uint32_t>{20};
  for (const std::string_view dialect : bench::kDialects)
    for (const bench::Kind kind : kKinds)
      for (const uint32_t size : sizes) {
        const Result<bench::Program> program = bench::formOf(dialect)->write(bench::drawWork(kind, size));
        if (program.ok()) texts.push_back({program.value().file, program.value().text});
      }
  return texts;
}

std::unique_ptr<Program> Program::of(const Text& text) {
  std::unique_ptr<Program> program(new Program(text));
  const FileId file = program->sources_.addBuffer(program->text_.file, program->text_.text);
  compiler::CompileRequest request;
  request.optimise = false; // nothing that a rung reads is left out
  program->compiled_ = compiler::compile(program->sources_, {&file, 1}, request, program->diagnostics_);
  if (program->compiled_) return program;
  ADD_FAILURE() << text.file << "\n" << renderText(program->diagnostics_, program->sources_);
  return nullptr;
}

void scatter(runtime::Instance& instance, ir::RandomSource& random) {
  const rung_program& program = instance.program();
  for (const rung_space& space : std::span(program.spaces, program.space_count)) {
    if ((space.flags & RUNG_SPACE_HIDDEN) != 0) continue; // timers and the like are what the program left there
    for (const rung_range& range : std::span(space.ranges, space.range_count)) {
      const bool bits = range.repr == RUNG_REPR_BYTE_PER_BIT;
      for (uint32_t i = 0; i < range.byte_count * (bits ? 8 : 1); ++i)
        instance.block()[range.offset + i] = static_cast<uint8_t>(bits ? random.below(2) : random.below(256));
    }
  }
}

} // namespace rung::truth
