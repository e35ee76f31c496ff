// See side.h.
#include "tools/bench/generated/side.h"

#include <bit>
#include <cstring>
#include <dlfcn.h>

#include <fmt/format.h>

#include "rtlib/nc/names/names.h"

namespace rung::bench {
namespace {

Failure missing(const std::string& name) { return failure(fmt::format("the program has no place {}", name)); }

bool find(const rung_program& program, core::Memory memory, const std::vector<std::string>& names, bool real,
          std::vector<core::Place>& places, std::string& unknown) {
  for (const std::string& name : names) {
    std::optional<runtime::Ref> ref = nc::resolve(program, name);
    if (ref && real) ref = runtime::asReal(memory, *ref);
    if (!ref) {
      unknown = name;
      return false;
    }
    places.push_back(runtime::locate(memory, *ref));
  }
  return true;
}

template <class T>
std::vector<T> copied(const uint8_t* from, size_t count) {
  std::vector<T> values(count);
  if (count != 0) std::memcpy(values.data(), from, count * sizeof(T)); // memcpy does not take a null pointer
  return values;
}

} // namespace

Ours::Ours(runtime::Engine& engine) : instance_(engine), footprint_(engine.program(), true) {}

Result<std::unique_ptr<Ours>> Ours::make(runtime::Engine& engine, const Program& program) {
  std::unique_ptr<Ours> ours(new Ours(engine));
  const core::Memory memory = ours->instance_.memory();
  const rung_program& image = ours->instance_.program();
  std::string unknown;
  if (!find(image, memory, program.bits, false, ours->bits_, unknown) ||
      !find(image, memory, program.words, false, ours->words_, unknown) ||
      !find(image, memory, program.tables, false, ours->tables_, unknown) ||
      !find(image, memory, program.reals, true, ours->reals_, unknown))
    return missing(unknown);
  for (const std::string& name : program.bits) {
    const runtime::Ref ref = *nc::resolve(image, name);
    const std::optional<runtime::Ref> lasting = ours->instance_.write(ref, 0);
    ours->inputs_.push_back(runtime::locate(memory, lasting.value_or(ref)));
  }
  for (const auto& [name, value] : program.constants) {
    const std::optional<runtime::Ref> ref = nc::resolve(image, name);
    if (!ref) return missing(name);
    ours->constants_.emplace_back(runtime::locate(memory, *ref), value);
  }
  ours->leaveOut();
  return ours;
}

// Leaves out unneeded copies as the runtime library does, which knows what its host accesses.
void Ours::leaveOut() {
  constexpr uint32_t kBytes = 8; // most bytes of a place
  const core::NeededCopies& copies = instance_.neededCopies();
  for (const std::vector<core::Place>* places : {&bits_, &words_, &tables_, &reals_})
    for (const core::Place& place : *places)
      if (copies.leavesOut(place.offset(), kBytes)) return;
  instance_.setNeededCopiesOnly(true);
}

void Ours::writeConstants() {
  instance_.coldStart();
  for (const auto& [place, value] : constants_) instance_.memory().write(place, value);
}

void Ours::begin(const Machine& machine) {
  writeConstants();
  const core::Memory memory = instance_.memory();
  for (size_t i = 0; i < machine.inputs().size(); ++i) memory.write(inputs_[i], machine.inputs()[i] ? 1 : 0);
  for (size_t i = 0; i < machine.words().size(); ++i) memory.write(words_[i], machine.words()[i]);
  for (size_t i = 0; i < machine.reals().size(); ++i) memory.writeReal(reals_[i], machine.reals()[i]);
}

void Ours::beginWith(bool condition) {
  writeConstants();
  for (const core::Place& place : inputs_) instance_.memory().write(place, condition ? 1 : 0);
}

void Ours::apply(const Change& change) {
  const core::Memory memory = instance_.memory();
  for (uint32_t i = 0; i < change.bitCount; ++i) {
    const core::Place& place = inputs_[change.bits[i]];
    memory.write(place, memory.read(place) ^ 1);
  }
  if (change.hasWords)
    for (size_t i = 0; i < change.words.size(); ++i) memory.write(words_[change.words[i]], change.wordValues[i]);
  if (change.hasReal) memory.writeReal(reals_[change.real], change.realValue);
}

Values Ours::values() const {
  const core::Memory memory = instance_.memory();
  Values values;
  for (const core::Place& place : bits_) values.bits.push_back(memory.read(place) != 0);
  for (const core::Place& place : words_) values.words.push_back(static_cast<uint32_t>(memory.read(place)));
  for (const core::Place& place : tables_) values.tables.push_back(static_cast<uint32_t>(memory.read(place)));
  for (const core::Place& place : reals_) values.reals.push_back(std::bit_cast<uint64_t>(memory.readReal(place)));
  return values;
}

Straight::Straight(Scan scan, const Work& work, BitForm form, int msAScan)
    : scan_(scan), work_(work), layout_(work, form), msAScan_(msAScan), memory_(layout_.size / sizeof(uint64_t)) {}

Result<std::unique_ptr<Straight>> Straight::load(const std::string& path, const Work& work, BitForm form, int msAScan) {
  void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL); // stays loaded: profilers look names up at exit
  void* scan = library == nullptr ? nullptr : dlsym(library, "scan");
  if (scan == nullptr) return failure(dlerror());
  return std::unique_ptr<Straight>(new Straight(reinterpret_cast<Scan>(scan), work, form, msAScan));
}

bool Straight::bit(uint32_t number) const {
  if (layout_.form == BitForm::Byte) return bytes()[number] != 0;
  return (memory_[number / 64] >> number % 64 & 1) != 0;
}

void Straight::setBit(uint32_t number, bool value) {
  if (layout_.form == BitForm::Byte) {
    bytes()[number] = value ? 1 : 0;
    return;
  }
  const uint64_t mask = uint64_t{1} << number % 64;
  memory_[number / 64] = value ? memory_[number / 64] | mask : memory_[number / 64] & ~mask;
}

void Straight::begin(const Machine& machine) {
  memory_.assign(memory_.size(), 0);
  for (uint32_t i = 0; i < machine.inputs().size(); ++i) setBit(i, machine.inputs()[i]);
  if (!machine.words().empty())
    std::memcpy(bytes() + layout_.words, machine.words().data(), 4 * machine.words().size());
  if (!machine.reals().empty())
    std::memcpy(bytes() + layout_.reals, machine.reals().data(), 8 * machine.reals().size());
}

void Straight::apply(const Change& change) {
  for (uint32_t i = 0; i < change.bitCount; ++i) setBit(change.bits[i], !bit(change.bits[i]));
  if (change.hasWords)
    for (size_t i = 0; i < change.words.size(); ++i)
      std::memcpy(bytes() + layout_.words + 4 * size_t{change.words[i]}, &change.wordValues[i], 4);
  if (change.hasReal) std::memcpy(bytes() + layout_.reals + 8 * size_t{change.real}, &change.realValue, 8);
}

Values Straight::values() const {
  Values values;
  for (uint32_t i = 0; i < work_.bits(); ++i) values.bits.push_back(bit(i));
  values.words = copied<uint32_t>(bytes() + layout_.words, work_.words());
  values.tables = copied<uint32_t>(bytes() + layout_.tables, work_.hasTables ? kTables * kEntries : 0);
  values.reals = copied<uint64_t>(bytes() + layout_.reals, work_.reals());
  return values;
}

std::string difference(const Values& ours, const Values& theirs, const Program& program) {
  const auto first = [](const auto& a, const auto& b, const std::vector<std::string>& names) -> std::string {
    for (size_t i = 0; i < names.size(); ++i)
      if (a[i] != b[i]) return fmt::format("{}: ours {}, theirs {}", names[i], +a[i], +b[i]);
    return {};
  };
  for (std::string found :
       {first(ours.bits, theirs.bits, program.bits), first(ours.words, theirs.words, program.words),
        first(ours.tables, theirs.tables, program.tables), first(ours.reals, theirs.reals, program.reals)})
    if (!found.empty()) return found;
  return {};
}

} // namespace rung::bench
