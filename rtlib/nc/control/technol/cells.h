// What the NC of a TECHNOL program reads and writes in it: cells of the program and of the interface, elements of the
// queue of command blocks, modules with their registers at entry. Names in any case; what the program lacks is left
// out.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "rtlib/nc/signal.h"
#include "rtlib/run/instance.h"

namespace rung::nc::technol {

// The interface's own names: a cell, `STRUCTURE.MEMBER`, `CELL.WEIGHT`, `BLK[n].ELEMENT`, `BLK[n].ELEMENT[k]`, a type
// before the element or not.
std::optional<runtime::Ref> signalPlace(const rung_program& program, std::string_view name);
std::optional<runtime::Ref> cellPlace(const rung_program& program, std::string_view name);
std::optional<runtime::Ref> placeOf(const rung_program& program, const Signal& signal);

// The same, looked up once for the scans: what the program lacks reads 0 and takes nothing.
core::Place locateSignal(const rung_program& program, std::string_view name);
core::Place locateCell(const rung_program& program, std::string_view name);
// The first elements of an array of the interface.
void locateElements(const rung_program& program, std::string_view array, std::span<core::Place> elements);

// 0 where there is no such cell.
uint64_t readCell(const runtime::Instance& instance, std::string_view name);
void writeCell(runtime::Instance& instance, std::string_view name, uint64_t value);

// A module or an event procedure of a program, with its registers; it is looked up once and then runs without names.
class Procedure {
public:
  Procedure() = default; // none
  Procedure(const rung_program& program, std::string_view task);
  // One run. False: the program has none, or it failed.
  bool run(runtime::Instance& instance, uint64_t dr, bool rlo) const;

private:
  uint32_t task_ = RUNG_NONE;
  core::Place dr_, rlo_;
};

// One run of what is looked up now: not in a scan.
bool runWith(runtime::Instance& instance, std::string_view task, uint64_t dr, bool rlo);

} // namespace rung::nc::technol
