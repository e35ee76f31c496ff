// Files that the build embeds in a program as text (rung_embed in cmake/RungHelpers.cmake), and marks to fill in.
#pragma once
#include <algorithm>
#include <span>
#include <string>
#include <string_view>

namespace rung::text {

struct EmbeddedFile {
  std::string_view name; // its path in the folder that was embedded
  std::string_view text;
};

// The text of the file `name`, which must be one of the files.
inline std::string_view textOf(std::span<const EmbeddedFile> files, std::string_view name) {
  return std::ranges::find(files, name, &EmbeddedFile::name)->text;
}

struct Mark {
  std::string_view name;
  std::string_view text;
};

// The text with each {{NAME}} replaced by the text of that mark, which is not searched for marks.
inline std::string filled(std::string_view text, std::span<const Mark> marks) {
  std::string out;
  for (size_t at = text.find("{{"); at != std::string_view::npos; at = text.find("{{")) {
    const std::string_view rest = text.substr(at + 2);
    const auto mark = std::ranges::find_if(marks, [&](const Mark& one) {
      return rest.starts_with(one.name) && rest.substr(one.name.size()).starts_with("}}");
    });
    const bool found = mark != marks.end();
    out.append(text.substr(0, at)).append(found ? mark->text : "{");
    text.remove_prefix(at + (found ? mark->name.size() + 4 : 1));
  }
  return out.append(text);
}

} // namespace rung::text
