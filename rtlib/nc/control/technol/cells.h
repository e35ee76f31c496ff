// The parts of a TECHNOL program that its NC accesses: cells of the program and of the interface, elements of the queue
// of command blocks, modules with their registers at entry. Names are not case-sensitive.
#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "rtlib/nc/signal.h"
#include "rtlib/run/instance.h"

namespace rung::nc::technol {

// Finds a place by a name of the interface: a cell, `STRUCTURE.MEMBER`, `CELL.WEIGHT`, `BLK[n].ELEMENT`,
// `BLK[n].ELEMENT[k]`, optionally with a type before the element.
std::optional<runtime::Ref> signalPlace(const rung_program& program, std::string_view name);
std::optional<runtime::Ref> cellPlace(const rung_program& program, std::string_view name);
std::optional<runtime::Ref> placeOf(const rung_program& program, const Signal& signal);

// The same as a Place for the scans: a cell that the program does not have reads 0, and writing it does nothing.
core::Place locateSignal(const rung_program& program, std::string_view name);
core::Place locateCell(const rung_program& program, std::string_view name);
// Looks up the first elements of an array of the interface.
void locateElements(const rung_program& program, std::string_view array, std::span<core::Place> elements);

// Access by name. A missing cell reads 0, and writing it does nothing.
uint64_t readCell(const runtime::Instance& instance, std::string_view name);
void writeCell(runtime::Instance& instance, std::string_view name, uint64_t value);

// A module or an event procedure of a program, with its registers, looked up once so that scans need no names.
class Procedure {
public:
  Procedure() = default; // none
  Procedure(const rung_program& program, std::string_view task);
  // Runs it once. False: the program does not have it, or it failed.
  bool run(runtime::Instance& instance, uint64_t dr, bool rlo) const;

private:
  uint32_t task_ = RUNG_NONE;
  core::Place dr_, rlo_;
};

// Looks the task up and runs it once: not in a scan.
bool runWith(runtime::Instance& instance, std::string_view task, uint64_t dr, bool rlo);

} // namespace rung::nc::technol
