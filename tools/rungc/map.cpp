// rungc map: a first mapping file for a program, and the mistakes of one that is there.
#include <fmt/format.h>
#include <memory>
#include <optional>

#include "rung/runtime.hpp"
#include "tools/map-template/sides.h"
#include "tools/map-template/template.h"
#include "tools/mapping/binding.h"
#include "tools/mapping/component_pins.h"
#include "tools/mapping/message_texts.h"
#include "tools/mapping/mistake.h"
#include "tools/project/file_kind.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/opened_program.h"
#include "tools/xref/place_names.h"
#include "tools/xref/used_places.h"

namespace rung::rungc {
namespace {

struct MapOptions {
  SourceOptions source;
  bool makeTemplate = false;
  std::string check; // a mapping file
  std::string out;
};

int writeTemplate(const MapOptions& options, const OpenedProgram& program) {
  if (!program.compiled)
    return usageError("map --template needs the sources: a compiled program does not say which names its rungs use");
  std::vector<map_template::UsedName> used;
  const rung_program& tables = program.image->program();
  const std::vector<xref::UsedPlace> places = xref::usedPlaces(tables, *program.compiled->uses);
  const xref::PlaceSet written = xref::writtenPlaces(places);
  for (const xref::UsedPlace& place : places) {
    std::string name = xref::writtenName(tables, xref::refOf(place.use));
    if (!name.empty()) used.push_back({std::move(name), place.read, written.meets(place.use.place)});
  }
  const Instance instance(*program.image);
  const std::string text = map_template::templateMap(instance.handle(), tables, used);
  if (options.out.empty()) {
    fmt::print("{}", text);
    return kOk;
  }
  return sayWrote(writeFile(text, options.out), options.out, options.source);
}

// What rungs write is not an input: a pin's value would last until they do. `map`: bound as in `binding`.
void checkDriven(const mapping::File& map, const mapping::Binding& binding, rung_instance* instance,
                 const OpenedProgram& program, std::vector<std::string>& errors) {
  const rung_program& tables = program.image->program();
  const xref::PlaceSet written = xref::writtenPlaces(xref::usedPlaces(tables, *program.compiled->uses));
  const map_template::Sides sides(instance, tables);
  for (const mapping::PinLink& link : binding.links) {
    if (link.direction != mapping::Direction::In) continue;
    const std::optional<rung_cell_info> info = cellInfo(instance, link.name, RUNG_READ);
    if (!info || info->space == RUNG_NONE || sides.isInput(*info)) continue;
    const map_template::Bits bits = map_template::bitsOf(*info);
    if (!written.meets({ir::SpaceId{info->space}, static_cast<uint32_t>(bits.first),
                        static_cast<uint32_t>(bits.end - bits.first)}))
      continue;
    const mapping::Pin& pin = map.pins[link.pin];
    errors.push_back(
        map.message(pin.at, "in." + pin.name + ": " +
                                mapping::Mistake{link.name + ", which rungs write", "a name that no rung writes",
                                                 "move the pin to [out], or to [io]"}
                                    .text()));
  }
}

int checkMap(const MapOptions& options, const OpenedProgram& program) {
  std::vector<std::string> errors;
  const mapping::File map = mapping::loadMap(options.check, errors);
  if (map.paths.empty()) return environmentError(errors.front());
  const Instance instance(*program.image);
  const mapping::Binding binding = mapping::bindMap(map, instance.handle(), program.image->program(), errors);
  if (map.connections.empty()) mapping::checkPinNames(map, errors); // else it is not for LinuxCNC
  if (program.compiled) checkDriven(map, binding, instance.handle(), program, errors);
  mapping::defineMessages(map, instance.handle(), errors);
  for (const std::string& warning : binding.warnings) fmt::print(stderr, "{}\n", warning);
  for (const std::string& error : errors) fmt::print(stderr, "{}\n", error);
  if (!errors.empty()) return kWrong;
  const size_t warnings = binding.warnings.size();
  const std::string of = warnings == 0 ? "" : fmt::format(", {} warning{}", warnings, warnings == 1 ? "" : "s");
  if (!options.source.quiet) fmt::print("{}: {} pins, no mistakes{}\n", options.check, map.pins.size(), of);
  return kOk;
}

int run(const MapOptions& options) {
  if (options.makeTemplate == !options.check.empty()) return usageError("map: expected --template or --check MAP");
  if (const std::string other = project::otherKind(options.check, project::FileKind::Map); !other.empty())
    return usageError(other);
  int status = kOk;
  const std::optional<OpenedProgram> program = openProgram(options.source, status);
  if (!program) return status;
  return options.makeTemplate ? writeTemplate(options, *program) : checkMap(options, *program);
}

} // namespace

void addMap(CommandLine& app, int& status) {
  Command command = app.add("map", "Draft a mapping file, or check one against its program");
  auto options = std::make_shared<MapOptions>();
  addSourceOptions(command, options->source);
  Option check = command.option("--check", options->check, "Report all mistakes in this mapping file");
  command
      .flag("--template", options->makeTemplate, "Write a mapping file with the inputs and outputs that the rungs use")
      .excludes(check);
  command.option("-o,--output", options->out, "Write the template to this file instead of standard output")
      .excludes(check);
  command.onRun([options, &status] { status = run(*options); });
}

} // namespace rung::rungc
