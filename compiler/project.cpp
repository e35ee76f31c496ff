// Reading the project file.
#include "compiler/project.h"

#include <fmt/format.h>
#include <fnmatch.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
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

constexpr std::array<std::string_view, 10> kKeys = {"name", "dialect",   "files",    "encoding", "include",
                                                    "nc",   "scenarios", "bindings", "config"};

std::string_view kindOf(const toml::node& node) {
  switch (node.type()) {
  case toml::node_type::table: return "a table";
  case toml::node_type::array: return "a list";
  case toml::node_type::string: return "a text";
  case toml::node_type::integer:
  case toml::node_type::floating_point: return "a number";
  case toml::node_type::boolean: return "true or false";
  default: return "a date or a time";
  }
}

class Reader {
public:
  Reader(SourceManager& sources, FileId file, Diagnostics& diagnostics)
      : sources_(sources), file_(file), diagnostics_(diagnostics) {}

  Project read(const std::string& path) {
    project_.file = path;
    project_.folder = fs::path(path).parent_path().string();
    try {
      readTable(text::parse(sources_.text(file_), path));
    } catch (const toml::parse_error& error) {
      diagnostics_.report(diag::ProjectSyntax, rangeOf(error.source())) << error.description();
    }
    return std::move(project_);
  }

private:
  SourcePos positionOf(toml::source_position at) const {
    const uint32_t line = std::clamp<uint32_t>(at.line, 1, sources_.lineCount(file_));
    const std::string_view text = sources_.lineText(file_, line);
    size_t offset = 0;
    for (uint32_t column = 1; column < at.column && offset < text.size(); ++column)
      offset += decodeUtf8(text, offset).length;
    return sources_.position(file_, static_cast<size_t>(text.data() - sources_.text(file_).data()) + offset);
  }
  // Of a text over several lines the first one is meant.
  SourceRange rangeOf(const toml::source_region& region) const {
    const SourcePos begin = positionOf(region.begin);
    const SourcePos end = region.end.line == region.begin.line ? positionOf(region.end) : begin;
    return {begin, std::max(begin, end)};
  }
  SourceRange start() const { return sources_.range(file_, 0, 0); }

  void wrong(std::string_view key, const toml::node& node, std::string_view expected, std::string_view found) {
    diagnostics_.report(diag::ProjectValue, rangeOf(node.source())) << key << found << expected;
  }

  void reportUnknown(const toml::key& key) {
    const SourceRange range = rangeOf(key.source());
    DiagBuilder report = diagnostics_.report(diag::UnknownProjectKey, range);
    report << key.str();
    const frontend::Dialect* dialect = frontend::findDialect(project_.dialect);
    const frontend::ForeignWord* foreign =
        dialect == nullptr ? nullptr : frontend::findForeign(dialect->foreignKeys, key.str());
    if (foreign != nullptr) return frontend::explainForeign(report, range, *foreign, false);
    const text::Likely meant = text::likeliest(key.str(), kKeys);
    suggest(report, range, meant);
    if (meant.word.empty())
      report.note("the keys of a project file are name, dialect, files, include, nc, scenarios, bindings; those "
                  "of the dialect's configuration belong in the table [config]");
  }

  void readTable(const toml::table& table) {
    if (const toml::node* node = table.get("name")) readName(*node);
    if (project_.name.empty()) project_.name = folderName();
    readDialect(table.get("dialect"));
    for (const auto& [key, node] : table)
      if (std::find(kKeys.begin(), kKeys.end(), key.str()) == kKeys.end()) reportUnknown(key);
    readFiles(table.get("files"));
    if (const toml::node* node = table.get("include")) readInclude(*node);
    if (const toml::node* node = table.get("encoding")) readEncoding(*node);
    if (const toml::node* node = table.get("nc")) readNc(*node);
    if (const toml::node* node = table.get("scenarios")) readScenarios(*node);
    if (const toml::node* node = table.get("bindings")) readBindings(*node);
    if (const toml::node* node = table.get("config")) readConfig(*node);
    for (Setting& setting : project_.config) placeFile(setting);
    std::stable_sort(project_.config.begin(), project_.config.end(),
                     [](const Setting& a, const Setting& b) { return a.begin < b.begin; });
  }

  std::string folderName() const {
    std::error_code error;
    const fs::path whole = fs::absolute(project_.folder.empty() ? "." : project_.folder, error).lexically_normal();
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  }

  std::optional<std::string> textOf(std::string_view key, const toml::node& node, std::string_view expected) {
    const auto text = node.value_exact<std::string>();
    if (!text) wrong(key, node, expected, kindOf(node));
    return text;
  }

  // Calls act(text, node) for every text of a list.
  template <class Act>
  void forTexts(std::string_view key, const toml::node& node, std::string_view example, Act act) {
    const toml::array* list = node.as_array();
    const std::string expected = fmt::format("a list of texts such as {}", example);
    if (list == nullptr) return wrong(key, node, expected, kindOf(node));
    for (const toml::node& element : *list)
      if (const auto text = textOf(key, element, expected)) act(*text, element);
  }

  std::string inFolder(std::string_view name) const {
    return (fs::path(project_.folder) / name).lexically_normal().string();
  }

  void readName(const toml::node& node) {
    const auto text = textOf("name", node, "a text");
    if (!text) return;
    if (text->empty() || text->find('/') != std::string::npos)
      wrong("name", node, "a name without a folder", fmt::format("'{}'", *text));
    project_.name = *text;
  }

  void readDialect(const toml::node* node) {
    if (node == nullptr) {
      diagnostics_.report(diag::MissingProjectKey, start())
          << "dialect" << "write dialect = \"nct\", \"gsk\" or \"technol\"";
      return;
    }
    constexpr std::string_view kExpected = "\"nct\", \"gsk\" or \"technol\"";
    const auto text = textOf("dialect", *node, kExpected);
    if (!text) return;
    if (frontend::findDialect(*text) == nullptr) wrong("dialect", *node, kExpected, fmt::format("'{}'", *text));
    project_.dialect = *text;
  }

  void readFiles(const toml::node* node) {
    constexpr std::string_view kExample = "[\"main.lad\", \"io.lad\"]";
    if (node == nullptr) {
      diagnostics_.report(diag::MissingProjectKey, start()) << "files" << fmt::format("write files = {}", kExample);
      return;
    }
    forTexts("files", *node, kExample, [&](const std::string& name, const toml::node& element) {
      project_.files.push_back(inFolder(name));
      std::error_code error;
      if (!fs::is_regular_file(project_.files.back(), error)) missing(element, project_.files.back(), "a file");
    });
    if (node->is_array() && node->as_array()->empty()) wrong("files", *node, "at least one file", "an empty list");
  }

  void readInclude(const toml::node& node) {
    forTexts("include", node, "[\"../common\"]", [&](const std::string& name, const toml::node& element) {
      project_.includePaths.push_back(inFolder(name));
      std::error_code error;
      if (!fs::is_directory(project_.includePaths.back(), error))
        missing(element, project_.includePaths.back(), "a folder");
    });
  }

  void missing(const toml::node& node, const std::string& path, std::string_view what) {
    diagnostics_.report(diag::MissingProjectFile, rangeOf(node.source())) << path << what;
  }

  void readNc(const toml::node& node) {
    constexpr std::string_view kExpected = "\"scripted\" or \"simulated\"";
    const auto text = textOf("nc", node, kExpected);
    if (!text) return;
    if (*text != "scripted" && *text != "simulated") return wrong("nc", node, kExpected, fmt::format("'{}'", *text));
    addSetting("nc", *text, node);
  }

  void readEncoding(const toml::node& node) {
    constexpr std::string_view kExpected = "the name of an encoding, such as \"gb18030\"";
    const auto text = textOf("encoding", node, kExpected);
    if (!text) return;
    if (!knowsEncoding(*text)) return wrong("encoding", node, kExpected, fmt::format("'{}'", *text));
    addSetting("encoding", *text, node);
  }

  void readScenarios(const toml::node& node) {
    forTexts("scenarios", node, "[\"*.scn\"]", [&](const std::string& pattern, const toml::node& element) {
      const std::vector<std::string> found = matchPattern(project_.folder, pattern);
      if (found.empty() && !isPattern(pattern)) missing(element, inFolder(pattern), "a file");
      for (const std::string& file : found)
        if (std::find(project_.scenarios.begin(), project_.scenarios.end(), file) == project_.scenarios.end())
          project_.scenarios.push_back(file);
    });
  }

  // They may be missing: rungc bind makes them of the project.
  void readBindings(const toml::node& node) {
    forTexts("bindings", node, "[\"nc_binding.h\"]",
             [&](const std::string& name, const toml::node&) { project_.bindings.push_back(inFolder(name)); });
  }

  void addSetting(const std::string& key, std::string value, const toml::node& node) {
    const SourceRange range = rangeOf(node.source());
    project_.config.push_back({key, std::move(value), sources_.offsetOf(range.begin), sources_.offsetOf(range.end)});
  }

  // Files of the configuration lie beside the project file; their readers look in other folders.
  void placeFile(Setting& setting) {
    const frontend::Dialect* dialect = frontend::findDialect(project_.dialect);
    const nc::ConfigKey* row = dialect == nullptr ? nullptr : nc::findConfigKey(dialect->configKeys, setting.key);
    if (row == nullptr || row->form != nc::ConfigForm::File) return;
    std::error_code error;
    const std::string path = inFolder(setting.value);
    if (!fs::exists(path, error))
      diagnostics_.report(diag::MissingProjectFile, sources_.range(file_, setting.begin, setting.end))
          << path << nc::takesOf(*row);
    setting.value = fs::absolute(path, error).string();
  }

  // `tmr.1 = 480` and `[config.tmr]` with `1 = 480` are the key tmr.1.
  void readSettings(const toml::table& table, const std::string& prefix) {
    for (const auto& [name, node] : table) {
      const std::string key = prefix + std::string(name.str());
      if (const toml::table* inner = node.as_table())
        readSettings(*inner, key + ".");
      else if (const auto text = node.value_exact<std::string>())
        addSetting(key, *text, node);
      else if (const auto integer = node.value_exact<int64_t>())
        addSetting(key, std::to_string(*integer), node);
      else if (const auto real = node.value_exact<double>())
        addSetting(key, fmt::format("{}", *real), node);
      else
        wrong(key, node, "a text or a number", kindOf(node));
    }
  }

  void readConfig(const toml::node& node) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return wrong("config", node, "a table, [config]", kindOf(node));
    for (const std::string_view key : {"nc", "encoding"})
      if (const toml::node* own = table->get(key))
        wrong("config", *own, fmt::format("keys of the dialect; write {} = before the tables", key), key);
    readSettings(*table, "");
  }

  SourceManager& sources_;
  FileId file_;
  Diagnostics& diagnostics_;
  Project project_;
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

std::map<std::string, SourceRange> placesOf(const Project& project, const std::map<std::string, std::string>& config,
                                            SourceManager& sources) {
  std::map<std::string, SourceRange> places;
  const Result<FileId> file = sources.addFile(project.file);
  if (!file.ok()) return places;
  for (const Setting& setting : project.config) {
    const auto used = config.find(setting.key);
    if (used != config.end() && used->second == setting.value) // else another value goes before it
      places[setting.key] = sources.range(file.value(), setting.begin, setting.end);
  }
  return places;
}

// Where a project file lies, and whether a file is part of its project.

namespace fs = std::filesystem;

std::optional<std::string> findUpwards(const std::string& folder) {
  std::error_code error;
  fs::path above = fs::absolute(folder.empty() ? "." : folder, error).lexically_normal();
  if (!above.has_filename()) above = above.parent_path(); // written with a slash at its end
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

// Files by patterns.

namespace {

namespace fs = std::filesystem;

// What matches `part` and the parts after it in this folder.
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
  std::string_view use; // of the file {0}
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
