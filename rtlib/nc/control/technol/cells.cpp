// Access to the cells of a TECHNOL program by name (see cells.h).
#include "rtlib/nc/control/technol/cells.h"

#include <algorithm>
#include <array>
#include <string>

#include "rtlib/nc/control/technol/identifier.h"
#include "rtlib/nc/names/names.h"
#include "rtlib/nc/technol/signals.h"
#include "rtlib/text/letters.h"

namespace rung::nc::technol {
namespace {

constexpr const char* kCells = "I";
constexpr const char* kBlocks = "BLK";

// Removes the type that a program writes before an element; the host accesses elements by their own type.
std::string_view withoutType(std::string_view element) {
  for (const std::string_view type : {"BYTE.", "WORD.", "DWRD.", "QWRD.", "REAL."})
    if (element.size() > type.size() && text::startsWithIgnoringCase(element, type)) return element.substr(type.size());
  return element;
}

std::optional<runtime::Ref> blockElement(const rung_program& program, std::string_view name) {
  name.remove_prefix(std::string_view(kBlocks).size());
  const std::optional<uint32_t> block = takeIndex(name);
  const uint32_t space = runtime::findSpace(program, kBlocks);
  if (!block || space == RUNG_NONE || name.empty() || name.front() != '.') return std::nullopt;
  std::string_view element = withoutType(name.substr(1));
  const size_t bracket = std::min(element.find('['), element.size());
  std::string_view rest = element.substr(bracket);
  const std::optional<uint32_t> index = rest.empty() ? 0 : takeIndex(rest);
  const Signal* found = findSignal(technolSignals(), "BLK[]." + std::string(element.substr(0, bracket)), kBlocks);
  if (found == nullptr || !index || !rest.empty() || *index >= found->count) return std::nullopt;
  const uint32_t blockBytes = areaBytes(technolSignals(), kBlocks);
  if (*block >= program.spaces[space].byte_count / blockBytes) return std::nullopt;
  const uint32_t byte = *block * blockBytes + found->byteOffset + *index * found->strideBytes;
  if (found->type == SignalType::Bit) return runtime::bitRef(space, byte, found->bit);
  if (found->type == SignalType::Real) return runtime::realRef(space, byte);
  return runtime::intRef(space, byte, elementBytes(found->type) * 8);
}

} // namespace

std::optional<runtime::Ref> placeOf(const rung_program& program, const Signal& signal) {
  const uint32_t space = runtime::findSpace(program, "NCI");
  if (space == RUNG_NONE) return std::nullopt;
  if (signal.type == SignalType::Bit) return runtime::bitRef(space, signal.byteOffset, signal.bit);
  const uint32_t bytes = elementBytes(signal.type);
  if (bytes == 0) return std::nullopt;
  runtime::Ref place = signal.type == SignalType::Real ? runtime::realRef(space, signal.byteOffset)
                                                       : runtime::intRef(space, signal.byteOffset, bytes * 8);
  place.count = signal.count;
  return place;
}

// STRUCTURE.MEMBER, and CELL.WEIGHT with a weight of the interface.
static std::optional<runtime::Ref> partPlace(const rung_program& program, std::string_view name) {
  const size_t point = name.rfind('.');
  if (point == std::string_view::npos) return std::nullopt;
  const std::string_view whole = name.substr(0, point), part = name.substr(point + 1);
  if (const Signal* weight = findSignal(technolSignals(), part, "W")) {
    const std::optional<runtime::Ref> cell = cellPlace(program, whole);
    if (!cell || cell->kind != runtime::RefKind::Int) return std::nullopt;
    return runtime::bitRef(cell->space, cell->byte, weight->bit);
  }
  const Signal* found = findSignal(technolSignals(), whole, kCells);
  if (found == nullptr || found->type != SignalType::Struct) return std::nullopt;
  const Signal* member =
      findSignal(technolSignals(), std::string(found->structure) + "." + std::string(part), found->structure);
  if (member == nullptr) return std::nullopt;
  Signal inside = *member;
  inside.byteOffset += found->byteOffset;
  return placeOf(program, inside);
}

std::optional<runtime::Ref> signalPlace(const rung_program& program, std::string_view name) {
  if (text::startsWithIgnoringCase(name, "BLK[")) return blockElement(program, name);
  const Signal* found = findSignal(technolSignals(), name, kCells);
  return found == nullptr ? partPlace(program, name) : placeOf(program, *found);
}

std::optional<runtime::Ref> cellPlace(const rung_program& program, std::string_view name) {
  return resolve(program, name, [&](std::string_view unknown) { return signalPlace(program, unknown); });
}

core::Place locateSignal(const rung_program& program, std::string_view name) {
  return runtime::locate({program, nullptr}, signalPlace(program, name).value_or(runtime::Ref{}));
}

core::Place locateCell(const rung_program& program, std::string_view name) {
  return runtime::locate({program, nullptr}, cellPlace(program, name).value_or(runtime::Ref{}));
}

void locateElements(const rung_program& program, std::string_view array, std::span<core::Place> elements) {
  const std::optional<runtime::Ref> whole = signalPlace(program, array);
  for (uint32_t i = 0; whole && i < elements.size(); ++i)
    if (const auto one = runtime::element(*whole, i)) elements[i] = runtime::locate({program, nullptr}, *one);
}

uint64_t readCell(const runtime::Instance& instance, std::string_view name) {
  const auto place = cellPlace(instance.program(), name);
  return place ? instance.read(*place) : 0;
}

void writeCell(runtime::Instance& instance, std::string_view name, uint64_t value) {
  if (const auto place = cellPlace(instance.program(), name)) runtime::writeRaw(instance.memory(), *place, value);
}

bool runWith(runtime::Instance& instance, std::string_view task, uint64_t dr, bool rlo) {
  return Procedure(instance.program(), task).run(instance, dr, rlo);
}

Procedure::Procedure(const rung_program& program, std::string_view task)
    : task_(runtime::findTask(program, task)), dr_(locateCell(program, "@DR")), rlo_(locateCell(program, "@RLO")) {}

bool Procedure::run(runtime::Instance& instance, uint64_t dr, bool rlo) const {
  if (task_ == RUNG_NONE) return false;
  const core::Memory memory = instance.memory();
  memory.write(dr_, dr);
  memory.write(rlo_, rlo ? 1 : 0);
  const bool done = instance.runTask(task_);
  memory.write(dr_, 0);
  memory.write(rlo_, 0);
  return done;
}

} // namespace rung::nc::technol
