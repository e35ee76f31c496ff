// Format: a line with the version, then entries: a letter, the lengths of key and value (4 bytes each, low byte first),
// key and value.
#include "machine/compile/sources.h"

#include <algorithm>
#include <stdexcept>

#include "machine/compile/compilation.h"

namespace rung::compile {

namespace {

constexpr std::string_view kHead = "rung-sources 1\n";
constexpr unsigned kLengthBytes = 4;

enum Entry : char {
  Dialect = 'd',
  Name = 'n',
  File = 'f',
  Include = 'i',
  Config = 'c',
  Profile = 'p',
  Text = 't',
  End = 'e'
};

void put(std::string& out, Entry entry, std::string_view key, std::string_view value = {}) {
  out += static_cast<char>(entry);
  putNumber(out, key.size(), kLengthBytes);
  putNumber(out, value.size(), kLengthBytes);
  out += key;
  out += value;
}

// Returns false if there is no such entry.
bool keep(Sources& to, char entry, std::string_view key, std::string_view value) {
  switch (entry) {
  case Entry::Dialect: to.dialect = key; return true;
  case Entry::Name: to.name = key; return true;
  case Entry::File: to.files.emplace_back(key); return true;
  case Entry::Include: to.includePaths.emplace_back(key); return true;
  case Entry::Config: to.config[std::string(key)] = value; return true;
  case Entry::Profile: to.profile = true; return true;
  case Entry::Text: to.texts[std::string(key)] = value; return true;
  default: return false;
  }
}

std::string problemOf(const Sources& sources) {
  if (sources.files.empty()) return "found no file, expected one at least";
  if (sources.texts.size() > kMostFiles || sources.files.size() > kMostFiles)
    return "found more than " + std::to_string(kMostFiles) + " files";
  const auto lacksText = [&](const std::string& file) { return !sources.texts.contains(file); };
  const auto lacking = std::ranges::find_if(sources.files, lacksText);
  return lacking == sources.files.end() ? "" : "found no text of the file " + *lacking + ", expected one";
}

} // namespace

std::string packed(const Sources& sources) {
  std::string out(kHead);
  if (!sources.dialect.empty()) put(out, Entry::Dialect, sources.dialect);
  if (!sources.name.empty()) put(out, Entry::Name, sources.name);
  for (const std::string& file : sources.files) put(out, Entry::File, file);
  for (const std::string& folder : sources.includePaths) put(out, Entry::Include, folder);
  for (const auto& [key, value] : sources.config) put(out, Entry::Config, key, value);
  if (sources.profile) put(out, Entry::Profile, {});
  for (const auto& [path, text] : sources.texts) put(out, Entry::Text, path, text);
  put(out, Entry::End, {});
  return out;
}

std::optional<Sources> unpacked(std::string_view bytes, std::string& problem) {
  ByteReader reader(bytes);
  Sources sources;
  bool known = reader.take(kHead.size()) == kHead;
  bool ended = false;
  while (known && !ended) {
    const std::string_view entry = reader.take(1);
    const size_t keyLength = reader.takeNumber(kLengthBytes);
    const size_t valueLength = reader.takeNumber(kLengthBytes);
    const std::string_view key = reader.take(keyLength);
    const std::string_view value = reader.take(valueLength);
    ended = reader.good() && entry.front() == Entry::End;
    known = reader.good() && (ended || keep(sources, entry.front(), key, value));
  }
  problem = known && reader.atEnd() ? problemOf(sources) : "found bytes that are not sources, or not all of them";
  return problem.empty() ? std::optional(std::move(sources)) : std::nullopt;
}

Image compiledImage(const std::string& path, uid_t user, std::string& warnings) {
  Compilation compilation({path}, user);
  const Compilation::State state = compilation.wait();
  if (state == Compilation::State::Errors) throw std::runtime_error(compilation.report()); // each error names its file
  if (state != Compilation::State::Compiled)
    throw std::runtime_error("cannot compile " + path + ": " + compilation.report());
  warnings = compilation.report();
  return Image::ofMemory(compilation.image(), path);
}

} // namespace rung::compile
