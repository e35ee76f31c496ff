// The lowering functions of the rows, by family. `variant` distinguishes the members of a family.
#pragma once

#include <span>

#include "frontend/lower/compare.h"
#include "ir/core/builder.h"

namespace rung::frontend::technol {

class StatementContext;
struct Operand;

enum BitJoin { kAnd, kOr, kXor };
enum Condition { kAlways, kIfRlo, kIfNotRlo };
enum Arithmetic { kAdd, kSubtract, kMultiply, kDivide };
inline constexpr int kEqualIfRlo = kGreater + 1; // besides frontend's Relation
enum Unary { kIncrement, kDecrement, kNegate, kAbsolute };
enum Count { kCountUp, kCountDown, kCountUpBcd };

// lower_bits.cpp
ir::ValueId joined(ir::RungBuilder& b, int join, ir::ValueId left, ir::ValueId right);
void lowerLoadBit(StatementContext& l, std::span<const Operand> o, int);
void lowerLicence(StatementContext& l, std::span<const Operand> o, int);
void lowerJoin(StatementContext& l, std::span<const Operand> o, int join);
void lowerComplement(StatementContext& l, std::span<const Operand> o, int);
void lowerEdge(StatementContext& l, std::span<const Operand> o, int rising);
void lowerWrite(StatementContext& l, std::span<const Operand> o, int);
void lowerFlag(StatementContext& l, std::span<const Operand> o, int condition);
void lowerMoveBit(StatementContext& l, std::span<const Operand> o, int condition);
void lowerNothing(StatementContext& l, std::span<const Operand> o, int);
void lowerJump(StatementContext& l, std::span<const Operand> o, int condition);

// lower_data.cpp
void lowerLoad(StatementContext& l, std::span<const Operand> o, int);
void lowerStore(StatementContext& l, std::span<const Operand> o, int condition);
void lowerMove(StatementContext& l, std::span<const Operand> o, int condition);
void lowerArithmetic(StatementContext& l, std::span<const Operand> o, int operation);
void lowerBitwise(StatementContext& l, std::span<const Operand> o, int join);
void lowerCompare(StatementContext& l, std::span<const Operand> o, int relation);
void lowerUnary(StatementContext& l, std::span<const Operand> o, int operation);
void lowerIncrementBcd(StatementContext& l, std::span<const Operand> o, int);
void lowerBin(StatementContext& l, std::span<const Operand> o, int);
void lowerBcd(StatementContext& l, std::span<const Operand> o, int);
void lowerShift(StatementContext& l, std::span<const Operand> o, int right);
void lowerToReal(StatementContext& l, std::span<const Operand> o, int);
void lowerDrToRlo(StatementContext& l, std::span<const Operand> o, int);
void lowerRloToDr(StatementContext& l, std::span<const Operand> o, int);
void lowerMovBx(StatementContext& l, std::span<const Operand> o, int);

// lower_text.cpp
void lowerMoveMemory(StatementContext& l, std::span<const Operand> o, int);
void lowerClear(StatementContext& l, std::span<const Operand> o, int);
void lowerCopyText(StatementContext& l, std::span<const Operand> o, int);
void lowerAddText(StatementContext& l, std::span<const Operand> o, int);
void lowerNumberToText(StatementContext& l, std::span<const Operand> o, int bcd);
void lowerCompareText(StatementContext& l, std::span<const Operand> o, int);
void lowerCopyBytes(StatementContext& l, std::span<const Operand> o, int);
void lowerCompareBytes(StatementContext& l, std::span<const Operand> o, int);

// lower_count.cpp
void lowerTimer(StatementContext& l, std::span<const Operand> o, int);
void lowerCounter(StatementContext& l, std::span<const Operand> o, int kind);

// lower_mechanism.cpp
void lowerMechInit(StatementContext& l, std::span<const Operand> o, int);
void lowerEx(StatementContext& l, std::span<const Operand> o, int);
void lowerBex(StatementContext& l, std::span<const Operand> o, int);
void lowerExWhile(StatementContext& l, std::span<const Operand> o, int level); // EX0: 0, EX1: 1
void lowerTimedEx(StatementContext& l, std::span<const Operand> o, int level);
void lowerWait(StatementContext& l, std::span<const Operand> o, int);

// lower_calls.cpp
void lowerCall(StatementContext& l, std::span<const Operand> o, int);
void lowerFinished(StatementContext& l, std::span<const Operand> o, int hostCell);

// lower_message.cpp
void lowerMessage(StatementContext& l, std::span<const Operand> o, int condition);
void lowerBitMessage(StatementContext& l, std::span<const Operand> o, int);

// lower_exchange.cpp; `kind` is a nc::ExchangeKind
void lowerDefine(StatementContext& l, std::span<const Operand> o, int kind);
void lowerUpdate(StatementContext& l, std::span<const Operand> o, int);

// lower_share.cpp
void lowerShareVariable(StatementContext& l, std::span<const Operand> o, int);
void lowerShareBit(StatementContext& l, std::span<const Operand> o, int);

// lower_service.cpp; `form` is the DataForm of the data operand
void lowerService(StatementContext& l, std::span<const Operand> o, int form);
void lowerPolled(StatementContext& l, std::span<const Operand> o, int form);
void lowerShared(StatementContext& l, std::span<const Operand> o, int form);

// lower_can.cpp
void lowerCanSend(StatementContext& l, std::span<const Operand> o, int);
void lowerCanReceive(StatementContext& l, std::span<const Operand> o, int);
void lowerCanOrder(StatementContext& l, std::span<const Operand> o, int);
void lowerUnitRead(StatementContext& l, std::span<const Operand> o, int);
void lowerUnitWrite(StatementContext& l, std::span<const Operand> o, int);
void lowerDriveSend(StatementContext& l, std::span<const Operand> o, int);

// lower_spindle.cpp
void lowerAnalogPort(StatementContext& l, std::span<const Operand> o, int);
void lowerAnalog(StatementContext& l, std::span<const Operand> o, int);
void lowerAnalogSpindle(StatementContext& l, std::span<const Operand> o, int);
void lowerToSpindle(StatementContext& l, std::span<const Operand> o, int);
void lowerToAxis(StatementContext& l, std::span<const Operand> o, int);
void lowerRamp(StatementContext& l, std::span<const Operand> o, int);

// lower_position.cpp
void lowerPositionMode(StatementContext& l, std::span<const Operand> o, int);
void lowerPositionControl(StatementContext& l, std::span<const Operand> o, int);

// lower_com.cpp
void lowerComSend(StatementContext& l, std::span<const Operand> o, int);
void lowerComReceive(StatementContext& l, std::span<const Operand> o, int);
void lowerComControl(StatementContext& l, std::span<const Operand> o, int);

// lower_config.cpp
void lowerConfiguration(StatementContext& l, std::span<const Operand> o, int kind);

} // namespace rung::frontend::technol
