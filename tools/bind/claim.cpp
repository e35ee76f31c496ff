// See claim.h.
#include "tools/bind/claim.h"

#include <fmt/format.h>

#include "ir/support/hash.h"

namespace rung::bind {
namespace {

constexpr std::string_view kBegin = "/* rung-binding 1 ";
constexpr std::string_view kLine = " *   ";
constexpr std::string_view kEnd = " */";

std::string headOf(std::string_view name, uint64_t hash) { return fmt::format("{}{} {:016x}\n", kBegin, name, hash); }

} // namespace

uint64_t hashOf(std::string_view text) { return hashBytes(text); }

std::string claimText(std::string_view name, std::string_view text) {
  std::string out = headOf(name, hashOf(text));
  while (!text.empty()) {
    const size_t end = text.find('\n') + 1;
    out += fmt::format("{}{}", kLine, text.substr(0, end));
    text.remove_prefix(end);
  }
  return fmt::format("{}{}\n", out, kEnd);
}

Result<Claim> claimIn(std::string_view file) {
  const size_t begin = file.find(kBegin);
  if (begin == std::string_view::npos) return failure("it is not a file that rungc bind has made");
  std::string_view rest = file.substr(begin);
  const size_t nameEnd = rest.find(' ', kBegin.size());
  const size_t headEnd = rest.find('\n');
  Claim claim;
  if (nameEnd < headEnd && headEnd != std::string_view::npos) {
    claim.name = rest.substr(kBegin.size(), nameEnd - kBegin.size());
    const std::string_view head = rest.substr(0, headEnd + 1);
    rest.remove_prefix(headEnd + 1);
    while (rest.starts_with(kLine)) {
      const size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
      claim.text += rest.substr(kLine.size(), end - kLine.size());
      rest.remove_prefix(end);
    }
    if (rest.starts_with(kEnd) && head == headOf(claim.name, hashOf(claim.text))) return claim;
  }
  return failure("it was changed after rungc bind has made it; run rungc bind again");
}

} // namespace rung::bind
