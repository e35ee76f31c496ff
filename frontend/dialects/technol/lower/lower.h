// The lowering functions of the rows, by family. `variant` distinguishes the members of a family.
#pragma once

#include <span>

#include "frontend/lower/operations.h"
#include "ir/core/builder.h"

namespace rung::frontend::technol {

class Lowering;
struct Operand;

enum Condition { kAlways, kIfRlo, kIfNotRlo };
inline constexpr int kEqualIfRlo = kGreater + 1; // in addition to frontend's Relation
enum Unary { kIncrement, kDecrement, kNegate, kAbsolute };
enum Count { kCountUp, kCountDown, kCountUpBcd };

// lower_bits.cpp
void lowerLoadBit(Lowering& l, std::span<const Operand> o, int);
void lowerLicence(Lowering& l, std::span<const Operand> o, int);
void lowerJoin(Lowering& l, std::span<const Operand> o, int logic);
void lowerComplement(Lowering& l, std::span<const Operand> o, int);
void lowerEdge(Lowering& l, std::span<const Operand> o, int rising);
void lowerWrite(Lowering& l, std::span<const Operand> o, int);
void lowerFlag(Lowering& l, std::span<const Operand> o, int condition);
void lowerMoveBit(Lowering& l, std::span<const Operand> o, int condition);
void lowerNothing(Lowering& l, std::span<const Operand> o, int);
void lowerJump(Lowering& l, std::span<const Operand> o, int condition);

// lower_data.cpp
void lowerLoad(Lowering& l, std::span<const Operand> o, int);
void lowerStore(Lowering& l, std::span<const Operand> o, int condition);
void lowerMove(Lowering& l, std::span<const Operand> o, int condition);
void lowerArithmetic(Lowering& l, std::span<const Operand> o, int operation);
void lowerBitwise(Lowering& l, std::span<const Operand> o, int logic);
void lowerCompare(Lowering& l, std::span<const Operand> o, int relation);
void lowerUnary(Lowering& l, std::span<const Operand> o, int operation);
void lowerIncrementBcd(Lowering& l, std::span<const Operand> o, int);
void lowerBin(Lowering& l, std::span<const Operand> o, int);
void lowerBcd(Lowering& l, std::span<const Operand> o, int);
void lowerShift(Lowering& l, std::span<const Operand> o, int right);
void lowerToReal(Lowering& l, std::span<const Operand> o, int);
void lowerDrToRlo(Lowering& l, std::span<const Operand> o, int);
void lowerRloToDr(Lowering& l, std::span<const Operand> o, int);
void lowerMovBx(Lowering& l, std::span<const Operand> o, int);

// lower_text.cpp
void lowerMoveMemory(Lowering& l, std::span<const Operand> o, int);
void lowerClear(Lowering& l, std::span<const Operand> o, int);
void lowerCopyText(Lowering& l, std::span<const Operand> o, int);
void lowerAddText(Lowering& l, std::span<const Operand> o, int);
void lowerNumberToText(Lowering& l, std::span<const Operand> o, int bcd);
void lowerCompareText(Lowering& l, std::span<const Operand> o, int);
void lowerCopyBytes(Lowering& l, std::span<const Operand> o, int);
void lowerCompareBytes(Lowering& l, std::span<const Operand> o, int);

// lower_data.cpp: counters
void lowerTimer(Lowering& l, std::span<const Operand> o, int);
void lowerCounter(Lowering& l, std::span<const Operand> o, int kind);

// lower_mechanism.cpp
void lowerMechInit(Lowering& l, std::span<const Operand> o, int);
void lowerEx(Lowering& l, std::span<const Operand> o, int);
void lowerBex(Lowering& l, std::span<const Operand> o, int);
void lowerExWhile(Lowering& l, std::span<const Operand> o, int level); // EX0: 0, EX1: 1
void lowerTimedEx(Lowering& l, std::span<const Operand> o, int level);
void lowerWait(Lowering& l, std::span<const Operand> o, int);

// procedures.cpp
void lowerCall(Lowering& l, std::span<const Operand> o, int);
void lowerFinished(Lowering& l, std::span<const Operand> o, int hostCell);

// lower_message.cpp
void lowerMessage(Lowering& l, std::span<const Operand> o, int condition);
void lowerBitMessage(Lowering& l, std::span<const Operand> o, int);

// lower_exchange.cpp; `kind` is a nc::ExchangeKind
void lowerDefine(Lowering& l, std::span<const Operand> o, int kind);
void lowerUpdate(Lowering& l, std::span<const Operand> o, int);

// lower_exchange.cpp: shared variables
void lowerShareVariable(Lowering& l, std::span<const Operand> o, int);
void lowerShareBit(Lowering& l, std::span<const Operand> o, int);

// lower_service.cpp; `form` is the DataForm of the data operand
void lowerService(Lowering& l, std::span<const Operand> o, int form);
void lowerPolled(Lowering& l, std::span<const Operand> o, int form);
void lowerShared(Lowering& l, std::span<const Operand> o, int form);

// lower_channels.cpp: CAN
void lowerCanSend(Lowering& l, std::span<const Operand> o, int);
void lowerCanReceive(Lowering& l, std::span<const Operand> o, int);
void lowerCanOrder(Lowering& l, std::span<const Operand> o, int);
void lowerUnitRead(Lowering& l, std::span<const Operand> o, int);
void lowerUnitWrite(Lowering& l, std::span<const Operand> o, int);
void lowerDriveSend(Lowering& l, std::span<const Operand> o, int);

// lower_spindle.cpp
void lowerAnalogPort(Lowering& l, std::span<const Operand> o, int);
void lowerAnalog(Lowering& l, std::span<const Operand> o, int);
void lowerAnalogSpindle(Lowering& l, std::span<const Operand> o, int);
void lowerToSpindle(Lowering& l, std::span<const Operand> o, int);
void lowerToAxis(Lowering& l, std::span<const Operand> o, int);
void lowerRamp(Lowering& l, std::span<const Operand> o, int);

// lower_position.cpp
void lowerPositionMode(Lowering& l, std::span<const Operand> o, int);
void lowerPositionControl(Lowering& l, std::span<const Operand> o, int);

// lower_channels.cpp: COM
void lowerComSend(Lowering& l, std::span<const Operand> o, int);
void lowerComReceive(Lowering& l, std::span<const Operand> o, int);
void lowerComControl(Lowering& l, std::span<const Operand> o, int);

// lower_config.cpp
void lowerConfiguration(Lowering& l, std::span<const Operand> o, int kind);

} // namespace rung::frontend::technol
