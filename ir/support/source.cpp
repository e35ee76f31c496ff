// Line tables are computed once when a text is added; every query is a binary search.
#include "ir/support/source.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <system_error>

#include "ir/support/check.h"
#include "ir/support/encoding.h"
#include "ir/support/utf8.h"
#include "rtlib/text/end_of_file.h"
#include "rtlib/text/regular_file.h"

namespace rung {

struct SourceManager::File {
  /// The characters before every kStep-th byte are counted once, so that the column in a line of megabytes does not
  /// require a walk over the line.
  static constexpr size_t kStep = 1024;

  std::string name;
  std::string text;
  uint32_t base = 0;                      ///< position of the first byte
  std::vector<uint32_t> lineStarts;       ///< offsets; never empty
  std::vector<uint32_t> charactersBefore; ///< by kStep bytes; empty for a text in ASCII
  std::string encoding;                   ///< the original encoding; "": unchanged
  std::optional<Undecoded> undecoded;
  std::string afterEnd; ///< the bytes from the end-of-file mark on

  void index();
  size_t charactersUpTo(size_t offset) const;
  std::string_view line(size_t index) const;
};

void SourceManager::File::index() {
  lineStarts.push_back(0);
  const char* begin = text.data();
  const char* end = begin + text.size();
  for (const char* at = begin; at != end;) {
    const auto* newline = static_cast<const char*>(std::memchr(at, '\n', static_cast<size_t>(end - at)));
    if (newline == nullptr) break;
    at = newline + 1;
    if (at != end) lineStarts.push_back(static_cast<uint32_t>(at - begin));
  }
  const bool ascii = std::none_of(text.begin(), text.end(), [](char c) { return static_cast<signed char>(c) < 0; });
  if (ascii) return;
  uint32_t count = 0;
  for (size_t i = 0; i <= text.size(); i += kStep) {
    charactersBefore.push_back(count);
    count += static_cast<uint32_t>(countCodePoints(std::string_view(text).substr(i, kStep)));
  }
}

size_t SourceManager::File::charactersUpTo(size_t offset) const {
  if (charactersBefore.empty()) return offset;
  const size_t step = offset / kStep;
  return charactersBefore[step] + countCodePoints(std::string_view(text).substr(step * kStep, offset - step * kStep));
}

std::string_view SourceManager::File::line(size_t lineIndex) const {
  const size_t begin = lineStarts[lineIndex];
  size_t end = lineIndex + 1 < lineStarts.size() ? lineStarts[lineIndex + 1] : text.size();
  if (end > begin && text[end - 1] == '\n') --end;
  if (end > begin && text[end - 1] == '\r') --end;
  return std::string_view(text).substr(begin, end - begin);
}

namespace {

constexpr size_t kMostText = size_t{256} << 20; // of all sources

Result<std::string> readAll(const std::string& path) {
  std::string contents;
  if (std::string problem = text::readRegular(path, text::kMostSource, contents); !problem.empty())
    return failure(std::move(problem));
  return contents;
}

Result<std::string> textOf(const std::map<std::string, std::string>& texts, const std::string& path) {
  const auto found = texts.find(path);
  if (found == texts.end()) return failure("is not among the files of the program");
  return found->second;
}

} // namespace

SourceManager::SourceManager() = default;
SourceManager::SourceManager(std::map<std::string, std::string> texts) : texts_(std::move(texts)) {}
SourceManager::~SourceManager() = default;
SourceManager::SourceManager(SourceManager&&) noexcept = default;
SourceManager& SourceManager::operator=(SourceManager&&) noexcept = default;

Result<FileId> SourceManager::addFile(const std::string& path) {
  if (open_ != nullptr)
    if (const auto found = open_->find(std::filesystem::absolute(path).lexically_normal().string());
        found != open_->end())
      return addOpen(path, found->second);
  Result<std::string> text = texts_ ? textOf(*texts_, path) : readAll(path);
  if (!text) return text.failure();
  if (text.value().size() + nextBase_ > kMostText) return failure("the program has more than 256 MB of sources");
  return texts_ ? addBuffer(path, std::move(text).value()) : addBytes(path, std::move(text).value());
}

FileId SourceManager::addBytes(std::string name, std::string bytes) {
  const std::optional<EncodingLine> line = encodingLine(bytes);
  std::string encoding = line ? line->name : encoding_.empty() ? shownEncoding(bytes) : encoding_;
  std::optional<Undecoded> undecoded;
  const bool known = encoding.empty() || knowsEncoding(encoding);
  // A byte order mark takes precedence over a declared encoding: the editor that saved the file has converted it to
  // UTF-8.
  if (known && !encoding.empty() && bytes.starts_with(kByteOrderMark)) encoding = "UTF-8";
  Decoded text = encoding.empty() || !known ? Decoded{.text = bytes, .wrong = {}} : decoded(bytes, encoding);
  const size_t end = text::upToEndOfFile(text.text).size();
  const bool isMarked = end < text.text.size();
  if (!known)
    undecoded = Undecoded{encoding, false, line ? line->offset : 0};
  else if (text.wrong && !isMarked)
    undecoded = Undecoded{encoding, true, *text.wrong};
  std::string afterEnd;
  if (!undecoded && isMarked) {
    text.text.resize(end);
    const size_t before = encoding.empty() ? end : encoded(text.text, encoding).value_or("").size();
    afterEnd = bytes.substr(std::min(before, bytes.size()));
  }
  const FileId id = addBuffer(std::move(name), undecoded ? std::move(bytes) : std::move(text.text));
  File& added = *files_[id.index];
  added.encoding = std::move(encoding);
  added.undecoded = std::move(undecoded);
  added.afterEnd = std::move(afterEnd);
  return id;
}

// The editor has decoded it, by whatever the file declares.
FileId SourceManager::addOpen(const std::string& path, const std::string& text) {
  const std::optional<EncodingLine> line = encodingLine(text);
  const std::string encoding = line ? line->name : encoding_;
  const std::string_view used = text::upToEndOfFile(text);
  const FileId id = addBuffer(path, std::string(used));
  File& added = *files_[id.index];
  if (line && !knowsEncoding(line->name)) added.undecoded = Undecoded{line->name, false, line->offset};
  added.encoding = encoding;
  added.afterEnd = text.substr(used.size());
  return id;
}

std::vector<std::string> SourceManager::namesIn(const std::string& folder) const {
  std::vector<std::string> names;
  if (!texts_) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error))
      names.push_back(entry.path().filename().string());
    return names;
  }
  const std::string prefix = folder.empty() || folder.ends_with('/') ? folder : folder + "/";
  for (auto text = texts_->lower_bound(prefix); text != texts_->end() && text->first.starts_with(prefix); ++text) {
    const std::string rest = text->first.substr(prefix.size());
    names.push_back(rest.substr(0, rest.find('/')));
  }
  return names;
}

FileId SourceManager::addBuffer(std::string name, std::string text) {
  RUNG_CHECK(text.size() < std::numeric_limits<uint32_t>::max() - nextBase_, "source positions are used up");
  auto file = std::make_unique<File>();
  file->name = std::move(name);
  file->text = std::move(text);
  file->base = nextBase_;
  file->index();
  nextBase_ += static_cast<uint32_t>(file->text.size()) + 1;
  files_.push_back(std::move(file));
  return FileId{static_cast<uint32_t>(files_.size() - 1)};
}

const SourceManager::File& SourceManager::file(FileId id) const {
  RUNG_CHECK(id.index < files_.size(), "no such source file");
  return *files_[id.index];
}

std::string_view SourceManager::name(FileId id) const { return file(id).name; }
std::string_view SourceManager::text(FileId id) const { return file(id).text; }
const std::optional<SourceManager::Undecoded>& SourceManager::undecoded(FileId id) const { return file(id).undecoded; }
bool SourceManager::hasEncoding(FileId id) const { return !file(id).encoding.empty(); }

std::string_view SourceManager::saidEncoding(FileId id) const {
  const File& of = file(id);
  const std::optional<EncodingLine> line = encodingLine(text(id));
  return line && line->name == of.encoding ? std::string_view(of.encoding) : std::string_view();
}

bool SourceManager::isEncodingComment(SourceRange comment) const {
  const FileId id = fileOf(comment.begin);
  const std::optional<EncodingLine> line = encodingLine(text(id));
  return line && offsetOf(comment.begin) <= line->offset && line->offset < offsetOf(comment.end);
}

std::optional<std::string> SourceManager::bytesOf(FileId id, std::string text) const {
  const File& of = file(id);
  std::optional<std::string> bytes =
      of.encoding.empty() || of.undecoded ? std::optional(std::move(text)) : encoded(text, of.encoding);
  if (bytes) *bytes += of.afterEnd;
  return bytes;
}

size_t SourceManager::textAfterEnd(FileId id) const {
  const std::string& rest = file(id).afterEnd;
  constexpr std::string_view kPadding(" \t\r\n\x1A\0", 6);
  return rest.find_first_not_of(kPadding) == std::string::npos ? 0 : rest.size() - 1;
}

uint32_t SourceManager::lineCount(FileId id) const { return static_cast<uint32_t>(file(id).lineStarts.size()); }

std::string_view SourceManager::lineText(FileId id, uint32_t line) const {
  const File& f = file(id);
  RUNG_CHECK(line >= 1 && line <= f.lineStarts.size(), "no such source line");
  return f.line(line - 1);
}

SourcePos SourceManager::position(FileId id, size_t offset) const {
  const File& f = file(id);
  RUNG_CHECK(offset <= f.text.size(), "offset beyond the end of the source");
  return {f.base + static_cast<uint32_t>(offset)};
}

SourceRange SourceManager::range(FileId id, size_t begin, size_t end) const {
  return {position(id, begin), position(id, end)};
}

FileId SourceManager::fileOf(SourcePos pos) const {
  RUNG_CHECK(pos.valid() && pos.value < nextBase_, "position outside all sources");
  const auto after = std::upper_bound(files_.begin(), files_.end(), pos.value,
                                      [](uint32_t value, const auto& f) { return value < f->base; });
  return FileId{static_cast<uint32_t>(after - files_.begin() - 1)};
}

size_t SourceManager::offsetOf(SourcePos pos) const { return pos.value - file(fileOf(pos)).base; }

SourceManager::LineStart SourceManager::lineStart(SourcePos pos) const {
  const FileId id = fileOf(pos);
  const File& f = file(id);
  const auto after = std::upper_bound(f.lineStarts.begin(), f.lineStarts.end(), pos.value - f.base);
  const auto line = static_cast<uint32_t>(after - f.lineStarts.begin());
  return {id, line, f.lineStarts[line - 1]};
}

LineCol SourceManager::lineCol(SourcePos pos) const {
  const LineStart start = lineStart(pos);
  const File& f = file(start.file);
  const size_t column = f.charactersUpTo(pos.value - f.base) - f.charactersUpTo(start.offset) + 1;
  return {f.name, start.line, static_cast<uint32_t>(column)};
}

std::string_view SourceManager::lineText(SourcePos pos) const {
  const LineStart start = lineStart(pos);
  return file(start.file).line(start.line - 1);
}

std::string_view SourceManager::text(SourceRange range) const {
  const File& f = file(fileOf(range.begin));
  RUNG_CHECK(range.begin <= range.end && range.end.value - f.base <= f.text.size(), "range over two sources");
  return std::string_view(f.text).substr(range.begin.value - f.base, range.end.value - range.begin.value);
}

} // namespace rung
