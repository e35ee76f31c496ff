// See template.h.
#include "tools/bind/template.h"

#include <fmt/format.h>

#include "tools/bind/member.h"

namespace rung::bind {

std::string templateOf(const codegen::HostLayout& layout) {
  std::string text =
      fmt::format("# {}: its members, and where they lie. Move those that the program reads below [in], "
                  "those that\n# it writes below [out], and give each the program's name.\n[in]\n\n[out]\n\n",
                  layout.name);
  forEachNumber(layout, [&](const std::string& path, const Member& member) {
    std::string type = member.is->type;
    for (const uint64_t length : member.lengths) type += fmt::format("[{}]", length);
    if (member.is->bits != 0) type += fmt::format(" : {}", member.is->bits);
    const std::string place =
        member.is->bits == 0 ? fmt::format("{}", member.bit / 8) : fmt::format("{}.{}", member.bit / 8, member.bit % 8);
    text += fmt::format("# {} = \"\" # {} at {}\n",
                        path.find('[') == std::string::npos ? path : fmt::format("\"{}\"", path), type, place);
  });
  return text;
}

} // namespace rung::bind
