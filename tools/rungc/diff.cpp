// rungc diff: the changes between two versions of a program.
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>

#include "ir/image/program_image.h"
#include "ir/support/hash.h"
#include "rtlib/text/letters.h"
#include "tools/report/difference.h"
#include "tools/rungc/commands.h"
#include "tools/view/compare_html.h"
#include "tools/view/drawn_program.h"

namespace rung::rungc {
namespace {

namespace fs = std::filesystem;

struct DiffOptions {
  std::vector<std::string> files; // of the older version; without `newer` of both
  std::vector<std::string> newer;
  SourceOptions common; // without files
  std::string format = "text";
  std::string out; // a page; empty: none
};

// One of the two versions, with the project that it names or belongs to.
struct Side {
  std::vector<std::string> names;
  SourceOptions options;
  SourceManager sources;
  std::unique_ptr<const frontend::CheckedProgram> text;
  std::optional<compiler::Compiled> compiled;
};

int takeSide(Side& side, const DiffOptions& options) {
  side.options = options.common;
  side.options.files = side.names;
  side.options.quiet = true;
  return takeProject(side.options);
}

// The names of the older and the newer version; false if it is not clear which is which.
bool takeNames(const DiffOptions& options, Side& before, Side& after) {
  const bool isPair = options.newer.empty();
  if (isPair && options.files.size() != 2) return false;
  before.names = isPair ? std::vector(1, options.files[0]) : options.files;
  after.names = isPair ? std::vector(1, options.files[1]) : options.newer;
  return true;
}

// ---- copies of files compared with their project ------------------------------------------------------------------

// The project file that a copy replaces: the one with which it is compared, otherwise the one of its name.
std::optional<size_t> placeOf(const std::string& copy, const Side& whole) {
  const std::vector<std::string>& files = whole.options.project->files;
  const auto index = [&](auto isIt) -> std::optional<size_t> {
    const auto at = std::ranges::find_if(files, isIt);
    return at == files.end() ? std::nullopt : std::optional<size_t>(at - files.begin());
  };
  std::error_code error;
  const std::string& named = whole.names[0];
  if (whole.names.size() == 1 && !namesProject(named))
    return index([&](const std::string& file) { return fs::equivalent(file, named, error); });
  if (files.size() == 1) return 0;
  return index([&](const std::string& file) { return fs::path(file).filename() == fs::path(copy).filename(); });
}

// Files without a project are versions of the files with which they are compared, and get the rest of that project.
// False: it is not known which files of the project they are.
bool completeCopy(Side& copy, const Side& whole) {
  const compiler::Project& project = *whole.options.project;
  std::vector<std::string> files = project.files;
  for (const std::string& name : copy.names) {
    const std::optional<size_t> place = placeOf(name, whole);
    if (!place) {
      fmt::print(stderr,
                 "rungc: {} is in no project, and {} has no file of this name: configuration and messages are not "
                 "compared\n",
                 name, project.file);
      return false;
    }
    fmt::print(stderr, "rungc: {} is in no project: it is compared in the place of {}, with all else of {}\n", name,
               project.files[*place], project.file);
    files[*place] = name;
  }
  copy.options = whole.options;
  copy.options.files = copy.options.project->files = files;
  return true;
}

// Whether configuration and messages of the two can be compared.
bool completeSides(Side& before, Side& after) {
  const bool one = before.options.project.has_value() != after.options.project.has_value();
  if (!one) return true;
  Side& copy = before.options.project ? after : before;
  return completeCopy(copy, before.options.project ? before : after);
}

// ---- configuration -------------------------------------------------------------------------------------------------

uint64_t contentOf(const std::string& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return 0;
  std::ifstream file(path, std::ios::binary);
  return hashBytes(std::string(std::istreambuf_iterator<char>(file), {}));
}

// Numbers are compared by value, times in microseconds, files beside the project by their names there. The contents of
// a file count if the control reads it; for files that the compiler reads, its result is compared.
report::Setting settingOf(const nc::ConfigKey* row, const std::string& value, const SourceOptions& options) {
  report::Setting setting{.text = value, .meaning = value, .content = 0};
  if (row == nullptr) return setting;
  switch (row->form) {
  case nc::ConfigForm::Whole: setting.meaning = std::to_string(nc::wholeNumber(value)); break;
  case nc::ConfigForm::Duration: setting.meaning = std::to_string(nc::durationUs(value)); break;
  case nc::ConfigForm::File:
    if (options.project) {
      std::error_code error;
      const fs::path folder = fs::absolute(options.project->folder, error);
      setting.text = setting.meaning = fs::path(value).lexically_relative(folder).string();
    }
    if (row->reader == nc::ConfigReader::Control) setting.content = contentOf(value);
    break;
  case nc::ConfigForm::Choice:
  case nc::ConfigForm::Number:
  case nc::ConfigForm::Text: break;
  }
  return setting;
}

// A key with its default value counts as absent.
report::Settings settingsOf(const Side& side) {
  report::Settings settings;
  for (const auto& [key, value] : side.compiled->options.config) {
    if (key == nc::kEncodingKey.key) continue; // the encoding of the files; their decoded text is compared
    const nc::ConfigKey* row = nc::findConfigKey(side.compiled->dialect->configKeys, key);
    report::Setting setting = settingOf(row, value, side.options);
    const std::string without = row == nullptr ? "" : std::string(row->otherwise);
    if (without.empty() || settingOf(row, without, {}).meaning != setting.meaning) settings.emplace(key, setting);
  }
  return settings;
}

// Names without a declaration.
std::set<std::string> controlNames(const frontend::Analysis& analysis) {
  std::set<std::string> names;
  for (const frontend::Definition& definition : analysis.definitions())
    if (!definition.range.valid()) names.insert(text::upper(definition.name));
  return names;
}

// ---- the page ------------------------------------------------------------------------------------------------------

uint32_t numberOf(const report::ShownRung& rung) { return rung.rung == nullptr ? 0 : rung.rung->number; }

// Rungs of the older version that are in the same order in the newer one, and those that were removed after each.
struct OldOrder {
  std::vector<uint32_t> same;
  std::map<uint32_t, std::vector<uint32_t>> removedAfter; // by number; 0: at the beginning
};

OldOrder oldOrder(const report::Difference& found, const view::Program& before) {
  std::map<uint32_t, report::ChangeKind> kinds;
  for (const report::RungChange& change : found.rungs)
    if (change.before.rung != nullptr) kinds[change.before.rung->number] = change.kind;
  OldOrder order;
  uint32_t last = 0;
  for (const view::Figure& figure : before.figures) {
    const auto kind = kinds.find(figure.number);
    if (kind == kinds.end()) order.same.push_back(figure.number);
    if (kind != kinds.end() && kind->second == report::ChangeKind::Removed)
      order.removedAfter[last].push_back(figure.number);
    else if (kind == kinds.end() || kind->second == report::ChangeKind::Changed)
      last = figure.number;
  }
  return order;
}

view::ComparedRung::State stateOf(report::ChangeKind kind) {
  switch (kind) {
  case report::ChangeKind::Added: return view::ComparedRung::State::Added;
  case report::ChangeKind::Removed: return view::ComparedRung::State::Removed;
  case report::ChangeKind::Changed: return view::ComparedRung::State::Changed;
  case report::ChangeKind::Moved: return view::ComparedRung::State::Moved;
  }
  return view::ComparedRung::State::Same;
}

std::vector<view::ComparedRung> rungsOf(const report::Difference& found, const view::Program& before,
                                        const view::Program& after) {
  using State = view::ComparedRung::State;
  const OldOrder old = oldOrder(found, before);
  std::map<uint32_t, const report::RungChange*> changes; // by number in the newer version
  for (const report::RungChange& change : found.rungs)
    if (change.after.rung != nullptr) changes[change.after.rung->number] = &change;
  std::vector<view::ComparedRung> rungs;
  const auto removed = [&](uint32_t last) {
    if (const auto at = old.removedAfter.find(last); at != old.removedAfter.end())
      for (const uint32_t number : at->second) rungs.push_back({State::Removed, number, 0, {}});
  };
  removed(0);
  size_t same = 0;
  for (const view::Figure& figure : after.figures) {
    view::ComparedRung& rung = rungs.emplace_back(State::Same, 0, figure.number);
    if (const auto change = changes.find(figure.number); change != changes.end()) {
      rung.state = stateOf(change->second->kind);
      rung.before = numberOf(change->second->before);
      for (const report::ChangedPath& path : change->second->paths)
        rung.remarks.push_back(fmt::format("leads to {} instead of {}", path.after, path.before));
    } else if (same < old.same.size()) {
      rung.before = old.same[same++];
    }
    if (rung.state == State::Same || rung.state == State::Changed) removed(rung.before);
  }
  return rungs;
}

view::ComparedTable tableOf(std::string title, const std::vector<report::NameChange>& changes) {
  view::ComparedTable table{std::move(title), {}};
  for (const report::NameChange& change : changes)
    table.rows.push_back({std::string(report::nameOf(change.kind)), change.name, change.before, change.after});
  return table;
}

std::optional<view::Program> drawingOf(Side& side) {
  frontend::CompileOptions options = side.compiled->options;
  options.marks = nullptr;
  options.given = nullptr;
  Diagnostics diagnostics;
  return view::drawnProgram(side.sources, side.compiled->files, *side.compiled->dialect, options, diagnostics);
}

int writePage(const report::Difference& found, Side& before, Side& after, const DiffOptions& options) {
  std::optional<view::Program> older = drawingOf(before), newer = drawingOf(after);
  if (!older || !newer) return environmentError("the programs cannot be drawn");
  const view::Comparison comparison{
      .before = fmt::format("{}", fmt::join(before.names, ", ")),
      .after = fmt::format("{}", fmt::join(after.names, ", ")),
      .rungs = rungsOf(found, *older, *newer),
      .tables = {tableOf("Names", found.names), tableOf("Initial contents", found.contents),
                 tableOf("Messages", found.messages), tableOf("Configuration", found.settings)}};
  const std::string page = view::renderComparison(std::move(*older), std::move(*newer), comparison);
  return sayWrote(writeFile(page, options.out), options.out, options.common);
}

// ---- the command ---------------------------------------------------------------------------------------------------

int run(const DiffOptions& options) {
  if (!options.out.empty() && !options.out.ends_with(".html"))
    return usageError(
        fmt::format("-o {}: the page of a comparison is an HTML file, its name ends in .html", options.out));
  Side before, after;
  if (!takeNames(options, before, after))
    return usageError(fmt::format("diff takes the older and the newer version, found {} name{}; if a version has "
                                  "several files, write those of the newer one after --to",
                                  options.files.size(), options.files.size() == 1 ? "" : "s"));
  int status = takeSide(before, options);
  if (status == kOk) status = takeSide(after, options);
  if (status != kOk) return status;
  const bool complete = completeSides(before, after);
  for (Side* side : {&before, &after}) {
    side->compiled = compileSources(side->sources, side->options, {.compare = true, .source = &side->text}, status);
    if (!side->compiled) return status;
  }
  if (before.compiled->dialect != after.compiled->dialect)
    return usageError("the two programs have different dialects");
  const ir::ProgramImage images[] = {{*before.compiled->layout, 0}, {*after.compiled->layout, 0}};
  const auto version = [&](const Side& side, const ir::ProgramImage& image) {
    return report::Version{*side.compiled->built, side.compiled->given, image.program(),
                           complete ? settingsOf(side) : report::Settings{}, controlNames(side.text->analysis())};
  };
  const report::Options what{.messages = complete, .textName = before.compiled->dialect->textName};
  const report::Difference found = report::compare(version(before, images[0]), version(after, images[1]), what);
  if (!options.out.empty()) {
    status = writePage(found, before, after, options);
    return status != kOk || found.none() ? status : kWrong;
  }
  const ir::Module &older = *before.compiled->built, &newer = *after.compiled->built;
  status = writeOutput(options.format == "json" ? report::shownAsJson(found, older, newer)
                                                : report::shownAsText(found, older, newer));
  return status != kOk || found.none() ? status : kWrong;
}

} // namespace

void addDiff(CommandLine& app, int& status) {
  Command command = app.add("diff", "Compare two versions of a program, by what their rungs do");
  auto options = std::make_shared<DiffOptions>();
  command
      .option("FILE", options->files,
              "The older and the newer version, each a source file or the folder of a project; with --to all source "
              "files of the older one")
      .required();
  command.option("--to", options->newer, "The source files of the newer version, or the folder of its project")
      .manyValues();
  command.option("--dialect", options->common.dialect,
                 "fanuc, gsk, nct or technol; needed if the files do not name it");
  command.option("--config", options->common.config, "KEY=VALUE of the dialect's configuration; may be repeated")
      .oneValue();
  command.option("--format", options->format, "Format of the report").oneOf({"text", "json"}).showDefault();
  command.option("-o,--output", options->out,
                 "Writes a page (.html) instead: both versions side by side, what differs marked, the rest folded");
  addColorOption(command, options->common.color, "Colours in diagnostics");
  command.exitStatus("0 no difference, 1 there are differences or a program is wrong, 2 wrong usage, 3 environment");
  command.onRun([options, &status] { status = run(*options); });
}

} // namespace rung::rungc
