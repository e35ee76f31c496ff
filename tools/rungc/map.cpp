// rungc map: makes a first mapping file for a program, and checks an existing one.
#include <fmt/format.h>
#include <memory>
#include <optional>

#include "compiler/project.h"
#include "machine/host/binding.h"
#include "machine/host/component_pins.h"
#include "machine/host/map_template.h"
#include "machine/host/mapping_file.h"
#include "machine/host/message_texts.h"
#include "rung/runtime.hpp"
#include "tools/report/cross_reference.h"
#include "tools/report/place_names.h"
#include "tools/rungc/commands.h"
#include "tools/rungc/opened_program.h"

namespace rung::rungc {
namespace {

struct MapOptions {
  SourceOptions source;
  bool makeTemplate = false;
  std::string check; // path of a mapping file
  std::string out;
};

int writeTemplate(const MapOptions& options, const OpenedProgram& program) {
  if (!program.compiled)
    return usageError("map --template needs the sources: a compiled program does not say which names its rungs use");
  std::vector<host::UsedName> used;
  const rung_program& tables = program.image->program();
  const std::vector<report::UsedPlace> places = report::usedPlaces(tables, *program.compiled->uses);
  const report::PlaceSet written = report::writtenPlaces(places);
  for (const report::UsedPlace& place : places) {
    std::string name = report::writtenName(tables, report::refOf(place.use));
    if (!name.empty()) used.push_back({std::move(name), place.read, written.meets(place.use.place)});
  }
  const Instance instance(*program.image);
  const std::string text = host::templateMap(instance.handle(), tables, used);
  if (options.out.empty()) {
    fmt::print("{}", text);
    return kOk;
  }
  return sayWrote(writeFile(text, options.out), options.out, options.source);
}

// Variables that rungs write are not inputs: a pin's value would last only until they do. `map`: bound as in `binding`.
void checkDriven(const host::File& map, const host::Binding& binding, rung_instance* instance,
                 const OpenedProgram& program, std::vector<std::string>& errors) {
  const rung_program& tables = program.image->program();
  const report::PlaceSet written = report::writtenPlaces(report::usedPlaces(tables, *program.compiled->uses));
  const host::Sides sides(instance, tables);
  for (const host::PinLink& link : binding.links) {
    if (link.direction != host::Direction::In) continue;
    const std::optional<rung_cell_info> info = cellInfo(instance, link.name, RUNG_READ);
    if (!info || info->space == RUNG_NONE || sides.isInput(*info)) continue;
    const host::Bits bits = host::bitsOf(*info);
    if (!written.meets({ir::SpaceId{info->space}, static_cast<uint32_t>(bits.first),
                        static_cast<uint32_t>(bits.end - bits.first)}))
      continue;
    const host::Pin& pin = map.pins[link.pin];
    errors.push_back(
        map.message(pin.at, "in." + pin.name + ": " +
                                host::Mistake{link.name + ", which rungs write", "a name that no rung writes",
                                              "move the pin to [out], or to [io]"}
                                    .text()));
  }
}

int checkMap(const MapOptions& options, const OpenedProgram& program) {
  std::vector<std::string> errors;
  const host::File map = host::loadMap(options.check, errors);
  if (map.paths.empty()) return environmentError(errors.front());
  const Instance instance(*program.image);
  const host::Binding binding = host::bindMap(map, instance.handle(), program.image->program(), errors);
  if (map.connections.empty()) host::checkPinNames(map, errors); // otherwise it is not for LinuxCNC
  if (program.compiled) checkDriven(map, binding, instance.handle(), program, errors);
  host::defineMessages(map, instance.handle(), errors);
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
  if (const std::string other = compiler::otherKind(options.check, compiler::FileKind::Map); !other.empty())
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
