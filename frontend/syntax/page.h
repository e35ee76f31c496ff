// A source file as a formatter writes it: its lines with the comments after them, tables in columns, blank lines only
// where the author has some, never two in a row. Common to all languages with one statement per line; the contents of
// lines depend on the language.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rung::frontend {

/// Lines of up to three cells in columns; one object for each kind of lines, identified by its address. The last cell
/// of a line has any length.
struct Table {
  size_t second = 0; ///< the smallest columns of the second and the third cell
  size_t third = 0;
  bool alignsThird = true;  ///< or a blank after the second cell if that is longer
  bool endsAtBlank = false; ///< line; otherwise all rows of a file without another statement between them are one table
};

class Page {
public:
  /// Line ends and byte order mark are those of `source`. Widths are counted in its characters, or in its bytes if it
  /// is not UTF-8. Comments after lines begin in `commentColumn` or beyond.
  Page(std::string_view source, size_t commentColumn);

  /// Comments, with their first character, of consecutive lines are in one column. A line that is only a comment, with
  /// an empty `text`, continues that of the line above.
  void line(std::string text, std::string_view comment = {});
  /// A line of a table, which separate comments do not end; all its comments are in one column.
  void row(const Table& table, std::vector<std::string> cells, std::string_view comment = {});
  /// A line, as above, that does not end the current table.
  void aside(std::string text, std::string_view comment = {});
  /// A comment on a separate line, with the blanks before it.
  void comment(std::string_view text);
  void blank();

  /// The characters, or bytes, of a text.
  size_t width(std::string_view text) const;
  std::string take();

private:
  struct Line {
    const Table* table = nullptr;
    std::vector<std::string> cells; ///< one if it is not part of a table
    std::string comment;
    size_t commentColumn = 0;
    bool aside = false; ///< does not end a table

    bool isTable() const { return table != nullptr; }
    bool isBlank() const { return text().empty() && comment.empty(); }
    const std::string& text() const { return cells.front(); }
  };

  size_t endOfTable(size_t first) const;
  size_t secondColumn(size_t first, size_t end) const;
  size_t thirdColumn(size_t first, size_t end, size_t second) const;
  void layOutTable(size_t first, size_t end);
  void alignComments(size_t first, size_t end);
  void layOut();

  std::string_view lineEnd_;
  std::string_view mark_;
  bool countsBytes_;
  size_t commentColumn_;
  std::vector<Line> lines_;
};

/// Without blanks, tabs and carriage returns at its end.
std::string_view withoutTrailingSpace(std::string_view text);

} // namespace rung::frontend
