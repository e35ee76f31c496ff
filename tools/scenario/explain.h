// Why a name holds its value: the rungs that write it, what decides whether they run, and every name that they read
// with its value and the scan of its last change.
#pragma once
#include <string>
#include <string_view>

#include "ir/uses/uses.h"
#include "tools/scenario/changes.h"
#include "tools/scenario/session.h"

namespace rung::scenario {

class Explainer final : public Observer {
public:
  // After the session's start and before its first scan; both outlive the explainer.
  Explainer(const Session& session, const ir::Uses& uses) : session_(session), uses_(uses), changes_(session, uses) {}

  void scanned(const Session& session) override { changes_.scanned(session); }

  // Lines, each begun by a line break; "" for what lies in the NC and not in the program's memory.
  std::string why(std::string_view name) const;

private:
  const Session& session_;
  const ir::Uses& uses_;
  Changes changes_;
};

} // namespace rung::scenario
