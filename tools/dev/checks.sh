# ./dev check: its parts (listed in dev, which reads this file), and the table of what has come of them.
# shellcheck shell=bash
# shellcheck disable=SC2317 # the parts are called by their names

checks_table=out/checks.tsv # a line a run: part, commit, begin, seconds, result
minutes_allowed=60          # a part
failed=()

check() { # [--table] [--resume] [NAME...]: the parts in this order; one that fails does not stop the others
  local names=() resume=no name
  while [ $# -gt 0 ]; do
    case "$1" in
      --table) check_table; return ;;
      --resume) resume=yes ;;
      -*) die "check: '$1' is not an option" ;;
      *) names+=("$1") ;;
    esac
    shift
  done
  [ ${#names[@]} -gt 0 ] || mapfile -t names < <(check_parts | awk -F'|' '$2 != "-" {print $1}')
  for name in "${names[@]}"; do
    check_parts | cut -d'|' -f1 | grep -qxF -- "$name" || die "'$name' is not a check; ./dev help lists them"
  done
  setup --check
  mkdir -p out
  trap 'echo "check: interrupted" >&2; exit 130' INT # a part that ends by itself then is not the end of all
  for name in "${names[@]}"; do
    if [ $resume = yes ] && has_passed "$name"; then echo "-- check $name has passed on this commit"; continue; fi
    run_part "$name"
  done
  check_table
  [ ${#failed[@]} = 0 ] || die "failed: ${failed[*]}"
}

tree() { # the commit, with a + behind it where something is not committed
  local commit
  commit=$(git rev-parse --short=12 HEAD)
  [ -z "$(git status --porcelain)" ] || commit+=+
  echo "$commit"
}

last_run() { # NAME: its last line in the table
  awk -F'\t' -v name="$1" '$1 == name {line = $0} END {print line}' "$checks_table" 2>/dev/null
}

has_passed() { # NAME: on this commit, with nothing changed since
  local now part commit result
  now=$(tree)
  [[ $now != *+ ]] || return 1
  IFS=$'\t' read -r part commit _ _ result < <(last_run "$1") || return 1
  [ "$part" = "$1" ] && [ "$commit" = "$now" ] && [ "$result" = passed ]
}

run_part() { # NAME
  local name=$1 commit began result=passed status
  commit=$(tree)
  began=$(date '+%F %H:%M')
  SECONDS=0
  echo "-- check $name"
  set +e # within a condition, -e would be off in the part, too
  (set -e; "check_$name") 2>&1 | tee "out/check-$name.log"
  status=${PIPESTATUS[0]}
  set -e
  [ "$(tree)" = "$commit" ] || commit=${commit%+}+ # what has run is not what the commit says
  if [ "$status" != 0 ]; then result=failed
  elif [ $SECONDS -gt $((minutes_allowed * 60)) ]; then result="over $minutes_allowed min"; fi
  [ "$result" = passed ] || failed+=("$name")
  printf '%s\t%s\t%s\t%s\t%s\n' "$name" "$commit" "$began" $SECONDS "$result" >>"$checks_table"
  echo "-- check $name: $result after $((SECONDS / 60)) min $((SECONDS % 60)) s"
}

check_table() { # the last run of each part
  local name part commit began seconds result
  printf '%-14s %-14s %-17s %8s  %s\n' part commit begin time result
  while IFS='|' read -r name _; do
    part='' commit=- began=- seconds='' result=-
    IFS=$'\t' read -r part commit began seconds result < <(last_run "$name") || true
    [ -n "$part" ] || { printf '%-14s %-14s %-17s %8s  %s\n' "$name" - - - 'not run'; continue; }
    printf '%-14s %-14s %-17s %8s  %s\n' "$name" "$commit" "$began" "$((seconds / 60)):$(printf %02d $((seconds % 60)))" "$result"
  done < <(check_parts)
  echo "this is $(tree) (with a +: changes that are not committed)"
}

build_tests() { # PRESET FOLDER: no more than its tests need
  local targets
  configure_preset "$1" "$2"
  ninja_in "$2" build.ninja
  targets=$(tools/dev/tests.py targets "$2" -R .) || exit 3
  # shellcheck disable=SC2086 # a word each
  ninja_in "$2" $targets
}

check_format() { format --check; }

check_lint() { lint; }

check_gcc() { # g++ as second compiler, of all
  build_preset gcc build-gcc
  test_in build-gcc
}

check_asan() { # addresses and undefined behaviour, in everything but LLVM
  build_tests asan build-asan
  # LLVM gives threads a signal stack of its own, which the sanitizer would unmap at their end.
  ASAN_OPTIONS=use_sigaltstack=0 LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0" test_in build-asan
}

check_tsan() { # data races: runtime, simulation, the component's box, programs as generated C++
  build_preset tsan build-tsan tsan_tests
  test_in build-tsan -L threads
}

check_coverage() { # which lines the tests run; a source file that none of them runs is a failure
  # Tables and manual pages are made by programs of ours while others are built.
  LLVM_PROFILE_FILE="$PWD/build-coverage/profile/build/%4m.profraw" build_preset coverage build-coverage
  rm -f build-coverage/profile/*.profraw
  LLVM_PROFILE_FILE="$PWD/build-coverage/profile/%4m.profraw" test_in build-coverage
  tools/dev/coverage-report build-coverage
}

check_reads() {
  build_tests release build
  python3 tools/dev/reads.py build
}

check_fuzz() { # hostile tables with the sanitizers, too
  RUNG_MUTATIONS=30000 run_tests -R '^fuzz\.'
  build_preset asan build-asan rung_test_fuzz
  RUNG_MUTATIONS=2000 ASAN_OPTIONS=use_sigaltstack=0 build-asan/bin/tests/rung_test_fuzz --gtest_filter='*HostileTables*'
}

check_simulate() { # hosts, each with an order of events of its own
  build_some rung_host_sim
  build/bin/tests/rung_host_sim --count 100000
}

check_long() { RUNG_LONG=1 run_tests -R '^(differential|engines|gsk|reports)\.'; } # tests/support/long_run.h

check_truth() { RUNG_TRUTH=large run_tests -L '^truth$'; }

check_growth() {
  build_some rung_growth
  python3 tests/growth/growth_test.py build/bin/tests/rung_growth 500
}

check_counts() {
  build_some rungc rung-bench rung-bench-generated rung-bench-record rung-bench-scan rung-bench-services
  python3 tools/bench/count.py build/bin --check
}

check_recordings() { # what they take, and whether all is played as it was
  build_some rungc rung-bench-scan rung-bench-work
  python3 tools/bench/recordings.py build/bin
}

check_replace() { # the state afterwards, the processor time, and what the programs do
  build_some rung_replace rungc
  build/bin/tests/rung_replace build/tests/replace 10000 --bounds
  run_selected -V -R '^replace\.instructions$'
  python3 tests/replace/tools_test.py build/bin/rungc --long
  python3 tests/replace/machines_test.py build/bin/rungc --long
}

# What the scripts below find in the folder of the programs, and what those load and start.
commands=(rungc rungctl rung-run rung-compile rung_simulation rung_runtime)

check_kills() {
  build_some "${commands[@]}" rung_hal
  python3 tests/soak/kills_test.py build/bin --module build/lib/rung_hal.so
}

check_loads() { # in a running thread
  build_some "${commands[@]}" rung_hal
  python3 tests/soak/loads_test.py build/bin build/lib/rung_hal.so
}

check_aborts() { # all dialects
  build_some "${commands[@]}" rung_hal
  python3 tests/soak/aborts_test.py build/bin build/lib/rung_hal.so
}

check_endurance() {
  build_some "${commands[@]}" rung_hal
  python3 tests/soak/endurance_test.py build/bin build/lib/rung_hal.so
}

check_abi() { # and the check finds every kind of change
  build_some rung_runtime rung_compiler
  python3 tests/abi/abi.py check build/lib
  python3 tests/abi/abi_test.py
}

check_fanuc() { # programs of others, which FANUC_PROGRAMS names
  build_some rungc rung-bench-real rung_fanuc_engines rung_fanuc_module
  python3 tests/fanuc-programs/fanuc_programs_test.py build/bin
}

check_web() { # the live page, in Chromium
  build_some rungc
  /usr/bin/python3 tests/web/page_test.py build/bin/rungc
  /usr/bin/python3 tests/web/flow_test.py build/bin/rungc 1000
  /usr/bin/python3 tests/web/large_test.py build/bin/rungc
}

check_connections() { # mbpoll and pymodbus: values, and counted overruns
  build_some "${commands[@]}"
  /usr/bin/python3 tests/connections/long_run.py build/bin 600
}

check_can() { # frames, errors, a full queue, an interface that is down
  build_some "${commands[@]}"
  python3 tests/can/in_uml.py build/bin
}

check_runtime() { # the runtime alone: without the compiler's libraries, by g++; and for another processor
  build_preset runtime build-runtime
  test_in build-runtime
  build_preset runtime-arm64 build-runtime-arm64
  test_in build-runtime-arm64
  build_some "${commands[@]}" rung_hal rung_play_recording
  python3 tests/other-machine/session.py build build-runtime-arm64
}

# By name only: the component with the HAL of LinuxCNC's master, in a HAL of the tests.
check_linuxcnc-next() {
  local source=${RUNG_LINUXCNC_SRC:-} folder=build-linuxcnc-next
  [ -f "$source/src/hal/hal.h" ] || die "RUNG_LINUXCNC_SRC='$source' must name a folder with LinuxCNC's sources"
  grep -q hal_pin_new_bool "$source/src/hal/hal.h" || die "HAL in $source is the older one, which ./dev test covers"
  git -C "$source" log -1 --format='LinuxCNC %H of %cs' 2>/dev/null || echo "LinuxCNC without its history"
  configure release $folder -B $folder -DRUNG_TESTS=ON "-DRUNG_HAL_HEADERS=$source/src/hal;$source/src/rtapi"
  ninja_in $folder rung_hal rung_test_realtime
  test_in $folder -R '^realtime\.Component'
}

check_packages() { # Debian packages: made twice, installed into a clean Debian, used there, removed
  packaging/check-packages
}
