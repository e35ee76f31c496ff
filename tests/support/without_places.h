// Modules of one program in two source forms, compared as texts.
#pragma once
#include <algorithm>
#include <sstream>
#include <string>

#include "ir/text/text.h"

namespace rung::frontend::test {

// A line of the module without its places in the source; ladder text has blanks for the tabs of titles.
inline std::string withoutPlaces(std::string line) {
  const size_t location = line.find(" loc(");
  if (location != std::string::npos) line.erase(location, line.find(')', location) + 1 - location);
  const size_t place = line.rfind(" @");
  if (place != std::string::npos && place + 2 < line.size() && line[place + 2] >= '0' && line[place + 2] <= '9')
    line.erase(place, line.find_first_not_of("0123456789", place + 2) - place);
  for (size_t tab = line.find("\\t"); tab != std::string::npos; tab = line.find("\\t")) line.replace(tab, 2, " ");
  std::replace(line.begin(), line.end(), '\t', ' ');
  return line;
}

inline std::string withoutPlaces(const ir::Module& module) {
  std::istringstream stream(ir::print(module));
  std::string result;
  for (std::string line; std::getline(stream, line);)
    if (!line.starts_with("    source ") && !line.starts_with("file ")) result += withoutPlaces(line) + '\n';
  return result;
}

} // namespace rung::frontend::test
