// rung-bench-passes OUT.so PASS FILE...|rung.toml: builds a program as `rungc build` does, without one pass of the
// optimiser, or with all of them (PASS is -). For the price of a pass, in instructions of the program.
#include <algorithm>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/engines.h"
#include "ir/support/diag_render.h"
#include "ir/transforms/passes.h"
#include "tools/bench/request.h"

namespace {

using namespace rung;

compiler::Compiled compiled(const std::vector<std::string>& names) {
  SourceManager sources;
  std::vector<FileId> files;
  compiler::CompileRequest request = bench::requestOf(sources, names, files);
  request.optimise = false;
  request.keepBuilt = true;
  Diagnostics diagnostics;
  auto program = compiler::compile(sources, files, request, diagnostics);
  if (!program) throw std::runtime_error(renderText(diagnostics, sources));
  return std::move(*program);
}

// The passes of the pipeline but one; those up to "carried" determine the shape.
void optimise(compiler::Compiled& program, std::string_view without) {
  ir::Module& module = *program.module;
  module = std::move(*program.built);
  ir::PassRunner runner(module);
  for (const std::string_view name : ir::optimisingPasses()) {
    if (name != without) runner.run(*ir::findPass(name));
    if (name == "carried") *program.shape = module;
  }
  program.layout = std::make_unique<ir::Layout>(ir::Layout(*program.shape, ir::LayoutOptions{}).over(module));
}

} // namespace

int main(int argc, char** argv) try {
  if (argc < 4) {
    std::cerr << "usage: rung-bench-passes OUT.so PASS|- FILE...|rung.toml\n";
    return 2;
  }
  const std::string_view without = argv[2];
  if (without != "-" && std::ranges::find(ir::optimisingPasses(), without) == ir::optimisingPasses().end())
    throw std::runtime_error(std::string(without) + " is not a pass of the pipeline");
  compiler::Compiled program = compiled({argv + 3, argv + argc});
  optimise(program, without);
  const std::string object = bench::good(compiler::sharedObject(program, {}));
  std::ofstream(argv[1], std::ios::binary) << object;
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "rung-bench-passes: " << problem.what() << '\n';
  return 1;
}
