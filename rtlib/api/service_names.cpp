// Lists of names (see service_names.h).
#include "rtlib/api/service_names.h"

#include <algorithm>
#include <utility>

namespace rung::api {

const char* const* ServiceNames::of(const rung_program& program) {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> texts(program.services, program.services + program.service_count);
  const auto known = std::ranges::find(lists_, texts, &List::texts);
  if (known != lists_.end()) return known->names.data();
  List& list = lists_.emplace_back();
  list.texts = std::move(texts);
  for (const std::string& text : list.texts) list.names.push_back(text.c_str());
  return list.names.data();
}

} // namespace rung::api
