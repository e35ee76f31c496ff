#!/usr/bin/env python3
"""What a program asks of its CNC, answered through the host's socket: services_test.py BIN CLASS"""
import json
import random
import socket
import subprocess
import sys
import unittest

import remote_test
from patience import patience
from remote_test import Host, WRONG

# X0.0 reads variable 500 into D10:4, end code in D2:2; X0.1 writes D30:4 to the tool number, end code in D22:2;
# X0.2 reads the machine position of axis D48:2 into D50:4 at once, end code in D42:2.
WINDOWS = """dialect gsk
FUNC END1
LD   X0.0
FUNC WINDR
PRM  D0
PRM  R20
OUT  R10.0
LD   X0.1
FUNC WINDW
PRM  D20
PRM  R22
OUT  R10.1
LD   X0.2
FUNC WINDR
PRM  D40
PRM  R24
OUT  R10.2
FUNC END2
"""
# 7000.00 moves axis 5 by 12.5 at 600, .01 sends it to its reference point, .02 moves it by a feed per revolution, .03 asks
# where the second axis is; 7003.00: at -2.5.
AXES = """dialect nct
module MAIN

rung
|--[N_ON]--(AP_PLCR,#5)

rung
|--[7000.00]--[/7001.00]--[/7002.00]--{MOVCMND #5 #3 *600.0 *12.5}--(S 7001.00)

rung
|--[7000.00]--[FL_ER]--(S 7002.00)

rung
|--[7000.01]--[/7001.01]--[/7002.01]--{MOVCMND #5 #7 *0.0 *0.0}--(S 7001.01)

rung
|--[7000.01]--[FL_ER]--(S 7002.01)

rung
|--[7000.02]--[/7001.02]--[/7002.02]--{MOVCMND #5 #5 *1.0 *1.0}--(S 7001.02)

rung
|--[7000.02]--[FL_ER]--(S 7002.02)

rung
|--[7000.03]--[/7001.03]--[/7002.03]--{SCP 7010 ActPosAx #2 #0}--(S 7001.03)

rung
|--[7000.03]--[FL_ER]--(S 7002.03)

rung
|--{FLEQ 7010 *-2.5}--(7003.00)

rung
|--{END}
"""
# X0.1 hands the block at D0 to group A, X0.2 is RST: R11.0 says that it is taken.
GROUP = """dialect gsk
FUNC END1
LD   X0.0
OUT  G8.4
OUT  EAX4
LD   X0.2
LD   X0.1
FUNC AXLCTL
PRM  1
PRM  D0
PRM  R10
OUT  R11.0
FUNC LBL
PRM  L1
LD   X0.7
FUNC JMPB
PRM  L1
FUNC END2
"""
BLOCKS = {"D0:2": 9, "D4:2": 4, "D6:2": 500, "D20:2": 31, "D24:2": 4, "D40:2": 17, "D44:2": 4, "D48:2": 2}
VARIABLE = {"event": "service", "quantity": "macro-variable", "channel": 0, "number": 500, "axis": 0}
TOOL = {"event": "service", "quantity": "tool-number", "channel": 0, "number": 0, "axis": 0, "value": 7.0}


class Provider(Host):
    map = '[rungctl]\npermissions = ["set", "serve"]\n'

    def provider(self):
        made, lines = self.connect()
        lines.readline()
        self.assertTrue(self.ask((made, lines), do="serve")["ok"])
        return made, lines

    def ask(self, connection, **request):
        made, lines = connection
        made.sendall(json.dumps(request).encode() + b"\n")
        while "event" in (answer := json.loads(lines.readline())):
            pass
        return answer

    def event(self, connection):
        return json.loads(connection[1].readline())


class Services(Provider):
    program_text = WINDOWS

    def setUp(self):
        super().setUp()
        for name, value in BLOCKS.items():
            self.ctl("set", name, value)

    def end_of(self, name, condition, output):
        """The end code after the condition has come, and without it again."""
        self.ctl("set", condition, "1")
        self.wait(lambda: self.get(output))
        code = self.get(name)
        self.ctl("set", condition, "0")
        self.wait(lambda: not self.get(output))
        return code

    def test_without_a_provider_requests_are_refused_at_once(self):
        self.assertEqual(self.end_of("D2:2", "X0.0", "R10.0"), 6)
        self.assertEqual(self.end_of("D22:2", "X0.1", "R10.1"), 6)
        self.assertEqual(self.end_of("D42:2", "X0.2", "R10.2"), 6)

    def test_a_variable_is_read(self):
        provider = self.provider()
        self.ctl("set", "X0.0", "1")
        asked = self.event(provider)
        ticket = asked.pop("ticket")
        self.assertEqual(asked, VARIABLE)
        self.assertTrue(self.ask(provider, do="served", ticket=ticket, outcome="done", value=-2.5)["ok"])
        self.wait(lambda: self.get("R10.0"))
        self.assertEqual((self.get("D10:4"), self.get("D2:2")), (-25000, 0))
        self.ctl("set", "X0.0", "0")
        self.assertIn(f"no request with ticket {ticket} waits",
                      self.ask(provider, do="served", ticket=ticket, outcome="done", value=1)["error"])

    def test_every_outcome_has_its_end_code(self):
        provider = self.provider()
        for outcome, read, write in (("no-quantity", 6, 6), ("no-number", 3, 3), ("no-axis", 4, 4), ("bad-value", 5, 5),
                                     ("not-now", 6, 7), ("done", 2, 0)):  # 2: the value is too long
            for condition, output, name, code in (("X0.0", "R10.0", "D2:2", read), ("X0.1", "R10.1", "D22:2", write)):
                self.ctl("set", "D30:4", "70000")
                self.ctl("set", condition, "1")
                asked = self.event(provider)
                if condition == "X0.1":
                    self.assertEqual({**asked, "ticket": 0}, {**TOOL, "ticket": 0})
                self.ask(provider, do="served", ticket=asked["ticket"], outcome=outcome, value=1e9)
                self.wait(lambda: self.get(output))
                self.assertEqual(self.get(name), code, (outcome, condition))
                self.ctl("set", condition, "0")
                self.wait(lambda: not self.get(output))

    def test_a_position_is_there_at_once(self):
        provider = self.provider()
        self.assertEqual(self.end_of("D42:2", "X0.2", "R10.2"), 6)  # nothing is known yet
        self.assertTrue(self.ask(provider, do="live", machine=[1, -2.5], line=3)["ok"])
        self.assertEqual(self.end_of("D42:2", "X0.2", "R10.2"), 0)
        self.assertEqual(self.get("D50:4"), -2500)
        self.ask(provider, do="live", machine=[1], line=3)
        self.assertEqual(self.end_of("D42:2", "X0.2", "R10.2"), 4)

    def test_what_a_provider_leaves_is_refused(self):
        provider = self.provider()
        self.ctl("set", "X0.0", "1")
        self.event(provider)
        provider[0].shutdown(2)
        provider[1].close()
        self.wait(lambda: self.get("R10.0"))
        self.assertEqual(self.get("D2:2"), 6)
        self.provider()  # another one may serve

    def test_what_is_not_answered_is_refused(self):
        provider = self.provider()
        watching = self.connect()
        watching[1].readline()
        self.assertTrue(self.ask(watching, do="watch", names=["X0.0", "R10.0"], all=False)["ok"])
        self.ctl("set", "X0.0", "1")
        asked = self.event(provider)
        began, ended = self.us_of(watching, [True, False]), self.us_of(watching, [True, True])
        self.assertTrue(4e6 < ended - began < 8e6, ended - began)
        self.assertEqual(self.get("D2:2"), 6)
        self.assertIn("or was too late", self.ask(provider, do="served", ticket=asked["ticket"], outcome="done", value=1)["error"])

    def us_of(self, watching, values):
        """When the program had these values, in its time."""
        while (event := self.event(watching))["values"] != values:
            pass
        return event["us"]

    def test_one_serves_at_a_time(self):
        provider = self.provider()
        other = self.connect()
        other[1].readline()
        self.assertIn("another client already serves this program", self.ask(other, do="serve")["error"])
        for request in ({"do": "live", "machine": [], "line": 0}, {"do": "served", "ticket": 1, "outcome": "done"}):
            self.assertIn("this connection does not serve the program", self.ask(other, **request)["error"])
        self.assertTrue(self.ask(provider, do="serve")["ok"])

    def test_wrong_answers(self):
        provider = self.provider()
        self.ctl("set", "X0.0", "1")
        ticket = self.event(provider)["ticket"]
        for request, error in (({"do": "served"}, 'found no number "ticket" from 0 to 4294967295'),
                               ({"do": "served", "ticket": ticket}, 'found null for "outcome", expected one of done, no-quantity'),
                               ({"do": "served", "ticket": ticket, "outcome": "good"}, 'found "good" for "outcome"'),
                               ({"do": "served", "ticket": ticket, "outcome": "done"}, 'found null for "value", expected a number'),
                               ({"do": "served", "ticket": ticket, "outcome": "done", "value": "1"}, 'found "1" for "value"'),
                               ({"do": "live"}, 'found no list "machine" of at most 9 numbers'),
                               ({"do": "live", "machine": [0] * 10, "line": 0}, 'found no list "machine" of at most 9 numbers'),
                               ({"do": "live", "machine": [None], "line": 0}, 'found null for "machine", expected a number'),
                               ({"do": "live", "machine": [0], "line": -1}, 'found no number "line" from 0 to 99999999')):
            answer = self.ask(provider, **request)
            self.assertFalse(answer["ok"], request)
            self.assertIn(error, answer["error"])
        self.assertTrue(self.ask(provider, do="served", ticket=ticket, outcome="done", value=3)["ok"])
        self.wait(lambda: self.get("D10:4") == 30000)

    def test_mutated_answers_do_no_harm(self):
        chance = random.Random(4711)
        provider = self.provider()
        values = [None, 0, 1, -1, 2**70, 1e300, 1.5, "", "done", "no-axis", True, [], [1, 2], [[]], {}]
        good = 0
        self.ctl("set", "X0.0", "1")
        for ticket in range(300):
            request = chance.choice([{"do": "served", "ticket": ticket % 4, "outcome": "done", "value": 2},
                                     {"do": "live", "machine": [1, 2, 3], "line": 4}])
            if chance.randrange(4):
                request[chance.choice(list(request))] = chance.choice(values)
            answer = self.ask(provider, **request)
            self.assertEqual("error" in answer, not answer["ok"], request)
            good += answer["ok"]
        self.assertGreater(good, 20)
        self.assertIn("running: ", self.ctl("status"))

    def test_rungctl_serve(self):
        serving = subprocess.Popen([remote_test.BIN / "rungctl", "serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                                   env=self.environment)
        self.addCleanup(serving.stdout.close)
        self.assertEqual(json.loads(serving.stdout.readline()), {"again": False, "ok": True})
        self.ctl("set", "X0.0", "1")
        asked = json.loads(serving.stdout.readline())
        serving.stdin.write(json.dumps({"do": "served", "ticket": asked["ticket"], "outcome": "done", "value": 4}) + "\n")
        serving.stdin.flush()
        self.assertEqual(json.loads(serving.stdout.readline()), {"ok": True})
        self.wait(lambda: self.get("D10:4") == 40000)
        serving.stdin.close()
        self.assertEqual(serving.wait(patience()), 0)
        self.ctl("set", "X0.0", "0")
        self.wait(lambda: not self.get("R10.0"))
        self.assertEqual(self.end_of("D2:2", "X0.0", "R10.0"), 6)


class NctServices(Provider):
    """Bits of 7000 begin requests, those of 7001 say that one was done, those of 7002 that it failed."""
    map = Provider.map + '[const]\n"AN_PLCA,#5" = true\n'  # the control has given the axis to the program
    program_text = AXES
    source_name = "axes.lad"

    def ends(self, bit):
        """Whether the request was done, once it has ended; it may begin anew."""
        self.wait(lambda: self.get(f"7001.{bit:02}") or self.get(f"7002.{bit:02}"))
        done = self.get(f"7001.{bit:02}")
        self.ctl("set", f"7000.{bit:02}", "false")
        for word in ("7001", "7002"):
            self.ctl("set", f"{word}.{bit:02}", "false")
        return done

    def test_without_a_provider_requests_are_refused_at_once(self):
        for bit in range(4):
            self.ctl("set", f"7000.{bit:02}", "true")
            self.assertFalse(self.ends(bit), bit)

    def test_an_axis_of_the_program_is_moved(self):
        provider = self.provider()
        for bit, motion in ((0, {"motion": "by", "value": 12.5, "speed": 600.0}), (1, {"motion": "home", "value": 0.0, "speed": 0.0})):
            self.ctl("set", f"7000.{bit:02}", "true")
            asked = self.event(provider)
            ticket = asked.pop("ticket")
            self.assertEqual(asked, {"event": "service", "quantity": "axis-move", "channel": 0, "number": 0, "axis": 5, **motion})
            self.ask(provider, do="served", ticket=ticket, outcome="done")
            self.assertTrue(self.ends(bit))  # the NC takes it without an answer, so that of the provider changes nothing

    def test_what_no_cnc_moves_is_refused(self):
        provider = self.provider()
        self.ctl("set", "7000.02", "true")  # feed per revolution
        self.assertFalse(self.ends(2))
        self.ask(provider, do="live", machine=[], line=0)

    def test_a_position_is_there_at_once(self):
        provider = self.provider()
        self.ctl("set", "7000.03", "true")
        self.assertFalse(self.ends(3))  # nothing is known yet
        self.ask(provider, do="live", machine=[1, -2.5], line=0)
        self.ctl("set", "7000.03", "true")
        self.assertTrue(self.ends(3))
        self.wait(lambda: self.get("7003.00"))


class GskAxes(Provider):
    """PLC axis control: the control takes blocks by EBUF and EBSY, and asks for one motion after the other."""
    map = Provider.map.replace('"serve"', '"serve", "reset"') + '[axis-groups]\n4 = "A"\n[const]\n"X0.0" = true\nZRF4 = true\n'
    program_text = GROUP

    def provider(self):
        """Who comes gets the order to leave the axes at rest: nobody has said what they do."""
        provider = super().provider()
        self.over(provider, self.asked(provider, motion="stop", value=0.0, speed=0.0))
        self.wait(lambda: self.get("EADEN4"))
        return provider

    def order(self, code, data_1, data_2):
        for name, value in {"D1": code, "D2:2": data_1, "D4:4": data_2, "X0.1": True}.items():
            self.ctl("set", name, str(value).lower())
        self.wait(lambda: self.get("R11.0"))
        self.ctl("set", "X0.1", "false")
        self.wait(lambda: not self.get("R11.0"))

    def clear(self):
        self.ctl("set", "X0.2", "true")
        self.wait(lambda: not self.get("*EAXSL") and not self.get("EIALA"))
        self.ctl("set", "X0.2", "false")
        self.wait(lambda: not self.get("ECLRA"))

    def asked(self, provider, **motion):
        event = self.event(provider)
        ticket = event.pop("ticket")
        self.assertEqual(event, {"event": "service", "quantity": "axis-move", "channel": 0, "number": 0, "axis": 3, "until": "over", **motion})
        return ticket

    def over(self, provider, ticket, outcome="done"):
        self.assertTrue(self.ask(provider, do="served", ticket=ticket, outcome=outcome)["ok"])

    def test_without_a_provider_it_is_an_alarm_of_the_group(self):
        self.order(0, 6000, 10000)
        self.wait(lambda: self.get("EIALA"))
        self.clear()
        self.assertFalse(self.get("EADEN4"))  # nobody says that the axis is at rest

    def test_blocks_wait_for_each_other(self):
        provider = self.provider()
        self.order(1, 600, -125000)
        first = self.asked(provider, motion="by", value=-12.5, speed=600.0)
        self.order(0, 100, 100)
        self.order(0, 200, 100)
        self.wait(lambda: self.get("EABUFA"))
        self.over(provider, first)
        second = self.asked(provider, motion="by", value=0.01, speed=100.0)
        self.wait(lambda: not self.get("EABUFA"))
        self.over(provider, second)
        self.over(provider, self.asked(provider, motion="by", value=0.01, speed=200.0))
        self.wait(lambda: self.get("EINPA") and not self.get("*EAXSL"))

    def test_commands(self):
        provider = self.provider()
        for block, motion in (((0, 6000, 10000), {"motion": "by", "value": 1.0, "speed": 6000.0}), ((32, 300, -5000), {"motion": "at", "value": -0.5, "speed": 300.0}),
                           ((5, 0, 0), {"motion": "home", "value": 0.0, "speed": 0.0}), ((7, 900, 3), {"motion": "home", "value": 0.0, "speed": 900.0})):
            self.order(*block)
            ticket = self.asked(provider, **motion)
            self.assertTrue(self.get("EGENA"), block)
            self.over(provider, ticket)
            self.wait(lambda: self.get("EINPA") and not self.get("*EAXSL"))
        for block, motion in (((6, 200, 1), {"value": -1.0, "speed": 200.0}), ((16, 65534, 0), {"value": -1.0, "speed": 720.0})):
            self.order(*block)
            self.asked(provider, motion="jog", **motion)
            self.ctl("set", "X0.2", "true")
            ticket = self.asked(provider, motion="stop", value=0.0, speed=0.0)
            self.assertTrue(self.get("*EAXSL"))
            self.over(provider, ticket)
            self.clear()

    def test_what_no_cnc_does_is_an_alarm_until_eclr(self):
        provider = self.provider()
        for code in (2, 3, 8, 9, 10):
            self.order(code, 100, 100)
            self.wait(lambda: self.get("EIALA"))
            self.clear()
        self.order(1, 100, 100)
        self.over(provider, self.asked(provider, motion="by", value=0.01, speed=100.0), outcome="no-axis")
        self.wait(lambda: self.get("EIALA"))

    def test_who_was_silent_begins_anew(self):
        provider = self.provider()
        self.order(6, 200, 1)
        jog = self.asked(provider, motion="jog", value=-1.0, speed=200.0)
        self.assertTrue(self.ask(provider, do="serve", alive_ms=200)["ok"])
        self.assertEqual(self.event(provider), {"event": "unserved"})
        self.wait(lambda: self.get("EIALA") and not self.get("EINPA"))
        for request in ({"do": "live"}, {"do": "served", "ticket": jog, "outcome": "done"}):
            self.assertIn("does not serve the program", self.ask(provider, **request)["error"])
        self.assertTrue(self.ask(provider, do="serve")["ok"])
        self.over(provider, self.asked(provider, motion="stop", value=0.0, speed=0.0))
        self.clear()
        self.wait(lambda: self.get("EINPA"))

    def test_a_block_behind_a_dwell_is_lost_too(self):
        provider = self.provider()
        self.order(4, 0, 60000)
        self.order(1, 100, 100)
        self.assertFalse(self.get("EIALA"))
        provider[0].shutdown(socket.SHUT_RDWR)
        self.wait(lambda: self.get("EIALA"))
        self.assertIn("the program is no longer served: the connection has ended", self.ctl("messages"))
        provider = self.provider()
        self.assertIn("the program is served again", self.ctl("messages"))
        self.assertTrue(self.get("EIALA"))
        self.clear()

    def test_who_serves_learns_of_a_restart(self):
        provider = self.provider()
        self.order(6, 200, 1)
        self.asked(provider, motion="jog", value=-1.0, speed=200.0)
        self.ctl("set", "X0.7", "true")
        self.wait(lambda: "stopped by a fault: dead-loop" in self.ctl("status"))
        self.ctl("set", "X0.7", "false")
        self.ctl("reset")
        self.assertEqual(self.event(provider), {"event": "unserved"})
        self.assertEqual(self.ask(provider, do="serve"), {"again": False, "ok": True})
        self.over(provider, self.asked(provider, motion="stop", value=0.0, speed=0.0))

    def test_motions_take_their_time(self):
        provider = self.provider()
        self.order(1, 100, 100)
        ticket = self.asked(provider, motion="by", value=0.01, speed=100.0)
        self.pass_by(5500 // 8)  # longer than other requests wait
        self.over(provider, ticket)
        self.wait(lambda: self.get("EINPA") and not self.get("EIALA"))


class ServiceRights(Host):
    def test_the_mapping_file_must_allow_it(self):
        self.assertIn('"serve" is not allowed here; for it the mapping file needs', self.ctl("serve", status=WRONG))


if __name__ == "__main__":
    remote_test.BIN = remote_test.Path(sys.argv[1]).resolve()
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
