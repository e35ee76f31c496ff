// Places of a program by the names that its user would write.
#pragma once
#include <optional>
#include <string>

#include "frontend/sema/analysis.h"
#include "ir/analysis/uses.h"
#include "rtlib/run/instance.h"

namespace rung::report {

// The place of a use that is not computed; the bits of a reference, nothing for a constant.
runtime::Ref refOf(const ir::Use& use);
// A bit, or whole bytes.
runtime::Ref refAt(const ir::BitRange& bits);
ir::BitRange bitsOf(const runtime::Ref& place);
// What the front end calls a place. Nothing for none, and for a space that the program lacks.
std::optional<ir::BitRange> rangeOf(const rung_program& program, const frontend::NamedPlace& place);

// Where a user would look for it: a latch that the compiler made is what it was copied from. Nothing for what has no
// name.
std::optional<ir::BitRange> knownPlace(const rung_program& program, const ir::Uses& uses, const ir::BitRange& place);

// The place under which a cross reference has it: the NC's memory that is copied over the program's own, as !X of NCT
// over X, is not another place.
ir::BitRange listedPlace(const rung_program& program, const ir::Uses& uses, const ir::BitRange& place);

// The symbol that lies exactly there; "" when there is none.
std::string symbolAt(const rung_program& program, const runtime::Ref& place);
// For messages: "CLAMPED (X2.0)", "X2.1"; of a program without addresses (nc::hasAddresses) "CLAMPED".
std::string shownName(const rung_program& program, const runtime::Ref& place);
// For computed addresses: "one of D100 to D119".
std::string shownRange(const rung_program& program, const ir::BitRange& range);
// A name that resolves to the place; "" when the dialect has none.
std::string writtenName(const rung_program& program, const runtime::Ref& use);

// Whether the control or the machine writes it; whether one of them reads it.
bool isWrittenByControl(const rung_program& program, const ir::Uses& uses, const runtime::Ref& place);
bool isReadByControl(const rung_program& program, const ir::Uses& uses, const runtime::Ref& place);

} // namespace rung::report
