// The configuration keys of a dialect, with their readers and permitted values. The compiler and the simulated control
// check values with these tables; the reference and `rungc explain` print them.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace rung::nc {

enum class ConfigReader : uint8_t { Compiler, Control };

enum class ConfigForm : uint8_t {
  Choice,   // one of the words in `takes`, separated by blanks
  Whole,    // a whole number of `least` to `most`
  Number,   // any number
  Duration, // of `least` to `most` microseconds, with its unit
  File,     // a path, relative to the file that names it
  Text,     // checked by its reader; `takes` describes it
};

struct ConfigKey {
  std::string_view key; // a part in <> matches any text: "tmr.<N>"; <n> matches digits only
  ConfigReader reader = ConfigReader::Control;
  ConfigForm form = ConfigForm::Text;
  std::string_view takes = "";
  int64_t least = 0;
  int64_t most = 0;
  std::string_view otherwise = ""; // the value without the key
  std::string_view doc;
};

// Key of every dialect.
inline constexpr ConfigKey kEncodingKey = {.key = "encoding",
                                           .reader = ConfigReader::Compiler,
                                           .takes = "the name of an encoding, such as gb18030",
                                           .otherwise = "UTF-8",
                                           .doc = "of source files that do not name it in their first line"};

std::span<const ConfigKey> fanucConfigKeys();
std::span<const ConfigKey> gskConfigKeys();
std::span<const ConfigKey> nctConfigKeys();
std::span<const ConfigKey> technolConfigKeys();

// The row of a key as a user writes it; null if there is none.
const ConfigKey* findConfigKey(std::span<const ConfigKey> keys, std::string_view key);
// The key as people write it: "tmr.N".
std::string shownKey(const ConfigKey& key);
// "scripted or simulated", "1 to 1000000", "a duration with its unit, 1us to 3600s".
std::string takesOf(const ConfigKey& key);
// "" or "KEY: expected …, found 'VALUE'".
std::string wrongValue(const ConfigKey& row, std::string_view key, std::string_view value);

// Microseconds of "2ms", "500us", "1s"; -1 for any other text, also for a number without a unit.
int64_t durationUs(std::string_view text);
// A whole number (text::wholeIn); -1 for any other text, a negative number or one of more than 63 bits.
int64_t wholeNumber(std::string_view text);

} // namespace rung::nc
