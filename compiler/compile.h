// From files to a laid-out program: read, choose the dialect, compile to the IR, verify, optimise, lay out.
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

// The layout of a host's struct that a program is compiled for (RUNG_LAYOUT_SYMBOL): it becomes a hidden constant.
struct LayoutClaim {
  std::string symbol;
  std::string text;
  int64_t hash = 0;
};

struct CompileRequest {
  std::string dialect;              // empty: the files say it
  std::string name;                 // of the project; empty: the program is called after its first file
  frontend::CompileOptions options; // configuration and strictness
  bool instrument = false;          // count and time rungs
  bool marks = false;               // note contacts and coils; the module stays as it was built
  bool compare = false; // note what is needed to compare the module, as it was built, with that of another version
  bool optimise = true;
  bool keepBuilt = false;  // for those who make its code again (recompiler.h)
  bool keepSource = false; // keep what the front end knows of the text
  ir::LayoutOptions layout;
  std::vector<LayoutClaim> layouts;
  const ir::BranchCounts* branches = nullptr;        // of earlier runs, for the order of the code; null: none
  std::function<void(std::string_view stage)> ended; // called at the end of each stage, to measure it; may be empty
};

struct Compiled {
  std::vector<FileId> files;
  std::string project; // the name of the request
  const frontend::Dialect* dialect = nullptr;
  std::unique_ptr<ir::Module> built;     // as the dialect made it, where that was asked for
  std::unique_ptr<ir::Module> shape;     // what the layout follows from (ir::runPasses)
  std::unique_ptr<ir::Module> module;    // final, optimised
  ir::PassOptions passes;                // between the two
  ir::BranchWeightsResult branchWeights; // of the branches of the request
  std::unique_ptr<ir::Layout> layout;    // of the shape, over the module
  ir::Marks marks;                       // where they were asked for
  ir::GivenNumbers given;                // of `built`, for a comparison
  frontend::CompileOptions options;      // of the request
  std::unique_ptr<ir::Uses> uses;        // of the module as the dialect made it
  // Where it was asked for: for its analysis alone, as it has been built; the sources must outlive it.
  std::unique_ptr<const frontend::CheckedProgram> source;
  uint64_t codeHash = 0; // ir::hashOf the module
  size_t warnings = 0;   // that were reported on the way
};

// Adds the files of a command line; "-" reads standard input. `config`: of the dialect; its `encoding` is that of files
// that do not name theirs. Fails on the first that cannot be read.
Result<std::vector<FileId>> addFiles(SourceManager& sources, const std::vector<std::string>& names,
                                     const std::map<std::string, std::string>& config);

// The dialect of a program: the one named, or with an empty name that of the first file. Null when nothing says it, or
// one of the files is a compiled program; that is reported.
const frontend::Dialect* chooseDialect(const SourceManager& sources, std::span<const FileId> files,
                                       const std::string& name, Diagnostics& diagnostics);

// Nothing when the program has errors; they are in `diagnostics`.
std::optional<Compiled> compile(SourceManager& sources, std::span<const FileId> files, const CompileRequest& request,
                                Diagnostics& diagnostics);

} // namespace rung::compiler
