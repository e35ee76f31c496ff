// Source texts and positions in them. Every byte of every file has its own 32-bit position, so that a position
// identifies its file. A file of n bytes owns n + 1 positions (the last one is its end). Position 0 belongs to no file
// and means "no position". Texts never move and live as long as their SourceManager: string_views into them stay valid.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/ids.h"
#include "ir/support/result.h"

namespace rung {

using FileId = Id<struct FileTag>;

struct SourcePos {
  uint32_t value = 0;

  constexpr bool valid() const { return value != 0; }
  constexpr auto operator<=>(const SourcePos&) const = default;
};

/// Half-open: end is the first position after it. begin == end is a position between two characters.
struct SourceRange {
  SourcePos begin;
  SourcePos end;

  constexpr bool valid() const { return begin.valid(); }
  constexpr bool operator==(const SourceRange&) const = default;
};

/// From the beginning of a to the end of b; both must be in one file.
constexpr SourceRange join(SourceRange a, SourceRange b) { return {a.begin, b.end}; }

/// A position for display: line and column count from 1, the column in characters (UTF-8 code points).
struct LineCol {
  std::string_view file;
  uint32_t line = 0;
  uint32_t column = 0;

  bool operator==(const LineCol&) const = default;
};

class SourceManager {
public:
  SourceManager();
  /// With these texts as the only files, by their paths as requested; nothing is read from a disk.
  explicit SourceManager(std::map<std::string, std::string> texts);
  ~SourceManager();
  SourceManager(SourceManager&&) noexcept;
  SourceManager& operator=(SourceManager&&) noexcept;

  /// The encoding of files that do not declare theirs (encodingLine); "", the default: UTF-8, or what the dialect
  /// detects.
  void setEncoding(std::string name) { encoding_ = std::move(name); }
  /// Texts in UTF-8 that an editor has open, by the absolute paths of their files: addFile takes them instead of what
  /// is on the disk. They must outlive its calls.
  void setOpenTexts(const std::map<std::string, std::string>& texts) { open_ = &texts; }
  /// Reads a file. Its text is converted to UTF-8 and ends at a DOS end-of-file mark. Fails if it cannot be read or if
  /// the sources have more than 256 MB in all.
  Result<FileId> addFile(const std::string& path);
  /// Adds a file with these bytes.
  FileId addBytes(std::string name, std::string bytes);
  /// Adds a text in UTF-8.
  FileId addBuffer(std::string name, std::string text);
  /// The names in a folder, "" for the working directory, unordered; empty if there is no such folder.
  std::vector<std::string> namesIn(const std::string& folder) const;

  size_t fileCount() const { return files_.size(); }
  std::string_view name(FileId file) const;
  std::string_view text(FileId file) const;
  /// Why a file could not be decoded from its declared encoding or that of setEncoding. Its text is then the bytes of
  /// the file.
  struct Undecoded {
    std::string encoding;
    bool known = true; ///< false: there is no encoding of this name, which the file declares at `offset`
    size_t offset = 0; ///< of the byte that does not begin a character
  };
  const std::optional<Undecoded>& undecoded(FileId file) const;
  /// Whether the file, or setEncoding, determines the file's encoding.
  bool hasEncoding(FileId file) const;
  /// The encoding that the file declares by a separate line (encodingLine); "" if it does not, or has another encoding.
  std::string_view saidEncoding(FileId file) const;
  /// Whether this is the comment by which a file declares its encoding.
  bool isEncodingComment(SourceRange comment) const;
  /// The bytes of a file with `text` as its new contents: in its encoding, with its end-of-file mark. Nothing if the
  /// encoding lacks a character.
  std::optional<std::string> bytesOf(FileId file, std::string text) const;
  /// The number of bytes after a DOS end-of-file mark in the text, if not all of them are such marks, blanks or zeros.
  size_t textAfterEnd(FileId file) const;
  uint32_t lineCount(FileId file) const;
  /// The text of a line (from 1) without its line end, O(1).
  std::string_view lineText(FileId file, uint32_t line) const;

  SourcePos position(FileId file, size_t offset) const;
  SourceRange range(FileId file, size_t begin, size_t end) const;

  /// These functions take valid positions only; O(log n).
  FileId fileOf(SourcePos pos) const;
  size_t offsetOf(SourcePos pos) const;
  LineCol lineCol(SourcePos pos) const;
  std::string_view lineText(SourcePos pos) const;
  /// The line (from 1) and the offset in bytes of its first character.
  struct LineStart {
    FileId file;
    uint32_t line = 0;
    size_t offset = 0;
  };
  LineStart lineStart(SourcePos pos) const;
  /// The characters of a range within one file.
  std::string_view text(SourceRange range) const;

private:
  struct File;
  const File& file(FileId id) const;
  FileId addOpen(const std::string& path, const std::string& text);

  std::optional<std::map<std::string, std::string>> texts_;  // nothing: files of the file system
  const std::map<std::string, std::string>* open_ = nullptr; // null: none
  std::vector<std::unique_ptr<File>> files_;
  std::string encoding_;
  uint32_t nextBase_ = 1;
};

} // namespace rung
