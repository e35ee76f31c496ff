// From files to a laid-out program: reads them, selects the dialect, compiles to the IR, verifies, optimises and lays
// out.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "ir/analysis/branch_weights.h"
#include "ir/analysis/uses.h"
#include "ir/shape/layout.h"
#include "ir/support/diagnostics.h"
#include "ir/support/source.h"
#include "ir/transforms/pipeline.h"

namespace rung::compiler {

// The layout of a host's struct for which a program is compiled (RUNG_LAYOUT_SYMBOL): it becomes a hidden constant.
struct LayoutClaim {
  std::string symbol;
  std::string text;
  int64_t hash = 0;
};

struct CompileRequest {
  std::string dialect;              // empty: determined from the files
  std::string name;                 // of the project; empty: the program has the name of its first file
  frontend::CompileOptions options; // configuration and strictness
  bool instrument = false;          // count and time rungs
  bool marks = false;               // mark contacts and coils
  bool compare = false;             // keep what a comparison of the module as built with that of another version needs
  bool optimise = true;
  bool keepBuilt = false; // for recompilation (recompiler.h)
  ir::LayoutOptions layout;
  std::vector<LayoutClaim> layouts;
  const ir::BranchCounts* branches = nullptr; // of earlier runs, for the layout of the code; null: none
  // If not null: receives the checked text, also of a program with errors. The sources must outlive it.
  std::unique_ptr<const frontend::CheckedProgram>* source = nullptr;
  std::function<void(std::string_view stage)> ended; // called at the end of each stage, for measurements; may be empty
};

struct Compiled {
  std::vector<FileId> files;
  std::string project; // name of the request
  const frontend::Dialect* dialect = nullptr;
  std::unique_ptr<ir::Module> built;     // as the dialect made it, if requested
  std::unique_ptr<ir::Module> shape;     // the module that determines the layout (ir::runPasses)
  std::unique_ptr<ir::Module> module;    // final, optimised
  ir::PassOptions passes;                // the passes from `shape` to `module`
  ir::BranchWeightsResult branchWeights; // from the branch counts of the request
  std::unique_ptr<ir::Layout> layout;    // of `shape`, applied to `module`
  // If requested: of the module as built, and of `shape`, by rungs as built (Rung::origin). Not of an optimised module.
  ir::Marks marks;
  ir::GivenNumbers given;           // of `built`, for a comparison
  frontend::CompileOptions options; // of the request
  std::unique_ptr<ir::Uses> uses;   // of the module as built
  uint64_t codeHash = 0;            // ir::hashOf(module)
  size_t warnings = 0;              // number of warnings reported
};

// Adds the files of a command line; "-" reads standard input. `config`: of the dialect; its `encoding` applies to files
// that do not declare theirs. Fails on the first file that cannot be read.
Result<std::vector<FileId>> addFiles(SourceManager& sources, const std::vector<std::string>& names,
                                     const std::map<std::string, std::string>& config);

// Nothing if the program has errors; they are in `diagnostics`.
std::optional<Compiled> compile(SourceManager& sources, std::span<const FileId> files, const CompileRequest& request,
                                Diagnostics& diagnostics);

} // namespace rung::compiler
