// Shared by the readers of a mapping file's tables.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "machine/host/mapping_file.h"
#include "rtlib/text/toml.h"

namespace rung::host {

bool isPinName(std::string_view word);
// A path named in a file, relative to the folder of that file.
std::string beside(const std::string& path, const std::string& included);

struct Place { // a text value and its position
  std::string text;
  text::Position at;
};

struct Number {
  double value = 0;
  PinType type = PinType::Float; // Bit: true or false; S32, U32: an integer
  std::string found;
  text::Position at;
};

// The state of reading a map and the files that it includes; positions have the indices of File::paths.
class Reading : public text::TomlReading {
public:
  explicit Reading(File& map) : map_(map) {}

  File& map() { return map_; }
  // "line 5", with the file if it is another one.
  std::string lineOf(text::Position at) const;
  // Sorted in the order of the files.
  std::vector<std::string> errors() const;

  // A number; integers must fit into 32 bits. Nothing if the node is something else, or not finite.
  std::optional<Number> numberWithType(const toml::node& node) const;
  // Reports a value that does not fit the type: true or false for a bit, a number for the others, an integer if the
  // type has only integers.
  void checkNumber(const std::optional<Number>& number, PinType type, const std::string& where);

private:
  File& map_;
};

} // namespace rung::host
