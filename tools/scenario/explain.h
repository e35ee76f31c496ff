// Why a name holds its value: the rungs that write it, what decides whether they run, and every name that they read
// with its value and the scan of its last change.
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "ir/analysis/uses.h"
#include "tools/scenario/changes.h"
#include "tools/scenario/session.h"

namespace rung::scenario {

class Explainer final : public Observer {
public:
  // After the session's start and before its first scan; both outlive the explainer. Without `uses` (of a program that
  // was not compiled here) nothing can be explained.
  Explainer(const Session& session, const ir::Uses* uses) : session_(session) { follow(uses); }

  void scanned(const Session& session) override {
    if (changes_) changes_->scanned(session);
  }
  void replaced(const Session&, const NextProgram& next) override {
    follow(next.uses);
    replaced_ = true;
  }

  bool knowsProgram() const { return uses_ != nullptr; }
  // Lines, each begun by a line break; "" for what lies in the NC and not in the program's memory.
  // `wantReal`: of the real that begins there.
  std::string why(std::string_view name, bool wantReal = false) const;

private:
  void follow(const ir::Uses* uses) {
    uses_ = uses;
    changes_.reset();
    if (uses != nullptr) changes_.emplace(session_, *uses);
  }

  const Session& session_;
  const ir::Uses* uses_ = nullptr;
  std::optional<Changes> changes_; // of the program that runs
  bool replaced_ = false;
};

} // namespace rung::scenario
