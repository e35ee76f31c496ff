// See uri.h.
#include "tools/lsp/uri.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "rtlib/text/letters.h"

namespace rung::lsp {
namespace {

constexpr std::string_view kFile = "file://";

bool staysInUri(char c) {
  return text::isLetter(c) || text::isDigit(c) || std::string_view("/-._~").find(c) != std::string_view::npos;
}

std::string decoded(std::string_view uri) {
  std::string text;
  for (size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? text::hexDigit(uri[i + 1]) : -1;
    const int low = high < 0 ? -1 : text::hexDigit(uri[i + 2]);
    if (low < 0) {
      text += uri[i];
      continue;
    }
    text += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return text;
}

} // namespace

std::string pathOf(std::string_view uri) {
  if (!uri.starts_with(kFile)) return std::string(uri);
  std::string_view path = uri.substr(kFile.size());
  path.remove_prefix(std::min(path.find('/'), path.size())); // the host, which is this one
  return std::filesystem::path(decoded(path)).lexically_normal().string();
}

std::string uriOf(std::string_view path) {
  if (!path.starts_with('/')) return std::string(path);
  std::string uri(kFile);
  for (const char c : path) {
    if (staysInUri(c))
      uri += c;
    else
      uri += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return uri;
}

std::string pathOf(const SourceManager& sources, FileId file) {
  return std::filesystem::absolute(sources.name(file)).lexically_normal().string();
}

} // namespace rung::lsp
