// A line with the version, then entries: a letter, the lengths of key and value (4 bytes each, low byte first), both.
#include "tools/sources/sources.h"

#include <algorithm>

namespace rung::sources {
namespace {

constexpr std::string_view kHead = "rung-sources 1\n";

enum Entry : char { Dialect = 'd', File = 'f', Include = 'i', Config = 'c', Profile = 'p', Text = 't', End = 'e' };

void putLength(std::string& out, size_t length) {
  for (unsigned shift = 0; shift < 32; shift += 8) out += static_cast<char>(length >> shift & 0xFF);
}

void put(std::string& out, Entry entry, std::string_view key, std::string_view value = {}) {
  out += static_cast<char>(entry);
  putLength(out, key.size());
  putLength(out, value.size());
  out += key;
  out += value;
}

// The bytes that are left, and whether all were there that were taken.
class Reader {
public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}
  bool atEnd() const { return rest_.empty(); }
  bool good() const { return good_; }
  std::string_view take(size_t count) {
    good_ = good_ && count <= rest_.size();
    const std::string_view taken = rest_.substr(0, good_ ? count : 0);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  size_t takeLength() {
    size_t length = 0;
    unsigned shift = 0;
    for (const char byte : take(4)) {
      length |= size_t{static_cast<uint8_t>(byte)} << shift;
      shift += 8;
    }
    return length;
  }

private:
  std::string_view rest_;
  bool good_ = true;
};

// False: there is no such entry.
bool keep(Sources& to, char entry, std::string_view key, std::string_view value) {
  switch (entry) {
  case Entry::Dialect: to.dialect = key; return true;
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
  for (const std::string& file : sources.files) put(out, Entry::File, file);
  for (const std::string& folder : sources.includePaths) put(out, Entry::Include, folder);
  for (const auto& [key, value] : sources.config) put(out, Entry::Config, key, value);
  if (sources.profile) put(out, Entry::Profile, {});
  for (const auto& [path, text] : sources.texts) put(out, Entry::Text, path, text);
  put(out, Entry::End, {});
  return out;
}

std::optional<Sources> unpacked(std::string_view bytes, std::string& problem) {
  Reader reader(bytes);
  Sources sources;
  bool known = reader.take(kHead.size()) == kHead;
  bool ended = false;
  while (known && !ended) {
    const std::string_view entry = reader.take(1);
    const size_t keyLength = reader.takeLength();
    const size_t valueLength = reader.takeLength();
    const std::string_view key = reader.take(keyLength);
    const std::string_view value = reader.take(valueLength);
    ended = reader.good() && entry.front() == Entry::End;
    known = reader.good() && (ended || keep(sources, entry.front(), key, value));
  }
  problem = known && reader.atEnd() ? problemOf(sources) : "found bytes that are not sources, or not all of them";
  return problem.empty() ? std::optional(std::move(sources)) : std::nullopt;
}

} // namespace rung::sources
