// Mapping files that are wrong, or nearly, and all that is said about each: a file of cases for each way to read one.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>

#include "machine/host/binding.h"
#include "machine/host/mapping_file.h"
#include "machine/host/message_texts.h"
#include "rung/runtime.hpp"
#include "tests/support/cases.h"
#include "tests/support/faultless_map.h"
#include "tests/support/words.h"
#include "tests/unit/host/connected_pins.h"
#include "tests/unit/host/test_program.h"

namespace rung::host {
namespace {

using Errors = std::vector<std::string>;

// What the TOML library says about syntax differs from version to version.
Errors withoutWordsOfTheLibrary(Errors errors) {
  for (std::string& error : errors) {
    const size_t end = error.find("; the file must be TOML");
    if (end == std::string::npos) continue;
    const size_t begin = error.find(": ") + 2;
    error.replace(begin, end - begin, "(what the library says)");
  }
  return errors;
}

Errors inFile(const std::string& text) {
  Errors errors;
  parseMap(text, "m.map", errors);
  return withoutWordsOfTheLibrary(errors);
}

// Without the name of the file, and with lines counted from the first one after the pins.
Errors inConnections(const std::string& text) {
  const std::string pins(testing::kPins);
  Errors errors = inFile(pins + text);
  const auto linesOfPins = static_cast<int>(std::count(pins.begin(), pins.end(), '\n'));
  for (std::string& error : errors) {
    error.erase(0, std::string_view("m.map:").size());
    size_t digits = 0;
    const int line = std::stoi(error, &digits);
    error.replace(0, digits, std::to_string(line - linesOfPins));
  }
  return errors;
}

// What a host that has neither connections nor axes says.
Errors refused(const std::string& text) {
  const File map = test::faultlessMap(text);
  Errors errors;
  refuseConnections(map, "a host", errors);
  refuseAxes(map, "a host", errors);
  return errors;
}

Errors bound(const rung_program& program, const std::string& text) {
  const Instance plc(Image::adopt(program));
  Errors errors;
  const File map = parseMap(text, "m.map", errors);
  bindMap(map, plc.handle(), program, errors);
  return errors;
}

// A real number, which signals of TECHNOL's interface are.
rung_program programOfASpeed() {
  static constexpr rung_symbol kSpeed = {"SPEED", "", 1, 0, 0, RUNG_TYPE_F64, 1, 0, 0};
  rung_program program = testing::technolProgram();
  program.symbols = &kSpeed;
  program.symbol_count = 1;
  return program;
}

ReadFile readerOf(const std::string& text) {
  return [files = test::filesIn(text)](const std::string& path) {
    const auto found = files.find(path);
    if (found == files.end()) throw std::runtime_error("cannot read " + path + ": No such file or directory");
    return found->second;
  };
}

Errors inFiles(const std::string& text) {
  Errors errors;
  loadMap("m.map", errors, readerOf(text));
  return withoutWordsOfTheLibrary(errors);
}

Errors inMessages(const rung_program& program, const std::string& text) {
  const ReadFile read = readerOf(text);
  const Instance plc(Image::adopt(program));
  Errors errors;
  defineMessages(test::faultlessMap(read("m.map")), plc.handle(), errors, read);
  return errors;
}

Errors atPath(const std::string& path) {
  Errors errors;
  loadMap(path, errors);
  return errors;
}

// By the names of the files of cases.
const std::map<std::string, std::function<Errors(const std::string&)>>& readers() {
  static const std::map<std::string, std::function<Errors(const std::string&)>> all = {
      {"file", inFile},
      {"connections", inConnections},
      {"refused", refused},
      {"includes", inFiles},
      {"paths", atPath},
      {"binding-gsk", [](const std::string& text) { return bound(testing::gskProgram(), text); }},
      {"binding-nct", [](const std::string& text) { return bound(testing::nctProgram(), text); }},
      {"binding-technol", [](const std::string& text) { return bound(testing::technolProgram(), text); }},
      {"binding-speed", [](const std::string& text) { return bound(programOfASpeed(), text); }},
      {"messages-gsk", [](const std::string& text) { return inMessages(testing::gskProgram(), text); }},
      {"messages-technol", [](const std::string& text) { return inMessages(testing::technolProgram(), text); }},
  };
  return all;
}

TEST(MappingGolden, Mistakes) {
  test::Golden golden("tests/golden/host", {".cases"});
  for (const std::filesystem::path& file : golden.inputs()) {
    const auto& read = readers().at(file.stem().string());
    test::expectCases(golden, file, [&](const test::Case& one) { return test::joined(read(one.input)); });
  }
}

} // namespace
} // namespace rung::host
