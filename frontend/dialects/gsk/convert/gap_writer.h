// Gaps as text, for the writers of both forms.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "frontend/dialects/gsk/convert/source_model.h"

namespace rung::gsk::convert {

enum class Form : uint8_t { List, Ladder };

// Appends `text` as lines; blank lines stand where the form or the author wants them, never two of them.
class Page {
public:
  explicit Page(Form form) : form_(form) {}
  void line(std::string_view text, std::string_view comment = {});
  void comment(std::string_view text) { line(text.empty() ? ";" : std::string("; ").append(text)); }
  void blank();
  void gap(const Gap& gap);
  std::string take() { return std::move(text_); }

private:
  size_t declarations(const Gap& gap, size_t first);

  Form form_;
  std::string text_;
  bool blank_ = true; // the last line is blank, or there is none
};

// Blank lines at both ends gone, others single, sections apart.
Gap tidy(const Gap& gap);
// `gap` with every comment that would be taken for the title, but is not, made none by a further ';'.
Gap protect(Gap gap, std::string_view title);
// The comment that the rule of titles finds; nullopt where there is none.
std::optional<size_t> titleIn(const Gap& gap);

} // namespace rung::gsk::convert
