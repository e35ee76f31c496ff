// See source_links.h.
#include "tools/view/source_links.h"

#include <filesystem>
#include <map>

#include <fmt/format.h>

#include "rtlib/text/letters.h"

namespace rung::view {
namespace {

// What a path may have in a link as it is.
bool isPlain(char c) {
  return text::isDigit(c) || text::isLetter(c) || std::string_view("/._-~").find(c) != std::string_view::npos;
}

std::string encoded(std::string_view path) {
  std::string out;
  for (char c : path) isPlain(c) ? void(out += c) : void(out += fmt::format("%{:02X}", static_cast<unsigned char>(c)));
  return out;
}

void replace(std::string& text, std::string_view what, std::string_view with) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
    text.replace(at, what.size(), with);
}

} // namespace

LinkTo sourceLinks(std::string_view page, std::string_view link) {
  std::error_code unreadable; // a path that cannot be made whole stays as it is
  const std::filesystem::path folder = std::filesystem::absolute(page, unreadable).parent_path().lexically_normal();
  return [folder, link = std::string(link), known = std::map<std::string, std::string>()](const SourceFile& file,
                                                                                          uint32_t line) mutable {
    std::string& whole = known[file.path]; // without the line yet
    if (whole.empty()) {
      std::error_code bad;
      const auto path = std::filesystem::absolute(file.path, bad).lexically_normal();
      whole = link;
      replace(whole, "{file}", encoded(path.lexically_relative(folder).generic_string()));
      replace(whole, "{path}", encoded(path.generic_string()));
    }
    std::string result = whole;
    replace(result, "{line}", std::to_string(line));
    return result;
  };
}

} // namespace rung::view
