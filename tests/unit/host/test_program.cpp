// Tables and code of the hand-written programs.
#include "tests/unit/host/test_program.h"

#include <cstring>

#include "rtlib/nc/gsk/services.h"

namespace rung::host::testing {
namespace {

constexpr uint32_t kX = 0, kY = 16, kF = 32, kG = 96, kR = 160, kD = 192, kPositions = 256, kGskSize = 288;
constexpr uint32_t kSlice = 8192; // bytes of NCT's M and TS
constexpr uint32_t kMessages = 2 * kSlice;

bool bit(const uint8_t* mem, uint32_t byte, uint32_t number) { return ((mem[byte] >> number) & 1) != 0; }
void setBit(uint8_t* mem, uint32_t byte, uint32_t number, bool value) {
  mem[byte] = static_cast<uint8_t>((mem[byte] & ~(1u << number)) | (static_cast<unsigned>(value) << number));
}

// FIN is the strobe of any function, or what X2.0 says while X1.3 is on. High-speed: M is finished at once, T when X2.1
// is on.
void answerFunctions(uint8_t* mem) {
  const bool strobe = bit(mem, kF + 7, 0) || bit(mem, kF + 7, 2) || bit(mem, kF + 7, 3);
  setBit(mem, kG + 4, 3, bit(mem, kX + 1, 3) ? bit(mem, kX + 2, 0) : strobe);
  setBit(mem, kG + 5, 0, bit(mem, kF + 7, 0));
  if (bit(mem, kX + 2, 1)) setBit(mem, kG + 5, 3, bit(mem, kF + 7, 3));
}

uint32_t gskScan(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  if (bit(mem, kX + 1, 0)) {
    ctx->fault.code = 0;
    ctx->fault.rung = 0;
    ctx->fault.line = 42;
    return RUNG_PC_FAULT;
  }
  setBit(mem, kY, 0, bit(mem, kX, 0));
  answerFunctions(mem);
  uint16_t count;
  std::memcpy(&count, mem + kD, 2);
  ++count;
  std::memcpy(mem + kD, &count, 2);
  std::memcpy(mem + kD + 16, mem + kPositions, 8);
  std::memcpy(mem + kD + 4, mem + kF + 10, 4);
  std::memcpy(mem + kD + 8, mem + kF + 14, 4);
  if (bit(mem, kX + 1, 1)) {
    const uint32_t ticket = ctx->host->service_request(ctx, 0, nullptr, 0);
    mem[kD + 12] = static_cast<uint8_t>(ctx->host->service_poll(ctx, ticket));
    mem[kD + 13] = static_cast<uint8_t>(ctx->host->service_result(ctx, ticket, 0));
  }
  if (bit(mem, kX + 1, 2)) {
    const rung_message message = {RUNG_MESSAGE_SHOW, 7, 0, 0, 0, 0, 0};
    ctx->host->message(ctx, &message);
  }
  return RUNG_PC_DONE;
}

// A message host as the compiler makes it: the code that was sent, and what the NC says of it.
void nctMessage(uint8_t* mem, rung_ctx* ctx, bool input) {
  uint32_t host[2];
  std::memcpy(host, mem + kMessages, sizeof host);
  if (input != (host[0] != 0)) {
    host[0] = input ? 3000705 : 0;
    host[1] = 0;
    std::memcpy(mem + kMessages, host, sizeof host);
    const rung_message message = {input ? RUNG_MESSAGE_SHOW_LOG : RUNG_MESSAGE_CLEAR, 7, 3, 5, 42, 0, 0};
    ctx->host->message(ctx, &message);
  }
  setBit(mem, 400 * 4, 1, host[1] != 0);
}

uint32_t nctScan(uint8_t* mem, rung_ctx* ctx, uint32_t) {
  setBit(mem, 400 * 4, 0, bit(mem, 56 * 4 + 2, 1)); // bit 17 of word 56
  nctMessage(mem, ctx, bit(mem, 56 * 4 + 2, 2));
  std::memcpy(mem + kSlice, mem, kSlice);
  return RUNG_PC_DONE;
}

uint32_t technolScan(uint8_t*, rung_ctx*, uint32_t) { return RUNG_PC_DONE; }

constexpr rung_range packed(const uint32_t bytes, const uint32_t offset) {
  return {0, bytes, offset, RUNG_REPR_PACKED};
}
constexpr rung_range kGskRanges[] = {packed(16, kX), packed(16, kY), packed(64, kF),        packed(64, kG),
                                     packed(32, kR), packed(64, kD), packed(32, kPositions)};
constexpr rung_space kGskSpaces[] = {
    {"X", 1, 16, RUNG_SPACE_INPUT, 1, &kGskRanges[0]},
    {"Y", 1, 16, RUNG_SPACE_OUTPUT, 1, &kGskRanges[1]},
    {"F", 1, 64, RUNG_SPACE_INPUT, 1, &kGskRanges[2]},
    {"G", 1, 64, RUNG_SPACE_OUTPUT, 1, &kGskRanges[3]},
    {"R", 1, 32, 0, 1, &kGskRanges[4]},
    {"D", 1, 64, 0, 1, &kGskRanges[5]},
    {"@MPOS", 4, 32, RUNG_SPACE_HIDDEN, 1, &kGskRanges[6]},
};
constexpr rung_symbol kGskSymbols[] = {
    {"LIMIT", "", 0, 0, 0, RUNG_TYPE_I32, 1, RUNG_SYMBOL_CONST, 5},
    {"SYM", "", 1, 1, 2, RUNG_TYPE_BIT, 1, 0, 0},
};
constexpr rung_span kGskRetains[] = {{kD, 64}};
constexpr rung_span kGskSafes[] = {{kY, 16}, {kG, 64}};
constexpr rung_range kNctRanges[] = {packed(kSlice, 0), packed(kSlice, kSlice), packed(8, kMessages)};
constexpr rung_space kNctSpaces[] = {{"M", 4, kSlice, RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT, 1, &kNctRanges[0]},
                                     {"TS", 4, kSlice, RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT, 1, &kNctRanges[1]},
                                     {"@SHOWN", 4, 8, RUNG_SPACE_HIDDEN, 1, &kNctRanges[2]}};
constexpr rung_range kTechnolRanges[] = {packed(32, 0), packed(64, 64)};
constexpr rung_space kTechnolSpaces[] = {{"NCI", 1, 32, RUNG_SPACE_INPUT | RUNG_SPACE_OUTPUT, 1, &kTechnolRanges[0]},
                                         {"DATA", 1, 64, 0, 1, &kTechnolRanges[1]}};
constexpr rung_symbol kTechnolSymbols[] = {
    {"COUNT", "", 1, 8, 0, RUNG_TYPE_I16, 1, 0, 0},
    {"NAME", "", 1, 16, 0, RUNG_TYPE_TEXT, 12, 0, 0},
    {"REALCELL", "", 1, 0, 0, RUNG_TYPE_I64, 1, 0, 0},
};

constexpr rung_chunk kChunks[] = {{0, 1, 1}};
constexpr rung_info kRungs[] = {{"all of it", 0, 40, 44, 0, 1, 1, 0}};
constexpr const char* kRoutines[] = {"MAIN"};
constexpr const char* kFiles[] = {"main.pmc"};
constexpr uint32_t kPartEnds[] = {RUNG_PC_DONE};
constexpr const char* kFaults[] = {"dead-loop"};
constexpr const char* kServices[] = {nc::gsk::service(nc::pmc::ServiceKind::ReadWindow).text.data()};
constexpr rung_message_text kTexts[] = {{7, 0, "Oil level low"}};
constexpr rung_task kTasks8ms[] = {{"MAIN", 0, 8000, 1000, 0, 0, 0, 0, 0, 0, 1}};
constexpr rung_task kTasks10ms[] = {{"MAIN", 0, 10000, 1000, 0, 0, 1, 0, 0, 0, 1}};
constexpr rung_copy kNctCopies[] = {{RUNG_COPY_ALL, kSlice, 0, 0, kSlice}};
constexpr rung_task kTasks20ms[] = {{"MAIN", 0, 20000, 1000, 0, 0, 0, 0, 0, 0, 1}};
constexpr rung_step kScan8ms[] = {{RUNG_STEP_ADVANCE, RUNG_NONE, 8000}, {RUNG_STEP_RUN, 0, 1}};
constexpr rung_step kScan10ms[] = { // two time slices, the NC's work in front of each
    {RUNG_STEP_ADVANCE, RUNG_NONE, 5000}, {RUNG_STEP_HOOK, RUNG_NONE, 1}, {RUNG_STEP_SLOT, RUNG_NONE, 0},
    {RUNG_STEP_ADVANCE, RUNG_NONE, 5000}, {RUNG_STEP_HOOK, RUNG_NONE, 1}, {RUNG_STEP_RUN, 0, 1}};
constexpr rung_step kScanHook[] = {{RUNG_STEP_HOOK, RUNG_NONE, 1}, {RUNG_STEP_RUN, 0, 1}}; // the task's period
constexpr rung_chunk_fn kGskCode[] = {&gskScan};
constexpr rung_chunk_fn kNctCode[] = {&nctScan};
constexpr rung_chunk_fn kTechnolCode[] = {&technolScan};

rung_program common(const char* dialect, const rung_task* tasks, const rung_chunk_fn* code) {
  rung_program p = {};
  p.size = sizeof p;
  p.abi_version = RUNG_ABI_VERSION;
  p.name = "test";
  p.dialect = dialect;
  p.compiler = "by hand";
  p.memory_align = 8;
  p.fast_task = RUNG_NONE;
  p.chunk_count = p.rung_count = p.routine_count = p.file_count = p.task_count = p.part_end_count = 1;
  p.fault_count = p.service_count = 1;
  p.text_count = 1;
  p.chunks = kChunks;
  p.rungs = kRungs;
  p.routines = kRoutines;
  p.files = kFiles;
  p.tasks = tasks;
  p.part_ends = kPartEnds;
  p.faults = kFaults;
  p.services = kServices;
  p.texts = kTexts;
  p.chunk_fns = code;
  return p;
}

template <size_t Spaces, size_t Steps>
rung_program withMemory(rung_program p, uint32_t size, const rung_space (&spaces)[Spaces],
                        const rung_step (&scan)[Steps]) {
  p.memory_size = size;
  p.space_count = Spaces;
  p.spaces = spaces;
  p.scan_count = Steps;
  p.scan = scan;
  return p;
}

} // namespace

const rung_program& gskProgram() {
  static const rung_program program = [] {
    rung_program p = withMemory(common("gsk", kTasks8ms, kGskCode), kGskSize, kGskSpaces, kScan8ms);
    p.symbol_count = 2;
    p.symbols = kGskSymbols;
    p.safe_count = 2;
    p.safe_spans = kGskSafes;
    p.retain_count = 1;
    p.retains = kGskRetains;
    return p;
  }();
  return program;
}

const rung_program& nctProgram() {
  static const rung_program program = [] {
    rung_program p = withMemory(common("nct", kTasks10ms, kNctCode), 2 * kSlice + 8, kNctSpaces, kScan10ms);
    p.copy_count = 1;
    p.copies = kNctCopies;
    return p;
  }();
  return program;
}

const rung_program& technolProgram() {
  static const rung_program program = [] {
    rung_program p = withMemory(common("technol", kTasks20ms, kTechnolCode), 128, kTechnolSpaces, kScanHook);
    p.symbol_count = 3;
    p.symbols = kTechnolSymbols;
    return p;
  }();
  return program;
}

} // namespace rung::host::testing
