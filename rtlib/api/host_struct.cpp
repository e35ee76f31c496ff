// See host_struct.h.
#include "rtlib/api/host_struct.h"

#include <algorithm>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <span>
#include <string_view>

#include "rtlib/api/error.h"
#include "rtlib/api/instance.h"
#include "rtlib/api/values.h"
#include "rtlib/load/program_info.h"

namespace rung::api {
namespace {

constexpr int kTries = 4; // attempts per slice, so that a host that writes all the time cannot delay the scan

bool isAligned(const uint8_t* at, uint32_t bytes) noexcept { return reinterpret_cast<uintptr_t>(at) % bytes == 0; }

std::span<const rung_member> membersOf(const rung_layout& layout) { return {layout.members, layout.member_count}; }

bool toProgram(const rung_member& member) { return (member.direction & RUNG_FROM_PROGRAM) == 0; }

} // namespace

HostStruct::HostStruct(const rung_layout& layout, uint8_t* address)
    : layout_(layout), address_(address), ranges_(inputRanges(layout)) {
  if (!guarded()) return;
  copy_.resize(layout.bytes);
  whole_.resize(layout.bytes);
}

std::vector<core::GuardedMemory::Range> HostStruct::inputRanges(const rung_layout& layout) {
  std::vector<core::GuardedMemory::Range> all, joined;
  for (const rung_member& member : membersOf(layout))
    if (toProgram(member)) all.emplace_back(member.offset, member.bytes);
  std::ranges::sort(all);
  for (const auto& [offset, bytes] : all) {
    if (joined.empty() || joined.back().first + joined.back().second < offset)
      joined.emplace_back(offset, bytes);
    else
      joined.back().second = std::max(joined.back().second, offset + bytes - joined.back().first);
  }
  return joined;
}

void HostStruct::take() noexcept {
  const core::GuardedMemory memory(address_, layout_.head, layout_.tail, layout_.counter_bytes);
  if (memory.copy(ranges_, copy_.data(), kTries)) {
    for (const auto& [offset, bytes] : ranges_) std::memcpy(whole_.data() + offset, copy_.data() + offset, bytes);
    inconsistent_ = 0;
  } else if (inconsistent_ != UINT32_MAX) {
    ++inconsistent_;
  }
}

// ---- checks ------------------------------------------------------------------------------------------------------

namespace {

bool within(const rung_layout& layout, uint32_t offset, uint32_t bytes) {
  return bytes != 0 && bytes <= layout.bytes && offset <= layout.bytes - bytes;
}

const char* problemOf(const rung_layout& layout, const rung_member& m) noexcept {
  if (m.name == nullptr || m.member == nullptr) return "has a member without a name";
  if (!within(layout, m.offset, m.bytes)) return "has a member beyond its end";
  if (m.type > RUNG_HOST_F64 || m.direction > (RUNG_FROM_PROGRAM | RUNG_BOUND_REAL))
    return "has a member of no type or no direction";
  if (m.type == 0) return m.bits == 0 ? nullptr : "has a bit-field that is a block";
  if (m.bits == 0)
    return m.bytes == widthOf(static_cast<rung_host_type>(m.type)) ? nullptr
                                                                   : "has a member whose type has another width";
  const bool fits = m.bit < 8 && m.bits <= 64 && m.bit + m.bits <= 8 * m.bytes && m.bytes <= 8;
  return fits && m.type < RUNG_HOST_F32 ? nullptr : "has a bit-field of more bits than its bytes";
}

const char* problemOfCounters(const rung_layout& layout, const uint8_t* address) noexcept {
  const uint32_t bytes = layout.counter_bytes;
  if (bytes == 0) return nullptr;
  if (bytes != 1 && bytes != 2 && bytes != 4 && bytes != 8) return "has counters of no such width";
  if (!within(layout, layout.head, bytes) || !within(layout, layout.tail, bytes)) return "has counters beyond its end";
  return isAligned(address + layout.head, bytes) && isAligned(address + layout.tail, bytes)
             ? nullptr
             : "has counters that are not aligned";
}

} // namespace

const char* problemOf(const rung_layout& layout, const void* address) noexcept {
  if (layout.text == nullptr || layout.bytes == 0 || (layout.members == nullptr && layout.member_count != 0))
    return "has no text, no bytes or no members";
  for (const rung_member& member : membersOf(layout)) {
    if (const char* problem = problemOf(layout, member); problem != nullptr) return problem;
    if (!std::isfinite(member.scale)) return "has a member whose scale is not a number";
  }
  return problemOfCounters(layout, static_cast<const uint8_t*>(address));
}

namespace {

std::string_view firstLine(std::string_view& text) {
  const size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

int32_t failLayout(const rung_program& program, const rung_symbol& compiled, const rung_layout& layout) noexcept {
  std::string_view there = compiled.comment, here = layout.text;
  std::string_view one, other;
  do {
    one = firstLine(there);
    other = firstLine(here);
  } while (one == other && !(there.empty() && here.empty()));
  char its[81], ours[81]; // for the sentence
  putText(its, one);
  putText(ours, other);
  return fail(
      RUNG_REFUSED,
      "%s was compiled for another layout of %s than this host's: it has \"%s\", the host \"%s\"; run rungc bind "
      "again, and compile both",
      program.name, layout.name, its, ours);
}

} // namespace

int32_t checkLayout(const rung_program& program, const rung_layout& layout) noexcept {
  char name[128]; // rungc bind makes no longer names
  std::snprintf(name, sizeof name, RUNG_LAYOUT_SYMBOL "%s", layout.name);
  const rung_symbol* compiled = runtime::findSymbol(program, name);
  if (compiled == nullptr || static_cast<uint64_t>(compiled->value) == layout.hash) return RUNG_OK;
  return failLayout(program, *compiled, layout);
}

// ---- all structs -------------------------------------------------------------------------------------------------

HostStruct& HostStructs::add(std::unique_ptr<HostStruct> bound) {
  const std::lock_guard lock(mutex_);
  return *structs_.emplace_back(std::move(bound));
}

const HostStruct* HostStructs::at(const void* address) const noexcept {
  const auto found =
      std::ranges::find(structs_, address, [](const auto& bound) -> const void* { return bound->address(); });
  return found == structs_.end() ? nullptr : found->get();
}

int32_t HostStructs::check(const rung_program& program) const noexcept {
  const std::lock_guard lock(mutex_);
  for (const std::unique_ptr<HostStruct>& bound : structs_)
    if (const int32_t status = checkLayout(program, bound->layout()); status != RUNG_OK) return status;
  return RUNG_OK;
}

} // namespace rung::api

using namespace rung::api;

namespace {

// The members of a layout, looked up in the running program.
struct Rows {
  std::vector<HostBlock> blocks;
  std::vector<BoundVariable> inputs, outputs;
};

int32_t addRow(rung_instance& instance, const rung_member& m, uint8_t* base, Rows& rows) {
  const bool input = toProgram(m);
  if (m.type == 0) {
    rows.blocks.push_back({.name = m.name, .address = base + m.offset, .bytes = m.bytes, .input = input});
    return checkPlace(instance, rows.blocks.back());
  }
  BoundVariable bound{.type = static_cast<rung_host_type>(m.type),
                      .bit = static_cast<uint8_t>(m.bit),
                      .bits = static_cast<uint8_t>(m.bits),
                      .bytes = static_cast<uint8_t>(m.bytes),
                      .address = base + m.offset,
                      .scale = m.scale != 0 ? m.scale : 1};
  const rung_variable named{
      .name = m.name, .address = bound.address, .type = m.type, .direction = m.direction, .scale = 0};
  if (const int32_t status = findVariable(instance, named, input, bound.cell); status != RUNG_OK) return status;
  bound.truth = input && instance.now().cells.at(bound.cell)->type == RUNG_TYPE_BIT;
  (input ? rows.inputs : rows.outputs).push_back(bound);
  return RUNG_OK;
}

int32_t bindStruct(rung_instance& instance, const rung_layout& layout, uint8_t* address) {
  auto bound = std::make_unique<HostStruct>(layout, address);
  Rows rows{.blocks = {}, .inputs = instance.inputs, .outputs = instance.outputs};
  for (const rung_member& member : membersOf(layout)) {
    uint8_t* base = toProgram(member) ? bound->inputs() : address;
    if (const int32_t status = addRow(instance, member, base, rows); status != RUNG_OK) return status;
  }
  addBlocks(instance, rows.blocks);
  instance.structs.add(std::move(bound));
  instance.inputs.swap(rows.inputs);
  instance.outputs.swap(rows.outputs);
  return RUNG_OK;
}

} // namespace

int32_t rung_instance_bind_struct(rung_instance* instance, const rung_layout* layout, void* address) {
  const Call call(instance);
  if (!call.ok()) return call.status();
  rung_layout given{};
  if (layout == nullptr || !takeStruct(layout, given)) return failSize("rung_layout");
  if (address == nullptr || given.name == nullptr)
    return fail(RUNG_BAD_ARGUMENT, "the struct has no address or its layout no name");
  if (const char* problem = problemOf(given, address); problem != nullptr)
    return fail(RUNG_BAD_ARGUMENT, "the layout of %s %s", given.name, problem);
  if (const char* moved = given.moved != nullptr ? given.moved() : nullptr; moved != nullptr)
    return fail(RUNG_REFUSED, "the bit-field %s of %s lies elsewhere than its layout says: run rungc bind again", moved,
                given.name);
  if (const int32_t status = checkLayout(call->running.program(), given); status != RUNG_OK) return status;
  return contained([&] { return bindStruct(*call, given, static_cast<uint8_t*>(address)); });
}

int32_t rung_instance_inconsistent(const rung_instance* instance, const void* address, uint32_t* slices) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  if (slices == nullptr) return fail(RUNG_BAD_ARGUMENT, "the pointer that receives the number is null");
  const HostStruct* found = call->structs.at(address);
  if (found == nullptr || !found->guarded())
    return fail(RUNG_NOT_FOUND, "no struct with counters is bound at this address");
  *slices = found->inconsistent();
  return RUNG_OK;
}
