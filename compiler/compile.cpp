// Files to a laid-out program (see compile.h).
#include "compiler/compile.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <iostream>
#include <iterator>
#include <set>
#include <string>

#include "compiler/dialect_choice.h"
#include "ir/support/check.h"
#include "ir/support/diag/source.h"
#include "ir/support/encoding.h"
#include "ir/support/foreign_file.h"
#include "ir/text/text.h"
#include "ir/transforms/passes.h"
#include "ir/verify/verify.h"

namespace rung::compiler {
namespace {

// An invalid module is an error of the compiler, never of the user's program.
void checkModule(const ir::Module& module, ir::Mode mode) {
  const std::vector<ir::VerifyError> errors = ir::verify(module, mode);
  RUNG_CHECK(errors.empty(), ir::render(module, errors).c_str());
}

void addClaim(ir::Module& module, const LayoutClaim& claim) {
  module.symbols.push_back({.name = claim.symbol,
                            .comment = claim.text,
                            .type = RUNG_TYPE_I64,
                            .flags = RUNG_SYMBOL_CONST | RUNG_SYMBOL_HIDDEN | RUNG_SYMBOL_READONLY,
                            .value = claim.hash});
}

bool checkEncodingKey(const frontend::CompileOptions& options, Diagnostics& diagnostics) {
  const std::string key(nc::kEncodingKey.key);
  const auto encoding = options.config.find(key);
  if (encoding == options.config.end() || knowsEncoding(encoding->second)) return true;
  diagnostics.report(diag::UnknownEncoding, options.placeOf(key)) << encoding->second;
  return false;
}

// Its declarations would be there twice; engines, too, know files by their names.
bool checkNamedOnce(const SourceManager& sources, std::span<const FileId> files, Diagnostics& diagnostics) {
  std::set<std::string> named;
  for (const FileId file : files) {
    const std::string name = std::filesystem::path(sources.name(file)).lexically_normal().string();
    if (named.insert(name).second) continue;
    diagnostics.report(diag::FileTwice, SourceRange{}) << sources.name(file);
    return false;
  }
  return true;
}

void reportCutTexts(const SourceManager& sources, std::span<const FileId> files, Diagnostics& diagnostics) {
  for (const FileId file : files)
    if (const size_t left = sources.textAfterEnd(file); left != 0 && !isBinary(sources.text(file)))
      diagnostics.report(diag::IncompleteFile,
                         sources.range(file, sources.text(file).size(), sources.text(file).size()))
          << fmt::format("a Ctrl-Z ends the text here, and {} bytes after it are left out", left);
}

} // namespace

Result<std::vector<FileId>> addFiles(SourceManager& sources, const std::vector<std::string>& names,
                                     const std::map<std::string, std::string>& config) {
  if (const auto encoding = config.find(std::string(nc::kEncodingKey.key)); encoding != config.end())
    sources.setEncoding(encoding->second);
  std::vector<FileId> files;
  for (const std::string& name : names) {
    if (name == "-") {
      files.push_back(sources.addBytes("<stdin>", std::string(std::istreambuf_iterator<char>(std::cin), {})));
      continue;
    }
    Result<FileId> file = sources.addFile(name);
    if (!file.ok()) return failure(fmt::format("cannot read '{}': {}", name, file.error()));
    files.push_back(file.value());
  }
  return files;
}

std::optional<Compiled> compile(SourceManager& sources, std::span<const FileId> files, const CompileRequest& request,
                                Diagnostics& diagnostics) {
  Compiled out;
  out.files.assign(files.begin(), files.end());
  out.dialect = chooseDialect(sources, files, request.dialect, diagnostics);
  if (out.dialect == nullptr || !checkNamedOnce(sources, files, diagnostics)) return std::nullopt;
  if (!checkEncodingKey(request.options, diagnostics)) return std::nullopt;
  reportCutTexts(sources, files, diagnostics);
  out.project = request.name;
  out.options = request.options;
  frontend::CompileOptions options = request.options;
  if (request.marks) options.marks = &out.marks;
  if (request.compare) options.given = &out.given;
  const auto ended = [&](std::string_view stage) {
    if (request.ended) request.ended(stage);
  };
  auto program = out.dialect->check(sources, files, options, diagnostics);
  ended("check");
  if (!diagnostics.hasErrors()) out.module = program->build();
  if (request.source != nullptr) *request.source = std::move(program);
  if (out.module == nullptr || diagnostics.hasErrors()) return std::nullopt;
  for (const LayoutClaim& claim : request.layouts) addClaim(*out.module, claim);
  ir::orderOperations(*out.module, options.marks, options.given);
  ir::readSourcesOfLatches(*out.module);
  out.module->name =
      request.name.empty() ? std::filesystem::path(sources.name(files[0])).stem().string() : request.name;
  ended("lowering");
  checkModule(*out.module, ir::Mode::Built);
  ended("verifier");
  out.uses = std::make_unique<ir::Uses>(*out.module);
  if (request.branches != nullptr) out.branchWeights = ir::setBranchWeights(*out.module, *request.branches);
  if (request.keepBuilt || request.compare) out.built = std::make_unique<ir::Module>(*out.module);
  out.passes.optimise = request.optimise && !request.compare;
  out.passes.instrument = request.instrument;
  ended("uses");
  out.shape = std::make_unique<ir::Module>();
  ir::runPasses(*out.module, out.passes, out.shape.get());
  ended("passes");
  checkModule(*out.module, ir::Mode::Final);
  ended("verifier");
  out.layout = std::make_unique<ir::Layout>(ir::Layout(*out.shape, request.layout).over(*out.module));
  ended("layout");
  out.codeHash = ir::hashOf(*out.module);
  ended("hash");
  out.warnings = diagnostics.warningCount();
  return out;
}

} // namespace rung::compiler
