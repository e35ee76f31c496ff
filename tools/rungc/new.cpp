// rungc new: makes a small complete project.
#include "tools/rungc/new.h"

#include <fmt/format.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <memory>

#include "rtlib/text/similar.h"
#include "tools/rungc/commands.h"

namespace rung::rungc {
namespace {

namespace fs = std::filesystem;

// The path of the file in a project of this dialect; empty for a file of another dialect.
std::string placeOf(const text::EmbeddedFile& file, std::string_view dialect) {
  if (file.name == "gitignore") return ".gitignore";
  const size_t slash = file.name.find('/');
  return file.name.substr(0, slash) == dialect ? std::string(file.name.substr(slash + 1)) : std::string();
}

bool writeTemplate(const fs::path& path, const std::string& text) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  std::ofstream file(path, std::ios::binary);
  file << text << std::flush;
  return file.good();
}

// Writes program, scenario, project file and .gitignore of this dialect, with the name of the project in them, to a
// folder that is empty or does not exist; returns the files. The error is a text for the user.
Result<std::vector<std::string>> makeProject(std::string_view dialect, const std::string& folder) {
  std::error_code error;
  const fs::path root = fs::path(folder).lexically_normal();
  if (fs::exists(root, error) && !fs::is_directory(root, error)) return failure(fmt::format("'{}' is a file", folder));
  if (fs::exists(root, error) && !fs::is_empty(root, error))
    return failure(fmt::format("the folder '{}' is not empty; a new project needs one of its own", folder));
  const fs::path whole = fs::absolute(root, error).lexically_normal();
  const std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  const text::Mark marks[] = {{"NAME", name}};
  std::vector<std::string> written;
  for (const text::EmbeddedFile& file : projectTemplates()) {
    const std::string place = placeOf(file, dialect);
    if (place.empty()) continue;
    written.push_back((root / place).lexically_normal().string());
    if (!writeTemplate(written.back(), text::filled(file.text, marks)))
      return failure(fmt::format("cannot write '{}'", written.back()));
  }
  return written;
}

// "gsk, nct and technol", with the last word.
std::string dialectNames(std::string_view last) {
  std::string names;
  const std::span<const frontend::Dialect* const> all = frontend::allDialects();
  for (size_t i = 0; i < all.size(); ++i) {
    if (i > 0) names += i + 1 == all.size() ? fmt::format(" {} ", last) : ", ";
    names += all[i]->name;
  }
  return names;
}

int makeNew(const std::string& dialect, const std::string& folder) {
  if (frontend::findDialect(dialect) == nullptr)
    return usageError(
        fmt::format("unknown dialect '{}'{}; the dialects are {}", dialect,
                    text::didYouMean(text::mostSimilar(dialect, frontend::allDialects(), &frontend::Dialect::name)),
                    dialectNames("and")));
  const Result<std::vector<std::string>> written = makeProject(dialect, folder);
  if (!written.ok()) return environmentError(written.error());
  for (const std::string& file : written.value()) fmt::print("{}\n", file);
  fmt::print("try: {} test '{}'\n", program_invocation_name, folder); // as the user has typed it
  return kOk;
}

} // namespace

void addNew(CommandLine& app, int& status) {
  struct Options {
    std::string dialect;
    std::string folder;
  };
  Command command = app.add("new", "Create a small complete project: program, scenario, project file");
  auto options = std::make_shared<Options>();
  command.option("DIALECT", options->dialect, dialectNames("or")).required();
  command.option("DIR", options->folder, "The folder to create; its name is the name of the project").required();
  command.onRun([options, &status] { status = makeNew(options->dialect, options->folder); });
}

} // namespace rung::rungc
