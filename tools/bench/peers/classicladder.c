// Bit logic in ClassicLadder's interpreter as a peer (generated/peer.h). It has the rungs as the editor makes them,
// with the coil in the last column, one section, and no inputs or outputs of HAL, which its module copies around a
// scan.
#include <stdlib.h>
#include <string.h>

#include "calc.c"
#include "vars_access.c"

#define EXPORTED __attribute__((visibility("default")))

#define BIT(number) +1
enum {
  BITS =
#include "places.inc"
};

#undef BIT
#define LOGIC(...) +1
enum {
  RUNGS =
#include "rungs.inc"
};
#undef LOGIC

static StrInfosGene infos;
static StrSection section = {
    .Used = TRUE, .Language = SECTION_IN_LADDER, .SubRoutineNumber = -1, .LastRung = RUNGS - 1};
static StrRung rungs[RUNGS];
static char bits[BITS + NBR_STEPS];
static int words[NBR_STEPS];
StrInfosGene* InfosGene = &infos;
StrSection* SectionArray = &section;
StrRung* RungArray = rungs;
char* VarArray = bits;
int* VarWordArray = words;

// What else the sources refer to, which bit logic does not use.
StrTimer* TimerArray;
StrMonostable* MonostableArray;
StrCounter* CounterArray;
StrTimerIEC* NewTimerArray;
StrArithmExpr* ArithmExpr;
double* VarFloatArray;
int EvalCompare(char* text) { abort(); }
void MakeCalc(char* text, int verify) { abort(); }
void PrepareSequential(void) {}
void RefreshSequentialPage(int page) { abort(); }
int SearchSubRoutineWithItsNumber(int number) { abort(); }
void rtapi_print(const char* text, ...) { abort(); }
int rtapi_snprintf(char* out, unsigned long size, const char* text, ...) { return 0; } // of labels, which are empty

static void element(StrRung* rung, int x, int y, short type, int bit) {
  rung->Element[x][y].Type = type;
  rung->Element[x][y].VarType = VAR_MEM_BIT;
  rung->Element[x][y].VarNum = bit;
}

static void contact(StrRung* rung, int x, int y, int bit, int negated) {
  element(rung, x, y, negated ? ELE_INPUT_NOT : ELE_INPUT, bit);
}

static void logic(int number, int parallel, int first, int firstNegated, int second, int secondNegated, int third,
                  int thirdNegated, int coil) {
  StrRung* rung = &rungs[number];
  rung->Used = TRUE;
  rung->NextRung = number + 1;
  contact(rung, 0, 0, first, firstNegated);
  contact(rung, parallel ? 0 : 1, parallel ? 1 : 0, second, secondNegated);
  int x = parallel ? 1 : 2;
  rung->Element[1][1].ConnectedWithTop = parallel;
  contact(rung, x, 0, third, thirdNegated);
  while (++x < RUNG_WIDTH - 1) element(rung, x, 0, ELE_CONNECTION, 0);
  element(rung, x, 0, ELE_OUTPUT, coil);
}

EXPORTED void peer_begin(void) {
  infos.GeneralParams.SizesInfos = (plc_sizeinfo_s){.nbr_rungs = RUNGS, .nbr_bits = BITS, .nbr_sections = 1};
  InitVars();
  InitRungs();
  int number = 0;
#define LOGIC(...) logic(number++, __VA_ARGS__);
#include "rungs.inc"
}

EXPORTED void peer_scan(int ms) {
  infos.GeneralParams.PeriodicRefreshMilliSecs = ms;
  ClassicLadder_RefreshAllSections();
}

#define BIT(number) &bits[number],
EXPORTED void* peer_places[] = {
#include "places.inc"
};
