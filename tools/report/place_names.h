// Places of a program under the names that its user would write.
#pragma once
#include <optional>
#include <string>

#include "frontend/sema/analysis.h"
#include "ir/analysis/uses.h"
#include "rtlib/run/instance.h"

namespace rung::report {

// The place of a use without an index; of a reference, its bits; nothing for a constant.
runtime::Ref refOf(const ir::Use& use);
// The range as a reference to a bit or to whole bytes.
runtime::Ref refAt(const ir::BitRange& bits);
ir::BitRange bitsOf(const runtime::Ref& place);
// The bits of a place that the front end names. Nothing if it names none, or if the program lacks the space.
std::optional<ir::BitRange> rangeOf(const rung_program& program, const frontend::NamedPlace& place);

// The place where a user would look for it: for a latch that the compiler made, the place from which it was copied.
// Nothing for a place without a name.
std::optional<ir::BitRange> knownPlace(const rung_program& program, const ir::Uses& uses, const ir::BitRange& place);

// The place under which a cross reference lists it: NC memory that is copied over the program's own, as !X of NCT over
// X, is not a separate place.
ir::BitRange listedPlace(const rung_program& program, const ir::Uses& uses, const ir::BitRange& place);

// The symbol of exactly this place; "" if there is none.
std::string symbolAt(const rung_program& program, const runtime::Ref& place);
// For messages: "CLAMPED (X2.0)", "X2.1"; in a program without addresses (nc::hasAddresses) "CLAMPED". A bit without a
// symbol has the name of its signal.
std::string shownName(const rung_program& program, const runtime::Ref& place);
// A name that resolves to the place; "" if the dialect has none.
std::string writtenName(const rung_program& program, const runtime::Ref& use);

// Whether the control or the machine writes the place, and whether one of them reads it.
bool isWrittenByControl(const rung_program& program, const ir::Uses& uses, const runtime::Ref& place);
bool isReadByControl(const rung_program& program, const ir::Uses& uses, const runtime::Ref& place);

} // namespace rung::report
