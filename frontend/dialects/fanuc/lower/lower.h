// The lowering functions of the rows that FANUC has of its own, and the lowering of a program. Those that it shares
// with others are in frontend/network/lower/functions.h.
#pragma once
#include <memory>
#include <span>

#include "frontend/dialects/dialect.h"
#include "frontend/dialects/fanuc/areas.h"
#include "frontend/dialects/fanuc/language.h"
#include "frontend/lower/operations.h"
#include "frontend/network/lower/lower_function.h"
#include "frontend/network/read/context.h"

namespace rung::frontend::fanuc {

using network::Lowering;

enum TimerVariant { kTimerPage, kTimerFixed, kTimerMemory };
enum WindowVariant { kWindowRead, kWindowWrite };
enum CounterVariant { kCounterPage, kCounterFixed, kCounterMemory };
using enum frontend::Edge;
using enum frontend::Logic;
using enum frontend::Arithmetic;

void lowerTimer(Lowering& f);
void lowerOffDelay(Lowering& f);
void lowerCounter(Lowering& f);
void lowerEdge(Lowering& f);

void lowerCompare(Lowering& f);
// The variant is a frontend::Relation.
void lowerRelation(Lowering& f);
void lowerRange(Lowering& f);

// BCD; the variant of lowerBcdArithmetic is a frontend::Arithmetic, that of lowerBcdCompare a frontend::Relation.
void lowerBcdDecode(Lowering& f);
void lowerBcdRotation(Lowering& f);
void lowerBcdTable(Lowering& f);
void lowerBcdConversion(Lowering& f);
void lowerBcdCompare(Lowering& f);
void lowerBcdSearch(Lowering& f);
void lowerBcdIndexedMove(Lowering& f);
void lowerBcdArithmetic(Lowering& f);
void lowerBcdNumber(Lowering& f);

void lowerDisplay(Lowering& f);
void lowerWindow(Lowering& f);
void lowerAxisControl(Lowering& f);
void lowerExternalData(Lowering& f);

// Cells that the program has in the host's sight. DISPB counts in one byte the instructions that show messages.
inline constexpr const char* kDisplaySpace = "@DISPB";

// The module of a program without errors.
std::unique_ptr<ir::Module> lowerProgram(const network::Program& program, network::Context& context,
                                         std::span<const FileId> files, const frontend::CompileOptions& options);

} // namespace rung::frontend::fanuc
