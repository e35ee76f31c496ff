// The lowering functions of the rows, and the lowering of a program. The functions of ends, jumps, calls and the common
// line are in frontend/network/lower.
#pragma once
#include <memory>
#include <span>

#include "frontend/dialects/dialect.h"
#include "frontend/dialects/gsk/areas.h"
#include "frontend/dialects/gsk/language.h"
#include "frontend/lower/operations.h"
#include "frontend/network/lower/lower_function.h"
#include "frontend/network/read/context.h"

namespace rung::frontend::gsk {

using network::isIn;
using network::Lowering;

enum TimerVariant { kTimerPage, kTimerFixed, kTimerMemory };
enum CounterVariant { kCounterPage, kCounterMemory };
enum WindowVariant { kWindowRead, kWindowWrite };
using enum frontend::Edge;
using enum frontend::Logic;
using enum frontend::Arithmetic;

void lowerTimer(Lowering& f);
void lowerCounter(Lowering& f);

void lowerCompare(Lowering& f);
void lowerCoincidence(Lowering& f);

void lowerWindow(Lowering& f);
void lowerAxisControl(Lowering& f);
void lowerPositionZones(Lowering& f);
void lowerPositionRange(Lowering& f);

// The module of a program without errors.
std::unique_ptr<ir::Module> lowerProgram(const network::Program& program, network::Context& context,
                                         std::span<const FileId> files, const frontend::CompileOptions& options);

} // namespace rung::frontend::gsk
