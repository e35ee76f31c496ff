// Sets of forced cells: prepared for a program, activated between two slices.
#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstring>

#include "rtlib/api/error.h"
#include "rtlib/api/replacing.h"
#include "rtlib/api/running.h"
#include "rtlib/change/forcing.h"

using namespace rung;
using namespace rung::api;

namespace {

struct Force {
  std::string name;
  std::string owner;
  rung_type type = RUNG_TYPE_BIT;
  rung_value value{};
  int64_t sinceUs = 0; // scan thread
};

// Code made by a compiler, released when it is no longer used.
struct MadeCode {
  MadeCode() = default;
  MadeCode(const MadeCode&) = delete;
  MadeCode& operator=(const MadeCode&) = delete;
  ~MadeCode() {
    if (made.release != nullptr) made.release(made.owner);
  }
  rung_forced_code made{};
};

} // namespace

struct rung_forces {
  rung_forces(rung_instance& of, std::shared_ptr<Generation> program, std::vector<Force> cells,
              std::span<const runtime::ForcedCell> places)
      : instance(of), generation(std::move(program)), forces(std::move(cells)),
        forcing(generation->program(), generation->image->engine, places) {}

  uint32_t mark = kForcesMark;
  rung_instance& instance;
  std::shared_ptr<Generation> generation; // whose program the forces are for
  std::vector<Force> forces;              // sorted by name
  runtime::Forcing forcing;
  MadeCode code;
  std::atomic<bool> inEffect{false};
};

namespace rung::api {

void settleForces(rung_instance& instance) noexcept {
  if (instance.forces == nullptr || instance.running.forced()) return;
  instance.forces->inEffect.store(false, std::memory_order_release);
  instance.forces = nullptr;
}

namespace {

uint64_t bitsOf(const LocatedCell& cell, rung_value value) {
  return cell.place.real ? std::bit_cast<uint64_t>(value.real) : static_cast<uint64_t>(value.integer);
}

// The value as the cell holds it: a bit is 0 or 1, an integer is sign-extended.
rung_value held(const LocatedCell& cell, rung_value value) noexcept {
  if (cell.place.real) return value;
  if (cell.place.width() == 1) return {.integer = value.integer & 1};
  const uint32_t unused = cell.place.unused;
  return {.integer = static_cast<int64_t>(static_cast<uint64_t>(value.integer) << unused) >> unused};
}

// Finds the cell where readers read the name, and, if it differs, the cell that the machine writes.
int32_t locate(const rung_instance& instance, const rung_program& program, const rung_forced_cell& wanted, Force& force,
               std::vector<runtime::ForcedCell>& places) {
  const auto access = static_cast<int32_t>(wanted.access);
  if (access != RUNG_READ && access != RUNG_REAL)
    return fail(RUNG_BAD_ARGUMENT, "a cell is forced with RUNG_READ or RUNG_REAL, not with %d", access);
  const LocatedCell read = locateCell(*instance.environment, program, {wanted.name, access});
  if (read.state == CellState::Retyped)
    return fail(RUNG_WRONG_TYPE, "%s has no room for a real of 64 bits", wanted.name);
  if (read.state != CellState::Good)
    return fail(RUNG_NOT_FOUND,
                "%s is not a name of the program %s, an address of its dialect or a signal of the NC's interface",
                wanted.name, program.name);
  if (read.type == RUNG_TYPE_TEXT || read.ref.kind == runtime::RefKind::Constant)
    return fail(RUNG_WRONG_TYPE, "%s is a text or a constant: it cannot be forced", wanted.name);
  if (instance.environment->control().isConstant(program, read.ref))
    return fail(RUNG_WRONG_TYPE, "%s is a constant of the control, in the code of the program: it cannot be forced",
                wanted.name);
  places.push_back({.ref = read.ref, .bits = bitsOf(read, wanted.value), .name = wanted.name});
  const LocatedCell written = locateCell(*instance.environment, program, {wanted.name, RUNG_WRITE | access});
  if (written.state != CellState::Gone && written.state != CellState::Retyped && !(written.ref == read.ref))
    places.push_back({.ref = written.ref, .bits = bitsOf(written, wanted.value), .name = wanted.name});
  force = {.name = wanted.name,
           .owner = wanted.owner != nullptr ? wanted.owner : "",
           .type = read.type,
           .value = held(read, wanted.value)};
  return RUNG_OK;
}

int32_t makeCode(rung_forces& forces) {
  const Image& image = *forces.generation->image;
  const rung_code_maker* maker = image.maker.load();
  if (maker == nullptr)
    return fail(RUNG_REFUSED,
                "the program %s writes a cell that is to be forced: that needs a compiler for its image "
                "(rung_compiler_serve)",
                image.program.name);
  const rung_image handle{.image = forces.generation->image};
  std::array<char, 512> problem{};
  const std::vector<rung_forced_byte>& bytes = forces.forcing.bytes();
  const int32_t status =
      maker->force(maker->user, &handle, image.engine, bytes.data(), static_cast<uint32_t>(bytes.size()),
                   &forces.code.made, problem.data(), problem.size());
  if (status != RUNG_OK) return fail(static_cast<rung_status>(status), "%s", problem.data());
  forces.forcing.setCode({forces.code.made.chunk_fns, forces.code.made.engine});
  return RUNG_OK;
}

int32_t prepare(rung_instance& instance, std::shared_ptr<Generation> generation,
                std::span<const rung_forced_cell> cells, rung_forces*& result) {
  std::vector<Force> forces(cells.size());
  std::vector<runtime::ForcedCell> places;
  for (size_t i = 0; i < cells.size(); ++i) {
    if (cells[i].name == nullptr) return fail(RUNG_BAD_ARGUMENT, "cell %zu has no name", i);
    if (const int32_t status = locate(instance, generation->program(), cells[i], forces[i], places); status != RUNG_OK)
      return status;
  }
  std::ranges::sort(forces, {}, &Force::name);
  auto made = std::make_unique<rung_forces>(instance, std::move(generation), std::move(forces), places);
  if (!made->forcing.problem().empty()) return fail(RUNG_BAD_ARGUMENT, "%s", made->forcing.problem().c_str());
  if (made->forcing.needsCode())
    if (const int32_t status = makeCode(*made); status != RUNG_OK) return status;
  result = made.release();
  return RUNG_OK;
}

bool same(const Force& a, const Force& b) noexcept {
  return a.owner == b.owner && a.type == b.type && a.value.integer == b.value.integer;
}

// A cell that was already forced to the same value keeps its time.
void keepTimes(const std::vector<Force>& before, std::vector<Force>& now, int64_t nowUs) noexcept {
  auto old = before.begin();
  for (Force& force : now) {
    while (old != before.end() && old->name < force.name) ++old;
    const bool lasts = old != before.end() && old->name == force.name && same(*old, force);
    force.sinceUs = lasts ? old->sinceUs : nowUs;
  }
}

} // namespace
} // namespace rung::api

int32_t rung_forces_new(rung_instance* instance, rung_replacement* replacement, const rung_forced_cell* cells,
                        uint32_t count, rung_forces** forces) {
  rung_instance* handle = instanceOf(instance);
  if (handle == nullptr) return failHandle("an instance");
  if (forces == nullptr) return fail(RUNG_BAD_ARGUMENT, "the pointer that receives the set of forces is null");
  if (cells == nullptr || count == 0)
    return fail(RUNG_BAD_ARGUMENT, "a set of forces needs a cell at least; null ends the forces in effect");
  return contained([&] {
    std::shared_ptr<Generation> generation;
    if (replacement == nullptr) generation = handle->generations.running();
    if (replacement != nullptr)
      if (const int32_t status = nextOf(*handle, replacement, generation); status != RUNG_OK) return status;
    return prepare(*handle, std::move(generation), {cells, count}, *forces);
  });
}

int32_t rung_forces_free(rung_forces* forces) {
  if (forces == nullptr) return RUNG_OK;
  rung_forces* handle = checked(forces, kForcesMark);
  if (handle == nullptr) return failHandle("a set of forces");
  rung_instance& instance = handle->instance;
  if (handle->inEffect.load(std::memory_order_acquire)) {
    const Call call(&instance);
    if (!call.ok()) return call.status();
    call->running.endForces();
    settleForces(*call);
    if (call->recorder) call->recorder->forcesChanged();
  }
  release(handle);
  instance.generations.release();
  return RUNG_OK;
}

int32_t rung_instance_force(rung_instance* instance, rung_forces* forces) {
  const Call call(instance, When::On);
  if (!call.ok()) return call.status();
  runtime::Instance& running = call->running;
  if (forces == nullptr) {
    running.endForces();
    settleForces(*call);
    if (call->recorder) call->recorder->forcesChanged();
    return RUNG_OK;
  }
  rung_forces* handle = checked(forces, kForcesMark);
  if (handle == nullptr) return failHandle("a set of forces");
  if (&handle->instance != &*call) return fail(RUNG_BAD_ARGUMENT, "the forces were made for another instance");
  if (handle->generation.get() != &call->now())
    return fail(RUNG_WRONG_STATE, "the forces were made for another program than the one that runs");
  if (running.stopped()) return fail(RUNG_WRONG_STATE, "a stopped program has no forces");
  if (running.faulted()) return RUNG_FAULTED;
  if (call->forces != handle) {
    static const std::vector<Force> kNone;
    keepTimes(call->forces != nullptr ? call->forces->forces : kNone, handle->forces, running.nowUs());
    running.endForces();
    settleForces(*call);
  }
  running.force(handle->forcing);
  if (call->recorder) call->recorder->forcesChanged();
  handle->inEffect.store(true, std::memory_order_release);
  call->forces = handle;
  return RUNG_OK;
}

int32_t rung_instance_forced(const rung_instance* instance, uint32_t index, rung_force_info* force) {
  const Call call(instance, When::Always);
  if (!call.ok()) return call.status();
  if (call->forces == nullptr || index >= call->forces->forces.size()) return RUNG_EMPTY;
  const Force& f = call->forces->forces[index];
  return giveStruct(
      force,
      rung_force_info{
          .type = f.type, .value = f.value, .since_us = f.sinceUs, .name = f.name.c_str(), .owner = f.owner.c_str()});
}
