// Life management of the tools (see tool_life.h).
#include "sim/nct/tool_life.h"

namespace rung::sim::nct {
namespace {

constexpr int64_t kSecondUs = 1'000'000;

bool noticeReached(const ToolRow& row) {
  const int32_t notice = row.word(kToolNotice);
  return notice > 0 && row.hasLife() && row.word(kToolLife) - row.word(kToolCounter) <= notice;
}

} // namespace

const ToolRequests& ToolLife::cycle(uint32_t spindle, const ToolAnswers& answers, bool managed) {
  Spindle& s = spindles_[spindle];
  s.answers = answers;
  s.managed = managed;
  if (!managed) {
    s.requests = {};
    s.skipped = s.noticeDue = false;
    return s.requests;
  }
  if (answers.individualDone) s.requests.individual = false;
  if (answers.groupDone) s.requests.group = false;
  if (s.skipped) s.requests.individual = true; // after the acknowledge, l.8953
  s.skipped = false;
  if (answers.skip && !s.requests.skipDone) {
    const uint32_t tool = toolIn(spindle);
    s.requests.skipDone = true;
    s.skipped = tool != 0;
    if (tool != 0) {
      tables_.tools.row(tool).setWord(kToolStatus, kLifeBroken);
      tellGroup(s, tables_.tools.row(tool).word(kToolType));
    }
  }
  if (!answers.skip) s.requests.skipDone = false;
  s.requests.notice = s.noticeDue; // for one cycle, l.8957
  s.noticeDue = false;
  return s.requests;
}

void ToolLife::tellGroup(Spindle& spindle, int32_t type) {
  if (tables_.groupExpired(type)) spindle.requests.group = true;
}

void ToolLife::add(uint32_t spindle, bool time) {
  Spindle& s = spindles_[spindle];
  const uint32_t tool = toolIn(spindle);
  if (!s.managed || tool == 0 || s.answers.countDisabled) return;
  ToolRow& row = tables_.tools.row(tool);
  const int32_t before = row.status();
  if (!row.valid() || row.info(kInfoTime) != time || (before != kLifeNotUsed && before != kLifeUsed)) return;
  const bool noticed = noticeReached(row);
  if (row.word(kToolCounter) != INT32_MAX) row.setWord(kToolCounter, row.word(kToolCounter) + 1);
  row.setWord(kToolStatus, kLifeUsed);
  row.renewStatus();
  s.noticeDue = s.noticeDue || (!noticed && noticeReached(row));
  written(tool, before);
}

void ToolLife::countUse(uint32_t spindle) {
  if (spindle < nc::nct::kSpindles) add(spindle, false);
}

void ToolLife::countTime(uint32_t spindle, int64_t us) {
  if (spindle >= nc::nct::kSpindles) return;
  Spindle& s = spindles_[spindle];
  const uint32_t tool = toolIn(spindle);
  if (tool != s.timedTool) s.us = 0;
  s.timedTool = tool;
  for (s.us += us; s.us >= kSecondUs; s.us -= kSecondUs) add(spindle, true);
}

void ToolLife::written(uint32_t dataNumber, int32_t statusBefore) {
  const ToolRow& row = tables_.tools.row(dataNumber);
  const int32_t status = row.status();
  if (status == statusBefore || (status != kLifeExpired && status != kLifeBroken)) return;
  const std::optional<PotPlace> place = tables_.cartridges.placeOf(dataNumber);
  if (!place || place->cartridge % 10 != 0) return;
  const uint32_t spindle = place->cartridge / 10 - 1;
  if (spindle >= nc::nct::kSpindles || !spindles_[spindle].managed) return;
  if (status == kLifeExpired) spindles_[spindle].requests.individual = true;
  tellGroup(spindles_[spindle], row.word(kToolType));
}

} // namespace rung::sim::nct
