// Whether two modules are alike in every field. The structured bindings stop the build when a struct gets a field that
// is not compared here; each is used exactly once.
#pragma once
#include "ir/core/module.h"

namespace rung::ir {

bool equal(const Location& a, const Location& b);
bool equal(const Op& a, const Op& b);
bool equal(const Transfer& a, const Transfer& b);
bool equal(const Rung& a, const Rung& b);
bool equal(const Routine& a, const Routine& b);
bool equal(const Space& a, const Space& b);
bool equal(const Slot& a, const Slot& b);
bool equal(const Symbol& a, const Symbol& b);
bool equal(const SpaceSpan& a, const SpaceSpan& b);
bool equal(const Copy& a, const Copy& b);
bool equal(const Init& a, const Init& b);
bool equal(const Task& a, const Task& b);
bool equal(const Step& a, const Step& b);
bool equal(const MessageText& a, const MessageText& b);
bool equal(const Module& a, const Module& b);

} // namespace rung::ir
