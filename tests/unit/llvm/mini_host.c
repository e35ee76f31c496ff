/* The smallest host (see mini_host.h). */
#include "mini_host.h"

static _Alignas(64) uint8_t memory[kMiniHostMemory];
static rung_prof counters[kMiniHostRungs];
static uint64_t trace; /* of calls to the host */
static uint32_t tickets;

static uint64_t hashWord(uint64_t hash, uint64_t word) {
  for (int i = 0; i < 8; ++i) hash = (hash ^ ((word >> (8 * i)) & 255)) * 0x100000001B3ull;
  return hash;
}

static void message(rung_ctx* ctx, const rung_message* m) {
  (void)ctx;
  trace = hashWord(hashWord(hashWord(trace, m->op), m->number), (uint32_t)m->channel);
  trace = hashWord(hashWord(hashWord(hashWord(trace, (uint32_t)m->index), (uint64_t)m->value), m->real), m->rung);
}

static uint32_t request(rung_ctx* ctx, uint32_t service, const int64_t* args, uint32_t count) {
  (void)ctx;
  trace = hashWord(hashWord(trace, service), count);
  for (uint32_t i = 0; i < count; ++i) trace = hashWord(trace, (uint64_t)args[i]);
  return ++tickets;
}

static uint32_t poll(rung_ctx* ctx, uint32_t ticket) {
  (void)ctx;
  trace = hashWord(trace, ticket);
  return ticket != 0 && ticket <= tickets ? RUNG_SERVICE_DONE : RUNG_SERVICE_NONE;
}

static int64_t result(rung_ctx* ctx, uint32_t ticket, uint32_t number) {
  (void)ctx;
  trace = hashWord(hashWord(trace, ticket), number);
  return (int64_t)hashWord(ticket, number);
}

static void copySpans(const rung_program* p, uint32_t first, uint32_t count) {
  for (uint32_t k = first; k < first + count; ++k) {
    const rung_copy* c = &p->copies[k];
    for (uint32_t i = 0; i < c->size; ++i) {
      if (c->kind == RUNG_COPY_ALL) {
        memory[c->to + i] = memory[c->from + i];
        continue;
      }
      uint8_t* mask = &memory[c->mask + i];
      memory[c->to + i] = (uint8_t)((memory[c->to + i] & ~*mask) | (memory[c->from + i] & *mask));
      *mask = 0;
    }
  }
}

static void runMain(const rung_program* p, rung_ctx* ctx) {
  const rung_task* task = p->tasks + p->main_task;
  copySpans(p, task->begin_first, task->begin_count);
  ctx->stack[0] = RUNG_PC_DONE;
  ctx->sp = 1;
  uint32_t pc = task->entry;
  while (pc < p->chunk_count) pc = p->chunk_fns[pc](memory, ctx, pc);
  copySpans(p, task->end_first, task->end_count);
}

static uint64_t hashAll(const rung_program* p, const rung_ctx* ctx) {
  uint64_t hash = 0xCBF29CE484222325ull;
  for (uint32_t i = 0; i < p->memory_size; ++i) hash = (hash ^ memory[i]) * 0x100000001B3ull;
  for (uint32_t i = 0; i < p->rung_count; ++i) hash = hashWord(hash, counters[i].count);
  hash = hashWord(hashWord(hashWord(hash, ctx->fault.code), ctx->fault.rung), ctx->fault.line);
  return hashWord(hash, trace);
}

int miniHostRun(const rung_program* p, void* engine, uint32_t scans, uint64_t* hashes) {
  static const rung_host_api api = {sizeof(rung_host_api), 0, message, request, poll, result};
  static rung_ctx ctx;
  if (p->memory_size > kMiniHostMemory || p->rung_count > kMiniHostRungs) return 1;
  for (uint32_t i = 0; i < p->memory_size; ++i) memory[i] = 0;
  for (uint32_t i = 0; i < p->rung_count; ++i) counters[i].count = 0;
  for (uint32_t i = 0; i < p->init_count; ++i)
    for (uint32_t k = 0; k < p->inits[i].size; ++k) memory[p->inits[i].offset + k] = p->inits[i].data[k];
  trace = 0;
  tickets = 0;
  ctx.now_us = 0;
  ctx.host = &api;
  ctx.prof = counters;
  ctx.engine = engine;
  ctx.fault.code = RUNG_NONE;
  ctx.fault.rung = ctx.fault.line = 0;
  for (uint32_t i = 0; i < scans; ++i) {
    ctx.now_us += 8000;
    if (ctx.fault.code == RUNG_NONE) runMain(p, &ctx);
    hashes[i] = hashAll(p, &ctx);
  }
  return 0;
}
