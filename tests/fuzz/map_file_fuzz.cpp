// libFuzzer target: any bytes as a mapping file of LinuxCNC's component, and what is taken of it bound to a program of
// each dialect. What is bound lies in the program's memory and suits its entry, every mistake has its place.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <list>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ir/support/check.h"
#include "machine/host/binding.h"
#include "machine/host/mapping_file.h"
#include "rung/runtime.hpp"
#include "tests/fuzz/mapped_programs.h"
#include "tests/support/compiled_program.h"

namespace {

using namespace rung;

// Takes a number and what follows it off the text; false: they are not there.
bool skipNumber(std::string_view& text, char after) {
  const size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
  if (digits == 0 || text[0] == '0' || digits == text.size() || text[digits] != after) return false;
  text.remove_prefix(digits + 1);
  return true;
}

void checkError(std::string_view error) {
  RUNG_CHECK(error.starts_with("f.map:") || error.starts_with("i.map:"), "an error names the file");
  error.remove_prefix(6);
  RUNG_CHECK(skipNumber(error, ':') && skipNumber(error, ':'), "an error has a line and a column");
  RUNG_CHECK(error.size() > 1 && error[0] == ' ', "an error says what is wrong");
}

void checkPlace(const text::Position& at) { RUNG_CHECK(at.line > 0 && at.column > 0, "an entry has a place"); }

void checkMap(const host::File& map) {
  std::set<std::string_view> names;
  for (const host::Pin& pin : map.pins) {
    RUNG_CHECK(!pin.name.empty() && names.insert(pin.name).second, "a pin is made once");
    checkPlace(pin.at);
  }
  const auto pin = [&](uint32_t number) -> const host::Pin& {
    RUNG_CHECK(number < map.pins.size(), "an entry's pin is there");
    return map.pins[number];
  };
  for (const host::Link& link : map.links) {
    RUNG_CHECK(std::isfinite(link.scale) && link.scale != 0, "a scale can be divided by");
    RUNG_CHECK(!link.name.empty(), "an entry names a place");
    RUNG_CHECK(link.bits.empty() || link.bits.front() == link.pin, "the first bit's pin is the entry's");
    for (const uint32_t bit : link.bits) RUNG_CHECK(pin(bit).type == host::PinType::Bit, "a bit has a pin of type bit");
    RUNG_CHECK(!link.value || pin(link.pin).direction == host::Direction::Parameter, "only parameters have a value");
    checkPlace(link.at);
  }
  for (const host::Constant& constant : map.constants) {
    RUNG_CHECK(!constant.name.empty() && std::isfinite(constant.value), "a constant has a name and a value");
    checkPlace(constant.at);
  }
  const auto checkEdge = [&](const host::Edge& edge) {
    RUNG_CHECK(pin(edge.pin).direction == host::Direction::In && pin(edge.pin).type == host::PinType::Bit,
               "an edge is of an input bit");
  };
  for (const host::Send& send : map.sends) {
    checkEdge(send.edge);
    if (send.codePin) RUNG_CHECK(pin(*send.codePin).direction == host::Direction::In, "the code comes from HAL");
    if (send.donePin) RUNG_CHECK(pin(*send.donePin).direction == host::Direction::Out, "the answer goes to HAL");
    checkPlace(send.at);
  }
  for (const host::Edge& edge : map.aborts) checkEdge(edge);
  RUNG_CHECK(map.timeoutNs >= 0, "a time is not negative");
  for (const host::Connection& connection : map.connections) {
    RUNG_CHECK(connection.timeoutNs > 0 && connection.periodNs > 0 && connection.requests > 0 &&
                   connection.connections > 0,
               "a connection has its times and limits");
    for (const host::ConnectedPin& one : connection.pins) {
      const host::Direction direction = pin(one.pin).direction;
      RUNG_CHECK(direction == host::Direction::In || direction == host::Direction::Out, "it has one source");
      RUNG_CHECK(one.place < 65536 && std::isfinite(one.safe), "a pin has a place and a safe value");
      RUNG_CHECK(one.area != host::Area::Memory || one.place % host::bytesOf(one.format) == 0, "it is aligned");
    }
  }
}

// ---- binding -------------------------------------------------------------------------------------------------------

struct Bound {
  explicit Bound(const fuzz::MappedProgram& source)
      : compiled(source.file, source.text, compiler::EngineKind::Interp), image(Image::adopt(compiled.program())) {}

  testing::CompiledProgram compiled;
  Image image;
};

const std::list<Bound>& programs() {
  static const std::list<Bound> made(std::begin(fuzz::kMappedPrograms), std::end(fuzz::kMappedPrograms));
  return made;
}

// As a variable of the pin's type it can be bound.
template <class Link>
void checkLink(const Instance& plc, const rung_program& program, const Link& link, double scale, uint32_t direction) {
  constexpr rung_host_type kTypes[] = {RUNG_HOST_BOOL, RUNG_HOST_I32, RUNG_HOST_U32, RUNG_HOST_F64};
  static double room = 0;
  const uint32_t words = link.words ? uint32_t{RUNG_BOUND_REAL} : 0;
  const rung_variable variable{link.name.c_str(), &room, kTypes[static_cast<size_t>(link.type)], direction | words,
                               scale};
  RUNG_CHECK(rung_instance_bind(plc.handle(), &variable, 1) == RUNG_OK, "what is found can be bound");
  rung_cell cell = 0;
  if (rung_instance_find(plc.handle(), link.name.c_str(), RUNG_WRITE, &cell) != RUNG_OK)
    RUNG_CHECK(rung_instance_find(plc.handle(), link.name.c_str(), RUNG_READ, &cell) == RUNG_OK, "it is found");
  const rung_cell_info info = plc.describe(cell);
  RUNG_CHECK(info.space != RUNG_NONE && info.type != RUNG_TYPE_TEXT, "a place holds a value");
  RUNG_CHECK((info.type == RUNG_TYPE_BIT) == (link.type == host::PinType::Bit), "a bit is for a bit");
  RUNG_CHECK(info.type != RUNG_TYPE_F64 || link.type == host::PinType::Float, "a real number is for a float");
  const uint32_t flags = program.spaces[info.space].flags;
  RUNG_CHECK(direction != RUNG_TO_PROGRAM || (flags & RUNG_SPACE_OUTPUT) == 0 || (flags & RUNG_SPACE_INPUT) != 0,
             "outputs are not written");
}

void checkBinding(const host::File& map, const Bound& program) {
  std::vector<std::string> errors;
  const Instance plc(program.image); // a new one: what is bound stays
  const host::Binding binding = host::bindMap(map, plc.handle(), program.image.program(), errors);
  for (const host::PinLink& link : binding.links) {
    if (host::toProgram(link.direction)) checkLink(plc, program.image.program(), link, link.scale, RUNG_TO_PROGRAM);
    if (host::fromProgram(link.direction)) checkLink(plc, program.image.program(), link, link.scale, RUNG_FROM_PROGRAM);
  }
  for (const host::ConstLink& constant : binding.constants)
    checkLink(plc, program.image.program(), constant, 1, RUNG_TO_PROGRAM);
  const size_t links = binding.links.size() + binding.constants.size();
  const size_t entries = map.links.size() + map.constants.size();
  RUNG_CHECK(links <= entries && entries - links <= errors.size(), "an entry is bound or has an error");
  for (const std::string& error : errors) {
    checkError(error);
    const size_t found = error.find(": found "), expected = error.find(", expected ", found);
    RUNG_CHECK(expected != std::string::npos && error.find("; ", expected) != std::string::npos,
               "an error says what was found, what was expected and how to fix it");
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  std::vector<std::string> errors;
  const auto included = [](const std::string& path) -> std::string {
    if (path != "i.map") throw std::runtime_error("cannot read it");
    return "timeout = 1\nin.a = { type = \"bit\", name = \"X0.0\" }\nin.wrong = 1\n";
  };
  const host::File map = host::parseMap({reinterpret_cast<const char*>(data), size}, "f.map", errors, included);
  checkMap(map);
  for (const std::string& error : errors) checkError(error);
  for (const Bound& program : programs()) checkBinding(map, program);
  return 0;
}
