// The checks of rows on several operands at once or on the position of the statement, by family. They run if each
// operand is right by itself.
#pragma once
#include <span>

namespace rung::frontend::technol {

struct CheckContext;
struct Operand;

// Data.
void checkLoad(const CheckContext& c, std::span<const Operand> o, int);
void checkArithmetic(const CheckContext& c, std::span<const Operand> o, int);
void checkRealUse(const CheckContext& c, std::span<const Operand> o, int);
void checkToReal(const CheckContext& c, std::span<const Operand> o, int);
void checkToInteger(const CheckContext& c, std::span<const Operand> o, int);
void checkMove(const CheckContext& c, std::span<const Operand> o, int);

// Flow.
void checkEmptyStack(const CheckContext& c, std::span<const Operand> o, int);
void checkJump(const CheckContext& c, std::span<const Operand> o, int);
void checkTimedEx(const CheckContext& c, std::span<const Operand> o, int);
void checkTimer(const CheckContext& c, std::span<const Operand> o, int);
void checkCall(const CheckContext& c, std::span<const Operand> o, int);

// Texts and bytes.
void checkMoveMemory(const CheckContext& c, std::span<const Operand> o, int);
void checkClear(const CheckContext& c, std::span<const Operand> o, int);
void checkTexts(const CheckContext& c, std::span<const Operand> o, int);
void checkNumberToText(const CheckContext& c, std::span<const Operand> o, int);
void checkCopyBytes(const CheckContext& c, std::span<const Operand> o, int);
void checkCompareBytes(const CheckContext& c, std::span<const Operand> o, int);

// Messages, mechanisms, data shared with the control.
void checkMessage(const CheckContext& c, std::span<const Operand> o, int);
void checkBitMessage(const CheckContext& c, std::span<const Operand> o, int);
void checkDefine(const CheckContext& c, std::span<const Operand> o, int);
void checkUpdate(const CheckContext& c, std::span<const Operand> o, int);
void checkShareVariable(const CheckContext& c, std::span<const Operand> o, int);
void checkShareBit(const CheckContext& c, std::span<const Operand> o, int);
void checkConfiguration(const CheckContext& c, std::span<const Operand> o, int kind);

// Services; `form` is the DataForm of the data operand.
void checkService(const CheckContext& c, std::span<const Operand> o, int form);
void checkPacket(const CheckContext& c, std::span<const Operand> o, int);
void checkRecord(const CheckContext& c, std::span<const Operand> o, int);
void checkEtherCatCommand(const CheckContext& c, std::span<const Operand> o, int form);
void checkUnitItem(const CheckContext& c, std::span<const Operand> o, int);

} // namespace rung::frontend::technol
