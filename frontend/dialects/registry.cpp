// The list of dialects. A new dialect is a folder beside this file and one line here.
#include <array>

#include "frontend/dialects/dialect.h"
#include "frontend/dialects/fanuc/fanuc.h"
#include "frontend/dialects/gsk/gsk.h"
#include "frontend/dialects/nct/nct.h"
#include "frontend/dialects/technol/technol.h"
#include "frontend/ladder/text/ladder_file.h"
#include "rtlib/text/letters.h"

namespace rung::frontend {

std::span<const Dialect* const> allDialects() {
  static constexpr std::array<const Dialect*, 4> kAll = {&fanuc::kFanuc, &gsk::kGsk, &nct::kNct, &technol::kTechnol};
  return kAll;
}

const Dialect* findDialect(std::string_view name) {
  for (const Dialect* dialect : allDialects())
    if (dialect->name == name) return dialect;
  return nullptr;
}

std::vector<std::string_view> programExtensions() {
  std::vector<std::string_view> extensions = {".lad"};
  for (const Dialect* dialect : allDialects())
    extensions.insert(extensions.end(), dialect->extensions.begin(), dialect->extensions.end());
  return extensions;
}

const Dialect* dialectOf(const SourceManager& sources, FileId file) {
  if (const Dialect* named = findDialect(ladder::peekDialect(sources, file))) return named;
  const std::string name = text::lower(sources.name(file));
  for (const Dialect* dialect : allDialects())
    for (std::string_view extension : dialect->extensions)
      if (name.ends_with(extension)) return dialect;
  return nullptr;
}

} // namespace rung::frontend
