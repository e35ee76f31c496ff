"""Runs in gdb: stops at lines in a given order and prints expressions there, as the variable `plan` in JSON says:
[[FILE:LINE, [EXPRESSION, …]], …]."""
import json

import gdb

plan = json.loads(gdb.parse_and_eval("$plan").string())
for place in sorted({place for place, _ in plan}):
    gdb.execute(f"break {place}", to_string=True)


def line():
    return gdb.selected_frame().find_sal().line


last = None
for number, (place, expressions) in enumerate(plan):
    gdb.execute("run" if number == 0 else "continue", to_string=True)
    # A line may have several places in the code.
    while last is not None and line() == last:
        gdb.execute("continue", to_string=True)
    last = line()
    print(f"line {last}")
    while gdb.selected_frame().type() == gdb.INLINE_FRAME:  # g++ may stop in an operation of the rung
        gdb.execute("up", to_string=True)
    for expression in expressions:
        try:
            shown = gdb.execute(f"print {expression}", to_string=True).split(" = ", 1)[1].strip()
        except gdb.error as error:
            shown = f"error: {error}"
        print(f"{expression} = {shown}")
