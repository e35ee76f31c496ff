"""Compiled PLC programs in Python: librung-runtime by its C functions, without a build.

    import rung
    with rung.Image("mill.so") as image, rung.Instance(image) as plc:
        plc.power_on(rung.WARM)
        while plc.run_due(1_000_000):  # nanoseconds since the call before
            plc["DOOR"] = door_is_closed()
            lamp(plc["LAMP"])
        print(plc.fault().text)

rung/runtime.h describes each call. If the call returns an error, the method raises Error; so does a number or text that
is out of range or of another type, and the use of a closed object. Names of fields end in their unit: _us are
microseconds of the program's clock, _ns nanoseconds of the computer's.

Any thread may use an Image; an Instance, its cells and replacements are used by one thread at a time. One further
thread may take messages, take and answer requests, and make a Replacement at the same time; any thread may read a
Watch. A callback may only read its Instance, by names that were read before. Python is not real time: times that are
bounded in C are not bounded here.

The library is the file that the environment variable RUNG_RUNTIME names, else librung-runtime.so.0 beside this module,
in ../.., ../lib or ../../lib, else the dynamic linker finds it. Without a library of a suitable version the import
raises ImportError.
"""
import ctypes
import enum
import itertools
import operator
import os
import threading
import weakref
from collections import namedtuple
from collections.abc import Iterable
from ctypes import POINTER, byref, c_double, c_int32, c_int64, c_size_t, c_uint32, c_uint64, c_void_p
from keyword import iskeyword

import _rung_abi as _abi

__all__ = ["Access", "Answer", "Cell", "CellInfo", "Change", "ChangeKind", "Difference", "Direction", "Error", "Fault",
           "Force", "Forces", "FunctionKind", "Image", "Instance", "LogLevel", "Message", "MessageOp", "Power",
           "Profile", "Program", "Recording", "Replacement", "Report", "Request", "RungChange", "RungChangeKind", "Sample", "Shadow",
           "ShadowReport", "ShadowState", "State", "StateFlags", "Status", "Symbol", "SymbolFlags", "Trace", "Type",
           "Watch", "version", "COLD", "WARM", "READ", "WRITE", "REAL", "TO_PROGRAM", "FROM_PROGRAM", "BOUND_REAL", "M",
           "S", "T", "B", "H", "KEY", "QUEUE"]

_NONE = _abi.RUNG_NONE
_MOST_ARGS = _abi.RUNG_MAX_SERVICE_ARGS


# ---- enums of C ------------------------------------------------------------------------------------------------------

def _enum(name, of, prefix, doc, kind=enum.IntEnum):
    """An enum of C, with the names without their prefix."""
    members = {member.removeprefix(prefix): value for member, value in _abi.ENUMS[of].items()}
    made = kind(name, members, module=__name__)
    made.__doc__ = doc
    return made


Status = _enum("Status", "rung_status", "RUNG_", "What a call gave: of Error.status those below 0.")
Power = _enum("Power", "rung_power", "RUNG_",
              "COLD: memory as a new machine has it; WARM: retained memory keeps its contents.")
Access = _enum("Access", "rung_access", "RUNG_", "What a cell is found for. WRITE includes reading, of the place that is "
               "written; REAL is added to one of them for the real of 64 bits that begins there.")
Direction = _enum("Direction", "rung_direction", "RUNG_", "When a bound variable is copied: before or after every slice. "
                  "BOUND_REAL is added for the real that REAL would find.")
FunctionKind = _enum("FunctionKind", "rung_function_kind", "RUNG_FUNCTION_", "Functions of a part program; KEY: one of the "
                     "panel or the screen, which is pressed and released.")
LogLevel = _enum("LogLevel", "rung_log_level", "RUNG_LOG_", "The first argument of a `log` callback.")
StateFlags = _enum("StateFlags", "rung_state_flags", "RUNG_STATE_", "Of State.flags; AT_START: between two scans, UNSAVED: "
                   "the last try to write retained memory has failed.", enum.IntFlag)
Type = _enum("Type", "rung_type", "RUNG_TYPE_", "Of cells and symbols.")
SymbolFlags = _enum("SymbolFlags", "rung_symbol_flags", "RUNG_SYMBOL_", "Of Symbol.flags.", enum.IntFlag)
MessageOp = _enum("MessageOp", "rung_message_op", "RUNG_MESSAGE_", "What the program does with a message.")
ChangeKind = _enum("ChangeKind", "rung_change_kind", "RUNG_CHANGE_",
                   "What becomes of a cell or a state when another program takes over.")
RungChangeKind = _enum("RungChangeKind", "rung_rung_change_kind", "RUNG_RUNG_",
                       "What becomes of a rung when another program takes over.")
ShadowState = _enum("ShadowState", "rung_shadow_state", "RUNG_SHADOW_", "Of a Shadow.")
_Answering = _enum("_Answering", "rung_answer", "RUNG_", "Of a `request` callback.")
_MessageFlags = _enum("_MessageFlags", "rung_message_flags", "RUNG_MESSAGE_", "Of Instance.define_message.", enum.IntFlag)
_InstanceFlags = _enum("_InstanceFlags", "rung_instance_flags", "RUNG_", "Of an Instance.", enum.IntFlag)

COLD, WARM = Power
READ, WRITE, REAL = Access
TO_PROGRAM, FROM_PROGRAM, BOUND_REAL = Direction
M, S, T, B, H, KEY = FunctionKind
QUEUE = _Answering.QUEUE

_BITS = {Type.BIT: 1, Type.I8: 8, Type.I16: 16, Type.I32: 32}  # of types below 64 bits

# An unsigned type of 64 bits has the bits of the signed one.
_HOST_TYPES = {kind: _abi.ENUMS["rung_host_type"][f"RUNG_HOST_{name}"] for kind, name in {
    ctypes.c_bool: "BOOL", ctypes.c_int8: "I8", ctypes.c_uint8: "U8", ctypes.c_int16: "I16", ctypes.c_uint16: "U16",
    c_int32: "I32", c_uint32: "U32", c_int64: "I64", c_uint64: "I64", ctypes.c_float: "F32", c_double: "F64"}.items()}


def _member(kind, value):
    """The member of an enum; the plain number if a later library has added it."""
    try:
        return kind(value)
    except ValueError:
        return value


# ---- errors ----------------------------------------------------------------------------------------------------------

class Error(Exception):
    """A failed call, which has had no effect: `status` is a Status below 0, or LATER from Forces; the text is a
    sentence."""

    def __init__(self, status, text):
        super().__init__(status, text)
        self.status = _member(Status, status)

    def __str__(self):
        return self.args[1]


# ---- what Python gets of them ----------------------------------------------------------------------------------------

def _decoded(text):
    # The last character of a text that was cut off may be incomplete, and names have the encoding of the source.
    return text.decode(errors="replace")


def _plain(value):
    return _decoded(value) if isinstance(value, bytes) else value


def _space(number):
    return None if number == _NONE else number


def _record(name, struct, doc, **means):
    """A named tuple for the fields of a struct that are used in Python, and the struct's method that makes it. `means`
    has functions that convert values which are not plain numbers or texts."""
    fields = [field for field, _ in struct._fields_ if field not in ("size", "reserved", "real")]
    record = namedtuple(name, [f"{field}_" if iskeyword(field) else field for field in fields], module=__name__)
    record.__doc__ = f"{doc} The fields are those of {struct.__name__} in rung/runtime.h."
    struct.shown = lambda self: record._make(means.get(field, _plain)(getattr(self, field)) for field in fields)
    return record


def _member_of(kind):
    return lambda value: _member(kind, value)


State = _record("State", _abi.rung_state, "Of Instance.state.", flags=StateFlags)
Program = _record("Program", _abi.rung_program_info, "Of Instance.program: who runs. faulted 0: no fault has put it back.")
Fault = _record("Fault", _abi.rung_fault_info, "Of Instance.fault. rung 0: none, line 0: unknown.")
CellInfo = _record("CellInfo", _abi.rung_cell_info, "Of Cell.info. space None: a constant.",
                   type=_member_of(Type), access=_member_of(Access), space=_space)
Symbol = _record("Symbol", _abi.rung_symbol_info, "Of Image.symbols. space None: a constant, with its value.",
                 type=_member_of(Type), flags=SymbolFlags, space=_space)
Message = _record("Message", _abi.rung_message_info, "Of Instance.messages and .shown. value: a float or an int.",
                  op=_member_of(MessageOp))
Profile = _record("Profile", _abi.rung_profile, "Of Instance.profile: a rung, how often and how long it ran. rung 0: the "
                  "compiler's.")
Timer = _record("Timer", _abi.rung_timer_info, "Of Instance.timers, in microseconds, or runs of the instruction. rung 0: none; "
                "negative: not known.", running=bool, runs=bool)
Recording = _record("Recording", _abi.rung_recording_info, "Of Instance.recording. file empty: none is written now.")
Sample = _record("Sample", _abi.rung_sample, "Of a Watch: when its values were so.")
Report = _record("Report", _abi.rung_replacement_info, "Of Replacement.report.")
ShadowReport = _record("ShadowReport", _abi.rung_shadow_info, "Of Shadow.report.", state=_member_of(ShadowState))
Difference = _record("Difference", _abi.rung_difference, "Of Shadow.differences. type None: a service that the new program "
                     "alone requests. running, next: a float or an int.", type=lambda t: _member(Type, t) if t else None)
Force = _record("Force", _abi.rung_force_info, "Of Instance.forced: a cell that is held at a value. value: a float or an int.",
                type=_member_of(Type))
Change = _record("Change", _abi.rung_change, "Of Replacement.changes.", kind=_member_of(ChangeKind), is_state=bool)
RungChange = _record("RungChange", _abi.rung_rung_change, "Of Replacement.rungs.", kind=_member_of(RungChangeKind))

Request = namedtuple("Request", "ticket service args", module=__name__)
Request.__doc__ = "A service that the program asks for: its number, name, and arguments as integers."

Answer = namedtuple("Answer", "results error", defaults=((), False), module=__name__)
Answer.__doc__ = "What a `request` callback answers at once: at most 16 integers, and whether the service has failed."


def _message(info):
    return info.shown()._replace(value=info.value.real if info.real else info.value.integer)


def _request(asked):
    return Request(asked.ticket, _decoded(asked.service), tuple(asked.args[:asked.arg_count]))


# ---- arguments -------------------------------------------------------------------------------------------------------

def _integer(value, low, high):
    """An integer in a range, because ctypes drops the upper bits of a value that does not fit."""
    try:
        number = operator.index(value)
    except TypeError:
        raise Error(Status.WRONG_TYPE, f"{value!r} is not an integer") from None
    if not low <= number <= high:
        raise Error(Status.BAD_ARGUMENT, f"{number} is not in the range of {low} to {high}")
    return number


def _real(value):
    try:
        return c_double(value).value
    except (TypeError, OverflowError):
        raise Error(Status.WRONG_TYPE, f"{value!r} is not a real number") from None


def _text(value):
    """The bytes of a text, which must not contain a 0, because C would end it there."""
    try:
        text = value.encode()
    except (AttributeError, UnicodeEncodeError):
        raise Error(Status.WRONG_TYPE, f"{value!r} is not a text") from None
    if 0 in text:
        raise Error(Status.BAD_ARGUMENT, f"{value!r} has a character 0")
    return text


def _path(value):
    try:
        path = os.fsencode(value)
    except (TypeError, UnicodeEncodeError):
        raise Error(Status.WRONG_TYPE, f"{value!r} is not a path") from None
    if 0 in path:
        raise Error(Status.BAD_ARGUMENT, f"{value!r} has a character 0")
    return path


class _Handle(c_void_p):
    """The C handle of an object of this module; null: it is closed. `end` is the name of the function that frees it."""

    def __init__(self, end=None):
        super().__init__()
        self._end = end

    @classmethod
    def from_param(cls, value):
        """For any other object the handle is null, which the library refuses."""
        handle = getattr(value, "_handle", value)
        return handle if isinstance(handle, cls) else cls()

    def free(self):
        _call(getattr(_library, self._end), self)
        self.value = None


def _argument(convert):
    """An argument type that ctypes converts by a function of this module."""
    return type(convert.__name__, (), {"from_param": staticmethod(convert)})


def _number(kind):
    bits = 8 * ctypes.sizeof(kind)
    low, high = (-1 << bits - 1, (1 << bits - 1) - 1) if kind(-1).value < 0 else (0, (1 << bits) - 1)
    return _argument(lambda value: kind(_integer(value, low, high)))


# ---- functions of C --------------------------------------------------------------------------------------------------

# The meaning of the words in the parameters.
_KINDS = {"handle": _Handle, "new": POINTER(c_void_p), "text": _argument(_text), "path": _argument(_path),
          "int32_t": _number(c_int32), "uint32_t": _number(c_uint32), "int64_t": _number(c_int64),
          "uint64_t": _number(c_uint64), "size_t": c_size_t}


def _find():
    given = os.environ.get("RUNG_RUNTIME")
    if given:
        return os.path.abspath(given)
    name = "librung-runtime.so.0"
    here = os.path.dirname(os.path.abspath(__file__))
    near = (os.path.join(here, *folders, name) for folders in ((), ("..", ".."), ("..", "lib"), ("..", "..", "lib")))
    return next(filter(os.path.exists, near), name)


def _declared(library, name):
    function = getattr(library, name)
    function.restype, *parameters = _abi.FUNCTIONS[name]
    function.argtypes = [_KINDS.get(kind, kind) for kind in parameters]
    return function


def _load():
    """The library with its functions declared, in a version suitable for this module."""
    path = _find()
    try:
        library = ctypes.CDLL(path)
        version_there = _declared(library, "rung_runtime_version")()
        major, minor = version_there >> 16, version_there & 0xFFFF
        if major != _abi.RUNG_RUNTIME_MAJOR or minor < _abi.RUNG_RUNTIME_MINOR:
            raise ImportError(f"{path} is version {major}.{minor} of librung-runtime, but this module needs version "
                              f"{_abi.RUNG_RUNTIME_MAJOR}.{_abi.RUNG_RUNTIME_MINOR}, or a later one of "
                              f"{_abi.RUNG_RUNTIME_MAJOR}")
        for name in _abi.FUNCTIONS:
            _declared(library, name)
    except (OSError, AttributeError) as wrong:
        raise ImportError(f"librung-runtime cannot be loaded: {wrong}; the environment variable RUNG_RUNTIME may name "
                          "its file") from None
    return library


_library = _load()


def _call(function, *arguments):
    """The status of a call; an error is raised."""
    try:
        status = function(*arguments)
    except ctypes.ArgumentError as wrong:  # "argument 2: <class 'rung.Error'>: 'x' is not an integer"
        raise Error(Status.BAD_ARGUMENT, f"{function.__name__}: {str(wrong).split(': ', 2)[-1]}") from None
    if status < 0:
        raise Error(status, _decoded(_library.rung_error_text()))
    return status


def _each(owner, function, struct):
    """The entries of a list in C, which ends with EMPTY."""
    for index in itertools.count():
        entry = struct()
        if _call(function, owner, index, byref(entry)) == Status.EMPTY:
            return
        yield entry


def _free_instance(handle, parts):
    while parts:
        parts.pop().free()
    handle.free()


def version():
    """(major, minor) of the library."""
    there = _library.rung_runtime_version()
    return there >> 16, there & 0xFFFF


# ---- callbacks -------------------------------------------------------------------------------------------------------

_CALLBACKS = dict(_abi.rung_instance_options._fields_)  # by member name


class _Raised(threading.local):
    """The first exception of a callback within the thread's present call, because exceptions cannot pass through C."""
    first = None


_raised = _Raised()


def _callback(kind, body, otherwise=None):
    """A C function for a callback; it returns `otherwise` after an exception."""
    def called(*arguments):
        try:
            return body(*arguments)
        except BaseException as raised:
            if _raised.first is None:
                _raised.first = raised
            return otherwise
    return kind(called)


def _run(function, *arguments):
    """_call for functions that run callbacks; raises their first exception."""
    outer, _raised.first = _raised.first, None  # a callback may run another instance
    try:
        return _call(function, *arguments)
    finally:
        first, _raised.first = _raised.first, outer
        if first is not None:
            raise first


def _fill(reply, results, error):
    results = list(results)
    if len(results) > _MOST_ARGS:
        raise Error(Status.BAD_ARGUMENT, f"a reply has at most {_MOST_ARGS} results, not {len(results)}")
    for index, result in enumerate(results):
        reply.results[index] = _integer(result, -1 << 63, (1 << 63) - 1)
    reply.result_count = len(results)
    reply.error = bool(error)


def _answered(answer, reply):
    """The result of a `request` callback as enum rung_answer."""
    if answer is None:
        return _Answering.REFUSE
    if answer is QUEUE:
        return QUEUE
    if not isinstance(answer, Answer):
        raise Error(Status.WRONG_TYPE, f"a request callback gives an Answer, QUEUE or None, not {answer!r}")
    _fill(reply, *answer)
    return _Answering.ANSWER


# ---- images ----------------------------------------------------------------------------------------------------------

class _Closing:
    """An object that is closed at the end of its `with`."""

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class Image(_Closing):
    """A compiled program.

    `name` and `dialect` are those of the program. Instances and replacements may outlive the image. It is closed by
    close, at the end of its `with`, or when it is no longer referenced.
    """

    def __init__(self, path, *, allow_unsealed=False, keys_folder=None):
        """Loads a program made by `rungc build`. `allow_unsealed` accepts a program without a seal; `keys_folder` has
        the public keys for signed programs, by default the system's. Error: REFUSED, OUT_OF_MEMORY."""
        self._handle = _Handle("rung_image_close")
        keys = None if keys_folder is None else _path(keys_folder)
        options = _abi.rung_image_options(allow_unsealed=bool(allow_unsealed), keys_folder=keys)
        _call(_library.rung_image_open, path, byref(options), byref(self._handle))
        weakref.finalize(self, self._handle.free)
        program = _library.rung_image_program(self).contents
        self.name, self.dialect = _decoded(program.name), _decoded(program.dialect)

    def close(self):
        """Closes the image. Closing again does nothing."""
        self._handle.free()

    def symbols(self):
        """The author's names, constants included, as Symbols sorted by bytes."""
        return (symbol.shown() for symbol in _each(self, _library.rung_image_symbol, _abi.rung_symbol_info))


# ---- cells -----------------------------------------------------------------------------------------------------------

class Cell:
    """A cell of an instance that was found by its name, from Instance.cell. When another program takes over, it is the
    cell of that name there; Error NOT_FOUND, WRONG_TYPE or OVERWRITTEN if that has no suitable cell."""

    def __init__(self, handle, name, access):
        # No reference to the instance, so that it can end although its cells are still referenced.
        self._handle, self.name = handle, name
        number = c_uint32()
        _call(_library.rung_instance_find, handle, name, access, byref(number))
        self._number = number.value
        self._type = self._look().type  # the width may change with the program; a text or a real stays one

    @property
    def info(self):
        """The CellInfo of the cell in the running program."""
        return self._look().shown()

    def _look(self):
        info = _abi.rung_cell_info()
        _call(_library.rung_instance_cell, self._handle, self._number, byref(info))
        return info

    def read(self, first=0, count=1):
        """The element with index `first`, from 0; a list, if `count` is not 1. A real is a float, everything else a
        sign-extended int. A text is a str, read as a whole. Error: BAD_ARGUMENT, there are not that many elements."""
        if self._type == Type.TEXT:
            return self._read_text(first, count)
        # The library refuses more elements than the cell has, so the room is limited to these.
        room = _integer(count, 0, _NONE)
        values = (_abi.rung_value * (room if room < 2 else min(room, self._look().count)))()
        _call(_library.rung_instance_read, self._handle, self._number, first, count, values)
        shown = [self._shown(value) for value in values]
        return shown[0] if count == 1 else shown

    def write(self, value, first=0):
        """Writes the element with index `first`, from 0, or several from there on, if `value` is a list or another
        iterable. An integer must fit in the cell's width, signed or unsigned. A text is a str, cut off to the length of
        the cell. Error: BAD_ARGUMENT, there are not that many elements, or an integer needs more bits than the cell
        has; WRONG_TYPE, another kind of value, or a cell that was found for reading."""
        if self._type == Type.TEXT:
            self._write_text(value, first)
            return
        several = isinstance(value, Iterable) and not isinstance(value, (str, bytes))
        bits = self._bits()
        values = [self._given(element, bits) for element in (value if several else [value])]
        _call(_library.rung_instance_write, self._handle, self._number, first, len(values), _values(values))

    def _shown(self, value):
        return value.real if self._type == Type.F64 else value.integer

    def _bits(self):
        """The bits of an element in the running program."""
        return _BITS.get(self._look().type, 64)

    def _given(self, value, bits=None):
        bits = self._bits() if bits is None else bits
        try:
            if self._type == Type.F64:
                return _abi.rung_value(real=_real(value))
            return _abi.rung_value(integer=_integer(value, -(1 << bits - 1) if bits > 1 else 0, (1 << bits) - 1))
        except Error as wrong:
            raise Error(wrong.status, f"{self.name}: {wrong}") from None

    def _read_text(self, first, count):
        if (first, count) != (0, 1):
            raise Error(Status.BAD_ARGUMENT, f"{self.name} is a text, which is read as a whole")
        room = ctypes.create_string_buffer(4 * self._look().count + 1)  # a byte of memory takes at most four in UTF-8
        _call(_library.rung_instance_read_text, self._handle, self._number, room, len(room))
        return _decoded(room.value)

    def _write_text(self, value, first):
        if first != 0:
            raise Error(Status.BAD_ARGUMENT, f"{self.name} is a text, which is written as a whole")
        try:
            _text(value)
        except Error as wrong:
            raise Error(wrong.status, f"{self.name}: {wrong}") from None
        _call(_library.rung_instance_write_text, self._handle, self._number, value)


# ---- instances -------------------------------------------------------------------------------------------------------

class Instance(_Closing):
    """A running copy of a program with its memory, clock, queues, and the control of its dialect.

    It ends by close, at the end of its `with`, or when it is no longer referenced; only power_off switches it off.

    Methods that run the program return True, or False if a fault has stopped it, now or before (see fault). After an
    exception in a callback the call that led to it runs to its end and then raises the first such exception.
    """

    def __init__(self, image, *, request=None, fault=None, log=None, measure=False, queue_requests=False,
                 save_at_once=False, catch_up=0, most_overruns=0):
        """Makes an instance, which is not switched on yet.

        request(plc, request): the program makes a Request for a service, within a scan. Returns an Answer; QUEUE: the
            request is queued for next_request; None: the control answers at once, as without a CNC and after an
            exception.
        fault(plc): a fault has stopped the program, within a scan.
        log(level, text): a message for the operator, with its LogLevel.
        measure: the times of scans are measured, for State.last_ns and .worst_ns.
        queue_requests: without `request`, all requests are queued for next_request.
        save_at_once: memory that the program requests to be saved is on disk when a call returns; for a program that
            runs faster than its clock.
        catch_up, most_overruns: the maximum number of scans that a run_due runs after a delay, and the number of
            successive late scans at which the fault `overrun` stops the program; 0: one, and 500.

        Error: OUT_OF_MEMORY.
        """
        me = weakref.ref(self)  # the callbacks do not keep it alive
        options = _abi.rung_instance_options(flags=bool(measure) * _InstanceFlags.MEASURE
                                        | bool(queue_requests) * _InstanceFlags.QUEUE_REQUESTS
                                        | bool(save_at_once) * _InstanceFlags.SAVE_AT_ONCE,
                                        catch_up=_integer(catch_up, 0, _NONE),
                                        most_overruns=_integer(most_overruns, 0, _NONE))
        if log is not None:
            options.log = _callback(_CALLBACKS["log"], lambda _, level, text: log(_member(LogLevel, level), _decoded(text)))
        if request is not None:
            options.request = _callback(_CALLBACKS["request"], lambda _, __, asked, reply: _answered(
                request(me(), _request(asked.contents)), reply.contents), _Answering.REFUSE)
        if fault is not None:
            options.fault = _callback(_CALLBACKS["fault"], lambda *_: fault(me()))
        self._handle = _Handle("rung_instance_free")
        self._cells = {}
        self._parts = []  # handles of objects that end before it
        self._used = [options]  # objects whose addresses C has: callbacks and bound variables
        _call(_library.rung_instance_new, image, byref(options), byref(self._handle))
        # Without `_used`: the object of a callback may reference the instance, which then would never end.
        weakref.finalize(self, _free_instance, self._handle, self._parts)

    def close(self):
        """Ends the instance, after its watches and replacements, and tries to save retained memory that is not on disk
        yet. Closing again does nothing. Error: WRONG_THREAD, WRONG_STATE in a callback."""
        _free_instance(self._handle, self._parts)
        self._used.clear()

    # -- power --

    def power_on(self, power=WARM):
        """Switches the program on, COLD or WARM, or off and on again, also after a fault. False: a task that runs at
        power-on has faulted. Error: FAILED, retained memory cannot be read or saved, or another process uses it; the
        program is off then."""
        return self._ran(_library.rung_instance_power_on, power)

    def power_off(self):
        """A regular power-off: runs the last scans that the dialect needs, and saves the retained memory to disk.
        Error: FAILED, it could not be saved, but the program is off; WRONG_STATE, it was off."""
        _run(_library.rung_instance_power_off, self)

    def begin_power_off(self):
        """Begins a regular power-off of a real machine. True: the program needs further scans with fresh inputs; call
        again after each. False: it needs no more, and power_off switches it off. Error: WRONG_STATE, it was off."""
        return _call(_library.rung_instance_begin_power_off, self) == Status.LATER

    def stop(self):
        """The operator's stop: only the program's clock advances."""
        _call(_library.rung_instance_stop, self)

    def start(self):
        """Ends a stop."""
        _call(_library.rung_instance_start, self)

    # -- running --

    def _ran(self, function, *arguments):
        return _run(function, self, *arguments) != Status.FAULTED

    def run_due(self, ns):
        """Runs the slices that are due after the host's clock has advanced by `ns`, 0 to one hour. Of late
        scans up to `catch_up` run; the others are skipped (`missed`). Error: WRONG_STATE, the program is off, or its
        schedule has no period."""
        return self._ran(_library.rung_instance_run_due, ns)

    def run_due_fast(self, ns):
        """The same up to the end of the fast task of the slice that is due; the next `run_due`, with the time since
        this call, runs its rest, and late slices."""
        return self._ran(_library.rung_instance_run_due_fast, ns)

    def slice(self):
        """Runs one slice of the schedule, whatever the time. Error: WRONG_STATE, the program is off."""
        return self._ran(_library.rung_instance_slice)

    def scan(self, count=1):
        """Runs the rest of a scan, and `count` - 1 more, as long as no fault stops them. Error: WRONG_STATE, the
        program is off."""
        return all(self._ran(_library.rung_instance_scan) for _ in range(_integer(count, 1, _NONE)))

    def slot(self):
        """Runs the rest of a slot, for dialects that have slots. Error: WRONG_STATE, the program is off."""
        return self._ran(_library.rung_instance_slot)

    def fast(self):
        """Runs the fast task once. Error: WRONG_STATE, the program is off."""
        return self._ran(_library.rung_instance_fast)

    def limit(self, ns):
        """Sets the time limit of a slice, which is a fault if exceeded, in nanoseconds, up to one hour; 0: only the
        budgets of its tasks apply. Error: BAD_ARGUMENT."""
        _call(_library.rung_instance_limit, self, ns)

    def state(self):
        """The State: clocks, counters since the power-on, and flags, as in `StateFlags.ON in plc.state().flags`."""
        state = _abi.rung_state()
        _call(_library.rung_instance_state, self, byref(state))
        return state.shown()

    def program(self):
        """The running Program, and the program whose fault has put it back."""
        program = _abi.rung_program_info()
        _call(_library.rung_instance_program, self, byref(program))
        return program.shown()

    def fault(self):
        """The Fault that has stopped the program; None: there is none."""
        fault = _abi.rung_fault_info()
        status = _call(_library.rung_instance_fault, self, byref(fault))
        return None if status == Status.EMPTY else fault.shown()

    # -- names and values --

    def cell(self, name, access=READ):
        """The Cell of a name of the program, an address of its dialect or a signal of the NC's interface, for READ or
        WRITE; it is looked up once. Error: NOT_FOUND; for WRITE also OVERWRITTEN, with a sentence that says where to
        write, and WRONG_TYPE, a constant."""
        if (name, access) not in self._cells:
            self._cells[name, access] = Cell(self._handle, name, access)
        return self._cells[name, access]

    def describe(self, name, access=READ, replacement=None):
        """The CellInfo of a name, without making a cell: in the running program or, with a Replacement, in its new
        program. Errors as in cell."""
        info, constant = _abi.rung_cell_info(), ctypes.c_int64()
        _call(_library.rung_instance_describe, self, _Handle() if replacement is None else replacement, name, access,
              byref(info), byref(constant))
        return info.shown()

    def release(self, name, access=READ):
        """Releases the cell of a name and its Cell objects; a later use looks it up again."""
        cell = self._cells.pop((name, access), None)
        if cell is not None:
            _call(_library.rung_instance_release, self, cell._number)

    def __getitem__(self, name):
        """The value of a name, as Cell.read returns it; for an array a list. Errors as in cell."""
        cell = self.cell(name)
        return cell.read() if cell._type == Type.TEXT else cell.read(0, cell._look().count)

    def __setitem__(self, name, value):
        """Writes the value of a name, as Cell.write; for an array all its elements. Errors as in cell and
        Cell.write."""
        cell = self.cell(name, WRITE)
        count = cell._look().count
        if cell._type != Type.TEXT and count != 1:
            if not isinstance(value, Iterable) or len(value := list(value)) != count:
                raise Error(Status.BAD_ARGUMENT, f"{name} has {count} elements: its value is a list of so many")
        cell.write(value)

    def read_all(self, names):
        """The values of names in one call, all at the same moment: {name: value}; for an array its first element.
        Errors as in cell; WRONG_TYPE, a text."""
        names = list(names)
        cells = [self.cell(name) for name in names]
        values = (_abi.rung_value * len(cells))()
        _call(_library.rung_instance_read_all, self, _cell_numbers(cells), len(cells), values)
        return {name: cell._shown(value) for name, cell, value in zip(names, cells, values)}

    def write_all(self, values):
        """Writes {name: value} in one call, either all or none; for an array its first element. Errors as in cell and
        Cell.write; WRONG_TYPE, a text."""
        cells = [self.cell(name, WRITE) for name in values]
        given = [cell._given(value) for cell, value in zip(cells, values.values())]
        _call(_library.rung_instance_write_all, self, _cell_numbers(cells), len(cells), _values(given))

    def bind(self, name, variable, direction, scale=0):
        """Binds a variable of ctypes, c_bool to c_uint64, c_float or c_double, to a name: from now on it is copied
        TO_PROGRAM before every slice, or FROM_PROGRAM after every slice; then it is 0 after a fault and after the
        power-off. `scale`, for reals: units of the program per unit of the host; 0 means 1. Errors as in cell;
        WRONG_TYPE, a variable of another type, or a text of the program; BAD_ARGUMENT."""
        if type(variable) not in _HOST_TYPES:
            raise Error(Status.WRONG_TYPE, f"{name}: a bound variable is a bool, an integer, a float or a double of "
                                           f"ctypes, not {variable!r}")
        bound = _abi.rung_variable(_text(name), ctypes.addressof(variable), _HOST_TYPES[type(variable)],
                              _integer(direction, 0, _NONE), _real(scale))
        _call(_library.rung_instance_bind, self, byref(bound), 1)
        self._used.append(variable)

    def bind_block(self, name, block, direction):
        """Binds memory, any object of ctypes such as an array or a structure, to the bytes from a name on, in the
        layout of the dialect: TO_PROGRAM, each run of a task copies the bytes that it may read at its beginning;
        FROM_PROGRAM, it is copied after every slice, and is 0 after a fault and after the power-off. Errors as in cell;
        OVERWRITTEN, for any of its bytes; BAD_ARGUMENT, a block that does not begin at a byte or is too long."""
        bound = _abi.rung_block(_text(name), ctypes.addressof(block), ctypes.sizeof(block),
                           _integer(direction, 0, _NONE))
        _call(_library.rung_instance_bind_blocks, self, byref(bound), 1)
        self._used.append(block)

    # -- messages and services --

    def messages(self):
        """Takes the messages that the program has shown, cleared or logged, one Message after the other."""
        message = _abi.rung_message_info()
        while _call(_library.rung_instance_next_message, self, byref(message)) != Status.EMPTY:
            yield _message(message)

    def define_message(self, number, text, *, lasts=False, logged_only=False):
        """Defines a message as the machine's configuration does, before the first power_on, for dialects whose message
        texts are outside the program: %d, %x and %X in the text are placeholders for the message's values; the flags:
        it is shown until the program ends it, it is not shown at all. Errors: NOT_FOUND, the texts are in the program;
        WRONG_STATE."""
        flags = bool(lasts) * _MessageFlags.LASTS | bool(logged_only) * _MessageFlags.LOGGED_ONLY
        _call(_library.rung_instance_define_message, self, number, flags, text)

    def shown(self):
        """The messages that the operator sees now: a list of Message."""
        return [_message(message) for message in _each(self, _library.rung_instance_shown, _abi.rung_message_info)]

    def next_request(self):
        """Takes the next queued Request; None: there is none."""
        asked = _abi.rung_request()
        status = _call(_library.rung_instance_next_request, self, byref(asked))
        return None if status == Status.EMPTY else _request(asked)

    def answer(self, ticket, results=(), error=False):
        """Answers a request of next_request, by the same thread: at most 16 integers, and whether the service has
        failed. The program sees it before its next slice. False: there are more answers than requests that it can have
        made; try again after a slice. Error: BAD_ARGUMENT, WRONG_TYPE."""
        reply = _abi.rung_reply(ticket=_integer(ticket, 0, _NONE))
        _fill(reply, results, error)
        return _call(_library.rung_instance_answer, self, byref(reply)) != Status.LATER

    # -- functions of a part program --

    def begin_function(self, channel, kind, code):
        """Starts a function, M, S, T or B, of a channel (from 0). Returns its handle, for function_done; None: the
        signals that it needs are in use, try again after the next slice. Error: NOT_FOUND, the control has no such
        channel or no signals for it; WRONG_STATE, the program is off."""
        function = c_uint32()
        status = _call(_library.rung_instance_begin_function, self, channel, kind, code, byref(function))
        return None if status == Status.LATER else function.value

    def function_done(self, channel, function):
        """Whether the program has finished the function with this handle of begin_function. Error: NOT_FOUND, no such
        channel."""
        return _call(_library.rung_instance_function_done, self, channel, function) != Status.LATER

    def abort_functions(self, channel):
        """Reset, emergency stop: functions under way in the channel end at once. Error: NOT_FOUND, no such channel."""
        _call(_library.rung_instance_abort_functions, self, channel)

    def supports_function(self, channel, kind, code):
        """Whether the dialect has signals for this function in the channel."""
        try:
            _call(_library.rung_instance_supports_function, self, channel, kind, code)
        except Error as error:
            if error.status != Status.NOT_FOUND:
                raise
            return False
        return True

    def group_function(self, channel, code, group):
        """Assigns this M function to a group, from now on. Error: NOT_FOUND, the dialect has no such group, or the
        group of the function is fixed."""
        _call(_library.rung_instance_group_function, self, channel, code, group)

    def high_speed_functions(self, channel):
        """From now on the program finishes each kind of function by a separate signal. Error: NOT_FOUND, the dialect
        has no such handshake."""
        _call(_library.rung_instance_high_speed_functions, self, channel)

    def axis_group(self, axis, group):
        """From now on the program commands this axis by the signals of a group, both from 0, and the host moves it:
        each command is a request "AXLCTL axis command data-1 data-2". Error: NOT_FOUND, the dialect has no such axis or
        group."""
        _call(_library.rung_instance_axis_group, self, axis, group)

    # -- retained memory --

    def keep(self, path):
        """Stores retained memory in PATH.a and PATH.b, from the next power_on, which reports errors of the files.
        Error: WRONG_STATE, the program has been on, or it was called before."""
        _call(_library.rung_instance_keep, self, path)

    def flush(self):
        """Waits until the present retained memory is on disk. Error: FAILED, it is not; WRONG_STATE, it is not
        stored."""
        _call(_library.rung_instance_flush, self)

    # -- state --

    def save(self):
        """The state between two scans, as bytes: everything on which further scans depend except the host and its
        settings. None: a scan has not ended. Error: WRONG_STATE, the program is off."""
        size = ctypes.c_size_t()
        if _call(_library.rung_instance_save, self, None, 0, byref(size)) == Status.LATER:
            return None
        state = ctypes.create_string_buffer(size.value)
        _call(_library.rung_instance_save, self, state, size.value, byref(size))
        return state.raw

    def load(self, state):
        """Continues from a state of the same program, which must be on. Errors: REFUSED, of another program or damaged,
        and then it is off; WRONG_STATE, other cells are forced than when it was saved."""
        _call(_library.rung_instance_load, self, state, len(state))

    def set_clock(self, now_us):
        """Sets the program's clock, up to one hour ahead; timers see the difference as elapsed time. Error:
        BAD_ARGUMENT."""
        _call(_library.rung_instance_set_clock, self, now_us)

    def unsaved(self):
        """Why the last attempt to write retained memory failed; None: it did not fail."""
        text = ctypes.create_string_buffer(512)
        status = _call(_library.rung_instance_unsaved, self, text, len(text))
        return None if status == Status.EMPTY else _decoded(text.value)

    # -- recording --

    def record(self, folder, limit_bytes=0, kept_bytes=0, state_ms=0):
        """Records what happens to the program in files of a folder, from which any moment can be computed again; None:
        ends it. Sizes of 0 are the usual ones. Errors: FAILED, the folder cannot be used; WRONG_STATE, it is recorded
        already, or blocks are bound that the program reads."""
        if folder is None:
            _call(_library.rung_instance_record, self, None)
            return
        options = _abi.rung_recording_options(folder=os.fsencode(folder), limit_bytes=limit_bytes, kept_bytes=kept_bytes,
                                              state_ms=state_ms)
        _call(_library.rung_instance_record, self, byref(options))

    def mark(self, text):
        """Writes a text into the recording, and keeps its present files. Error: WRONG_STATE, nothing is recorded."""
        _call(_library.rung_instance_mark, self, text)

    def keep_recording(self):
        """Keeps the present files of the recording. Error: WRONG_STATE, nothing is recorded."""
        _call(_library.rung_instance_keep_recording, self)

    def follow_recording(self):
        """For two seconds what is recorded is in its file after 33 ms. Error: WRONG_STATE, nothing is recorded."""
        _call(_library.rung_instance_follow_recording, self)

    def recording(self):
        """Where the program is recorded, as a Recording; None: it is not."""
        info = _abi.rung_recording_info()
        if _library.rung_instance_recording(self, byref(info)) == Status.WRONG_STATE:
            return None
        _call(_library.rung_instance_recording, self, byref(info))
        return info.shown()

    # -- timers --

    def timers(self):
        """The timers of the program, one Timer after the other, between two scans. Not among them are timers whose
        place the program computes."""
        return (entry.shown() for entry in _each(self, _library.rung_instance_timer, _abi.rung_timer_info))

    # -- profile --

    def profile(self):
        """The number and times of runs of each rung since the power-on, one Profile after the other. Error:
        WRONG_STATE, the program was not built with `rungc build --profile`."""
        return (entry.shown() for entry in _each(self, _library.rung_instance_profile, _abi.rung_profile))

    def worst_rung(self):
        """The Profile of the rung with the longest single run; None: none has run. Errors as in profile."""
        worst = _abi.rung_profile()
        status = _call(_library.rung_instance_worst_rung, self, byref(worst))
        return None if status == Status.EMPTY else worst.shown()

    def clear_profile(self):
        """Resets counts and times of all rungs. Errors as in profile."""
        _call(_library.rung_instance_clear_profile, self)

    # -- another program --

    def replace(self, replacement):
        """The program of a Replacement takes over, with its state. The replacement then holds the former program, which
        a second call puts back. False: not possible at this moment, try again after the next slice. Error: WRONG_STATE,
        it was made for another program than the running one, or a fault of its program has put the former one back;
        BAD_ARGUMENT, it was made for another instance."""
        return _call(_library.rung_instance_replace, self, replacement) != Status.LATER

    def shadow(self, shadow):
        """Begins a Shadow with the present state; None ends the running one. False: not possible at this moment, try
        again after the next slice, or a fault has stopped the program. Error: WRONG_STATE, there is a shadow already,
        or it was made for another program or has begun before; BAD_ARGUMENT, it was made for another instance."""
        return _call(_library.rung_instance_shadow, self, _Handle() if shadow is None else shadow) == Status.OK

    # -- forcing --

    def force(self, forces):
        """Activates Forces instead of the former ones; None ends all. False: a fault has stopped the program. Error:
        WRONG_STATE, the program is stopped, or the set is for another program; BAD_ARGUMENT, it is for another
        instance."""
        return _call(_library.rung_instance_force, self, _Handle() if forces is None else forces) != Status.FAULTED

    def forced(self):
        """The active forces: a list of Force, sorted by name."""
        return [force.shown()._replace(value=force.value.real if force.type == Type.F64 else force.value.integer)
                for force in _each(self, _library.rung_instance_forced, _abi.rung_force_info)]


def _values(values):
    return (_abi.rung_value * len(values))(*values)


def _cell_numbers(cells):
    return (c_uint32 * len(cells))(*(cell._number for cell in cells))


# ---- what belongs to an instance -------------------------------------------------------------------------------------

class _Part(_Closing):
    """An object of an instance, which it references, and with which it ends at the latest."""

    def __init__(self, plc, end, new, *arguments):
        self._handle = _Handle(end)
        if _call(new, plc, *arguments, byref(self._handle)) == Status.LATER:
            raise Error(Status.LATER, _decoded(_library.rung_error_text()))
        self._plc = plc
        plc._parts.append(self._handle)

    def close(self):
        """Closes the object. Closing again does nothing."""
        self._handle.free()
        if self._handle in self._plc._parts:
            self._plc._parts.remove(self._handle)


class Watch(_Part):
    """Names that other threads watch while the program runs: their values at the end of a scan, all of the same scan.

    It ends by close, at the end of its `with`, or with its instance.
    """

    def __init__(self, plc, names, depth=0):
        """Watches names, of an array the first element, from the end of the current scan on; from any thread, if they
        were read before. `depth`: number of scans kept for samples, at most 1,000,000. Errors as in Instance.cell;
        WRONG_TYPE, a text; WRONG_STATE, there are 16 already; BAD_ARGUMENT."""
        self._names = list(names)
        self._cells = [plc.cell(name) for name in self._names]
        super().__init__(plc, "rung_watch_free", _library.rung_watch_new, _cell_numbers(self._cells),
                         len(self._cells), depth)

    def newest(self):
        """(Sample, {name: value}) of the last complete scan, or of the moment of a fault; None: no scan has ended since
        the watch was made. A name that the program no longer has is 0. Any thread, also several at a time."""
        return self._sample(_library.rung_watch_newest)

    def samples(self):
        """Takes (Sample, {name: value}) of every scan that was kept, one after the other. Any thread, one at a time."""
        return iter(lambda: self._sample(_library.rung_watch_next), None)

    def _sample(self, function):
        values, sample = (_abi.rung_value * len(self._cells))(), _abi.rung_sample()
        if _call(function, self, values, byref(sample)) == Status.EMPTY:
            return None
        return sample.shown(), {name: cell._shown(value) for name, cell, value in zip(self._names, self._cells, values)}


class Trace(_Part):
    """The scans of a Watch as a file for wave viewers; it takes them instead of Watch.samples.

    It ends by close, at the end of its `with`, or with its instance.
    """

    def __init__(self, watch, path):
        """Begins a file (value change dump). Error: BAD_ARGUMENT, the watch keeps no scans; FAILED."""
        self._handle = _Handle("rung_trace_free")
        _call(_library.rung_trace_new, watch, path, byref(self._handle))
        self._plc, self._watch = watch._plc, watch
        # It ends before the watch.
        self._plc._parts.insert(self._plc._parts.index(watch._handle), self._handle)

    def write(self):
        """Writes all scans that were kept. False: there were none. Error: FAILED."""
        return _call(_library.rung_trace_write, self) != Status.EMPTY


class Replacement(_Part):
    """Another program of the same dialect, ready to take over from the running program of an instance
    (Instance.replace).

    It ends by close, at the end of its `with`, or with its instance.
    """

    def __init__(self, plc, image):
        """Determines what happens to the state of the running program of `plc`, which may run in its thread meanwhile,
        but must neither be closed nor get another program. Error: REFUSED, a program of another dialect;
        OUT_OF_MEMORY."""
        super().__init__(plc, "rung_replacement_free", _library.rung_replacement_new, image, None, 0)

    def report(self):
        """The Report of what replace would do now: the numbers of names and states that stay and of changes, the bytes
        to copy; the time that a slice of the new program may take on this computer, and its period, also as a
        sentence."""
        report = _abi.rung_replacement_info()
        _call(_library.rung_replacement_report, self, byref(report))
        return report.shown()

    def allow_late(self):
        """Allows the new program to take over although a slice of it may last longer than its period."""
        _call(_library.rung_replacement_allow_late, self)

    def changes(self):
        """The changes that replace would make now: a list of Change, cells before states, each sorted by name."""
        return [change.shown() for change in _each(self, _library.rung_replacement_change, _abi.rung_change)]

    def rungs(self):
        """The rungs that replace would change now: a list of RungChange, in the order of the new program, then the
        removed ones."""
        return [change.shown() for change in _each(self, _library.rung_replacement_rung, _abi.rung_rung_change)]


class Shadow(_Part):
    """Another program that runs beside the program of an instance, on its inputs and answers, so that the outputs can
    be compared before it takes over (Instance.shadow). It has no effect outside.

    It ends by close, at the end of its `with`, or with its instance.
    """

    def __init__(self, plc, image, scans, room=64):
        """A shadow for `scans` scans of the schedule, with room for `room` recorded runs of tasks that wait for `work`.
        Error: REFUSED, a program of another dialect or schedule; BAD_ARGUMENT; OUT_OF_MEMORY."""
        super().__init__(plc, "rung_shadow_free", _library.rung_shadow_new, image, _integer(scans, 0, _NONE),
                         _integer(room, 0, _NONE))

    def work(self):
        """Executes and compares one recorded run of a task. False: there is none."""
        return _call(_library.rung_shadow_work, self) == Status.OK

    def report(self):
        """The ShadowReport of the comparison so far."""
        report = _abi.rung_shadow_info()
        _call(_library.rung_shadow_report, self, byref(report))
        return report.shown()

    def differences(self):
        """The differences of the last report: a list of Difference, sorted by name."""
        def shown(difference):
            of = (lambda value: value.real) if difference.type == Type.F64 else (lambda value: value.integer)
            return difference.shown()._replace(running=of(difference.running), next=of(difference.next))
        return [shown(difference) for difference in _each(self, _library.rung_shadow_difference, _abi.rung_difference)]


class Forces(_Part):
    """Names that a user forces to a value: every reader within a scan gets that value (Instance.force).

    It ends by close, at the end of its `with`, or with its instance; active forces end then, too.
    """

    def __init__(self, plc, values, owner="", replacement=None, access=READ):
        """`values`: {name: value}, a float for a real and an int for all others; for an array its first element; with
        access=REAL the 64-bit real at that place. With a Replacement for its program, else for the running one. Error:
        NOT_FOUND; WRONG_TYPE, a text, a constant, or no space for a real; REFUSED, the program writes a cell, and no
        compiler is attached to its image; LATER, the compiler is at work: try again; BAD_ARGUMENT."""
        cells = (_abi.rung_forced_cell * len(values))()
        for cell, (name, value) in zip(cells, values.items()):
            cell.name, cell.owner, cell.access = _text(name), _text(owner), access
            cell.value = self._given(value) if replacement is not None else plc.cell(name, access)._given(value)
        super().__init__(plc, "rung_forces_free", _library.rung_forces_new,
                         _Handle() if replacement is None else replacement, cells, len(cells))

    @staticmethod
    def _given(value):
        """The value for a program that is not running yet, whose cells are not looked up here."""
        if isinstance(value, float):
            return _abi.rung_value(real=value)
        return _abi.rung_value(integer=_integer(value, -1 << 63, (1 << 64) - 1))
