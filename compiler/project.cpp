// Reading the project file.
#include "compiler/project.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "frontend/dialects/dialect.h"
#include "ir/support/diag/project.h"
#include "ir/support/diag/source.h"
#include "ir/support/encoding.h"
#include "ir/support/meant.h"
#include "ir/support/utf8.h"
#include "rtlib/text/toml.h"

namespace rung::compiler {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDialects = "\"fanuc\", \"gsk\", \"nct\" or \"technol\"";
constexpr std::string_view kFiles = "a list of texts such as [\"main.lad\", \"io.lad\"]";
constexpr std::string_view kInclude = "a list of texts such as [\"../common\"]";
constexpr std::string_view kScenarios = "a list of texts such as [\"*.scn\"]";
constexpr std::string_view kBindings = "a list of texts such as [\"nc_binding.h\"]";

class Reader : public text::TomlReading {
public:
  Reader(SourceManager& sources, FileId file, Diagnostics& diagnostics)
      : sources_(sources), fileId_(file), diagnostics_(diagnostics) {}

  Project read(const std::string& path) {
    project_.file = path;
    project_.folder = fs::path(path).parent_path().string();
    if (const std::optional<toml::table> table = parse(sources_.text(fileId_)))
      readKeys(*this, *table, "", kKeys, project_);
    for (const text::TomlMistake& mistake : mistakes()) report(mistake);
    if (project_.name.empty()) project_.name = folderName();
    for (Setting& setting : project_.config) placeFile(setting);
    std::ranges::stable_sort(project_.config, {}, &Setting::begin);
    return std::move(project_);
  }

private:
  using Key = text::TomlKey<Reader, Project>;
  static const Key kKeys[9];

  // ---- positions and reports

  SourcePos sourcePos(text::Position at) const {
    const uint32_t line = std::clamp<uint32_t>(at.line, 1, sources_.lineCount(fileId_));
    const std::string_view text = sources_.lineText(fileId_, line);
    // The parser's columns do not count the mark.
    size_t offset = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
    for (uint32_t column = 1; column < at.column && offset < text.size(); ++column)
      offset += decodeUtf8(text, offset).length;
    return sources_.position(fileId_, static_cast<size_t>(text.data() - sources_.text(fileId_).data()) + offset);
  }
  // For a text over several lines, the first line.
  SourceRange rangeOf(text::Position at, text::Position end) const {
    const SourcePos begin = sourcePos(at);
    return {begin, end.line == at.line ? std::max(begin, sourcePos(end)) : begin};
  }
  SourceRange rangeOf(const toml::node& node) const {
    const toml::source_position& end = node.source().end;
    return rangeOf(positionOf(node), {end.line, end.column});
  }

  void report(const text::TomlMistake& mistake) {
    using Kind = text::TomlMistake::Kind;
    const SourceRange range = rangeOf(mistake.at, mistake.end);
    switch (mistake.kind) {
    case Kind::Syntax: diagnostics_.report(diag::ProjectSyntax, range) << mistake.found; break;
    case Kind::UnknownKey: reportUnknown(mistake, range); break;
    case Kind::MissingKey:
      diagnostics_.report(diag::MissingProjectKey, sources_.range(fileId_, 0, 0))
          << mistake.found << fmt::format("write {}", mistake.example);
      break;
    case Kind::Value:
    case Kind::Other:
      diagnostics_.report(diag::ProjectValue, range) << mistake.where << mistake.found << mistake.expected;
    }
  }

  void reportUnknown(const text::TomlMistake& mistake, SourceRange range) {
    DiagBuilder report = diagnostics_.report(diag::UnknownProjectKey, range);
    report << mistake.found;
    const frontend::Dialect* dialect = frontend::findDialect(project_.dialect);
    const frontend::ForeignWord* foreign =
        dialect == nullptr ? nullptr : frontend::findForeign(dialect->foreignKeys, mistake.found);
    if (foreign != nullptr) return frontend::explainForeign(report, range, *foreign, false);
    suggest(report, range, mistake.meant);
    if (mistake.meant.word.empty())
      report.note(fmt::format("the keys of a project file are {}; those of the dialect's configuration belong in the "
                              "table [config]",
                              mistake.expected));
  }

  void missing(const toml::node& node, const std::string& path, std::string_view what) {
    diagnostics_.report(diag::MissingProjectFile, rangeOf(node)) << path << what;
  }

  // ---- keys

  // Calls act(text, node) for every text of a list. False: the node is not a list of texts.
  template <class Act>
  bool forTexts(std::string_view key, const toml::node& node, std::string_view expected, Act act) {
    const toml::array* list = node.as_array();
    if (list == nullptr) return false;
    for (const toml::node& element : *list)
      if (const auto text = element.value_exact<std::string>())
        act(*text, element);
      else
        wrong(element, key, expected, "");
    return true;
  }

  std::string folderName() const {
    std::error_code error;
    const fs::path whole = fs::absolute(project_.folder.empty() ? "." : project_.folder, error).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  }

  std::string inFolder(std::string_view name) const {
    return (fs::path(project_.folder) / name).lexically_normal().string();
  }

  bool takeName(const toml::node& node, Project& project) {
    project.name = text::stringOf(node);
    return !project.name.empty() && project.name.find('/') == std::string::npos;
  }

  bool takeDialect(const toml::node& node, Project& project) {
    project.dialect = text::stringOf(node);
    return frontend::findDialect(project.dialect) != nullptr;
  }

  bool takeFiles(const toml::node& node, Project& project) {
    if (node.is_array() && node.as_array()->empty())
      wrong(node.source(), "files", "an empty list", "at least one file", "");
    return forTexts("files", node, kFiles, [&](const std::string& name, const toml::node& element) {
      project.files.push_back(inFolder(name));
      std::error_code error;
      if (!fs::is_regular_file(project.files.back(), error)) missing(element, project.files.back(), "a file");
    });
  }

  bool takeInclude(const toml::node& node, Project& project) {
    return forTexts("include", node, kInclude, [&](const std::string& name, const toml::node& element) {
      project.includePaths.push_back(inFolder(name));
      std::error_code error;
      if (!fs::is_directory(project.includePaths.back(), error))
        missing(element, project.includePaths.back(), "a folder");
    });
  }

  bool takeNc(const toml::node& node, Project&) {
    const std::string text = text::stringOf(node);
    addSetting("nc", text, node);
    return text == "scripted" || text == "simulated";
  }

  bool takeEncoding(const toml::node& node, Project&) {
    const std::string text = text::stringOf(node);
    addSetting("encoding", text, node);
    return knowsEncoding(text);
  }

  bool takeScenarios(const toml::node& node, Project& project) {
    return forTexts("scenarios", node, kScenarios, [&](const std::string& pattern, const toml::node& element) {
      const std::vector<std::string> found = matchPattern(project.folder, pattern);
      if (found.empty() && !isPattern(pattern)) missing(element, inFolder(pattern), "a file");
      for (const std::string& file : found)
        if (std::ranges::find(project.scenarios, file) == project.scenarios.end()) project.scenarios.push_back(file);
    });
  }

  // The files may be missing: rungc bind makes them from the project.
  bool takeBindings(const toml::node& node, Project& project) {
    return forTexts("bindings", node, kBindings,
                    [&](const std::string& name, const toml::node&) { project.bindings.push_back(inFolder(name)); });
  }

  bool takeConfig(const toml::node& node, Project&) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return false;
    for (const std::string_view key : {"nc", "encoding"})
      if (const toml::node* own = table->get(key))
        wrong(own->source(), "config", std::string(key),
              fmt::format("keys of the dialect; write {} = before the tables", key), "");
    readSettings(*table, "");
    return true;
  }

  // `tmr.1 = 480` and `[config.tmr]` with `1 = 480` both set the key tmr.1.
  void readSettings(const toml::table& table, const std::string& prefix) {
    for (const auto& [name, node] : table) {
      const std::string key = prefix + std::string(name.str());
      if (const toml::table* inner = node.as_table())
        readSettings(*inner, key + ".");
      else if (node.is_string())
        addSetting(key, text::stringOf(node), node);
      else if (node.is_number())
        addSetting(key, text::textOf(node), node);
      else
        wrong(node, key, "a text or a number", "");
    }
  }

  void addSetting(const std::string& key, std::string value, const toml::node& node) {
    const SourceRange range = rangeOf(node);
    project_.config.push_back({key, std::move(value), sources_.offsetOf(range.begin), sources_.offsetOf(range.end)});
  }

  // File names in the configuration are relative to the project file; their readers look in other folders.
  void placeFile(Setting& setting) {
    const frontend::Dialect* dialect = frontend::findDialect(project_.dialect);
    const nc::ConfigKey* row = dialect == nullptr ? nullptr : nc::findConfigKey(dialect->configKeys, setting.key);
    if (row == nullptr || row->form != nc::ConfigForm::File) return;
    std::error_code error;
    const std::string path = inFolder(setting.value);
    if (!fs::exists(path, error))
      diagnostics_.report(diag::MissingProjectFile, sources_.range(fileId_, setting.begin, setting.end))
          << path << nc::takesOf(*row);
    setting.value = fs::absolute(path, error).string();
  }

  SourceManager& sources_;
  FileId fileId_;
  Diagnostics& diagnostics_;
  Project project_;
};

const Reader::Key Reader::kKeys[] = {
    {"name", false, "a name without a folder", "name = \"mill\"", &Reader::takeName},
    {"dialect", true, kDialects, "dialect = \"gsk\"", &Reader::takeDialect},
    {"files", true, kFiles, "files = [\"main.lad\", \"io.lad\"]", &Reader::takeFiles},
    {"encoding", false, "the name of an encoding, such as \"gb18030\"", "encoding = \"gb18030\"",
     &Reader::takeEncoding},
    {"include", false, kInclude, "include = [\"../common\"]", &Reader::takeInclude},
    {"nc", false, "\"scripted\" or \"simulated\"", "nc = \"simulated\"", &Reader::takeNc},
    {"scenarios", false, kScenarios, "scenarios = [\"*.scn\"]", &Reader::takeScenarios},
    {"bindings", false, kBindings, "bindings = [\"nc_binding.h\"]", &Reader::takeBindings},
    {"config", false, "a table, [config]", "[config] and KEY = VALUE in the lines after it", &Reader::takeConfig},
};

} // namespace

std::optional<Project> load(SourceManager& sources, const std::string& file, Diagnostics& diagnostics) {
  const Result<FileId> id = sources.addFile(file);
  if (!id.ok()) {
    diagnostics.report(diag::FileNotFound) << file << id.error();
    return std::nullopt;
  }
  const size_t before = diagnostics.errorCount();
  Project project = Reader(sources, id.value(), diagnostics).read(file);
  if (diagnostics.errorCount() != before) return std::nullopt;
  return project;
}

std::map<std::string, std::string> configOf(const Project& project) {
  std::map<std::string, std::string> config;
  for (const Setting& setting : project.config) config[setting.key] = setting.value;
  return config;
}

std::map<std::string, SourceRange> placesOf(const Project& project, const std::map<std::string, std::string>& config,
                                            SourceManager& sources) {
  std::map<std::string, SourceRange> places;
  const Result<FileId> file = sources.addFile(project.file);
  if (!file.ok()) return places;
  for (const Setting& setting : project.config) {
    const auto used = config.find(setting.key);
    if (used != config.end() && used->second == setting.value) // otherwise another value takes precedence
      places[setting.key] = sources.range(file.value(), setting.begin, setting.end);
  }
  return places;
}

// Finds a project file, and whether a file is part of its project.

namespace fs = std::filesystem;

std::optional<std::string> findUpwards(const std::string& folder) {
  std::error_code error;
  fs::path above = fs::absolute(folder.empty() ? "." : folder, error).lexically_normal();
  if (!above.has_filename()) above = above.parent_path(); // `above` was written with a slash at its end
  for (fs::path shown = folder;; shown /= "..", above = above.parent_path()) {
    const fs::path file = (shown / kFileName).lexically_normal();
    if (fs::is_regular_file(file, error)) return file.string();
    if (above == above.root_path()) return std::nullopt;
  }
}

std::string productOf(const Project& project, std::string_view ending) {
  return (fs::path(project.folder) / (project.name + std::string(ending))).lexically_normal().string();
}

bool hasFile(const Project& project, const std::string& file) {
  std::error_code error;
  return std::any_of(project.files.begin(), project.files.end(),
                     [&](const std::string& own) { return fs::equivalent(own, file, error); });
}

// Finds files by patterns.

namespace {

namespace fs = std::filesystem;

// Adds the files in this folder that match `part` and the parts after it.
void match(const fs::path& folder, fs::path::const_iterator part, fs::path::const_iterator end,
           std::vector<std::string>& found) {
  std::error_code error;
  if (part == end) {
    if (fs::is_regular_file(folder, error)) found.push_back(folder.string());
    return;
  }
  const auto next = std::next(part);
  if (!isPattern(part->string())) return match((folder / *part).lexically_normal(), next, end, found);
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const fs::path name = entry.path().filename();
    if (fnmatch(part->c_str(), name.c_str(), FNM_PERIOD) == 0) match(folder / name, next, end, found);
  }
}

} // namespace

bool isPattern(std::string_view text) { return text.find_first_of("*?[") != std::string_view::npos; }

std::vector<std::string> matchPattern(const std::string& folder, std::string_view pattern) {
  const fs::path parts(pattern);
  std::vector<std::string> found;
  match(parts.is_absolute() ? fs::path() : fs::path(folder), parts.begin(), parts.end(), found);
  std::sort(found.begin(), found.end());
  return found;
}

namespace {

struct Kind {
  std::string_view name;
  std::string_view use; // how to use the file {0}
};

// In the order of FileKind.
constexpr Kind kKinds[] = {{"a file of another kind", ""},
                           {"a program", "`rungc check {0}` checks it"},
                           {"a compiled program", "`rungc run {0}` runs it"},
                           {"a scenario", "`rungc test {0}` runs it"},
                           {"a mapping file", "`rungc map --check {0} PROGRAM` checks it"},
                           {"a binding file", "`rungc bind --members {0}` connects its members"},
                           {"a project file", "`rungc check --project {0}` checks its program"}};

const Kind& infoOf(FileKind kind) { return kKinds[static_cast<size_t>(kind)]; }

} // namespace

FileKind kindOfFile(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  const std::string extension = name.extension().string();
  if (extension == ".so") return FileKind::Compiled;
  if (extension == ".scn") return FileKind::Scenario;
  if (extension == ".map") return FileKind::Map;
  if (extension == ".bind") return FileKind::Binding;
  if (extension == ".toml" && name != kFileName) return FileKind::Project; // rung.toml means its program
  const std::vector<std::string_view> programs = frontend::programExtensions();
  return std::ranges::find(programs, extension) != programs.end() ? FileKind::Program : FileKind::Other;
}

std::string otherKind(const std::string& path, FileKind wanted) {
  const FileKind kind = kindOfFile(path);
  if (kind == wanted || kind == FileKind::Other) return {};
  return fmt::format("'{}' is {}, not {}: {}", path, infoOf(kind).name, infoOf(wanted).name,
                     fmt::format(fmt::runtime(infoOf(kind).use), path));
}

} // namespace rung::compiler
