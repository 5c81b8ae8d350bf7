"""Built-ins are bound, compiled, or omitted with a reported reason."""

import inspect

import pytest

from rapidgen.controller.controller import VirtualController
from rapidgen.rapid.builtins import signatures
from rapidgen.rapid.builtins.signatures import marked
from rapidgen.runtime import unsupported
from rapidgen.runtime.registry import bound, bound_names
from rapidgen.system.model import ModuleFile, System, TaskSpec


@pytest.mark.parametrize("name", bound_names())
def test_a_binding_takes_the_arguments_of_its_signature(name):
    signature, builtin = signatures.routine(name), bound(name)
    assert signature is not None
    assert builtin is not None
    inspect.signature(builtin.function).bind(None, *signature.parameters)


def test_deliberate_omission_has_signature_without_binding():
    for name in unsupported.names():
        assert signatures.routine(name) is not None, name
        assert bound(name) is None, name


def test_every_signature_is_bound_compiled_or_left_out():
    """New signatures need one of the three; compiled ones may be bound."""
    known = unsupported.names() | marked("inline") | {name.lower() for name in bound_names()}
    missing = [name for name in signatures.routine_names() if name.lower() not in known]
    assert missing == []


def _called(name, number):
    """Return a procedure that calls a routine, and the data for it."""
    result = signatures.routine(name)
    data, arguments = [], []
    for k, parameter in enumerate(p for p in result.parameters if not p.optional):
        datum = f"d{number}_{k}"
        kind = "num" if parameter.type.lower() == "anytype" else parameter.type
        data.append(f"{'PERS' if parameter.mode == 'PERS' else 'VAR'} {kind} {datum};")
        arguments.append(datum)
    given = ",".join(arguments)
    call = f"{name} {given}" if result.kind == "PROC" else f"TPWrite ValToStr({name}({given}))"
    return data, f"PROC p{number}()\n{call};\nENDPROC"


def test_omission_is_reported_at_load_and_stops_task():
    """Every one of them: arguments as its signature has them."""
    names = sorted(unsupported.names())
    data, routines = [], []
    for number, name in enumerate(names):
        more, text = _called(name, number)
        data += more
        routines.append(text)
    lines = ["MODULE m", *data, "PROC main()", "ENDPROC", *routines, "ENDMODULE"]
    module = ModuleFile("m", "m.mod", "\n".join(lines).encode())
    task = TaskSpec("T_ROB1", motion=True, modules=(module,))
    with VirtualController(
        System("left out", (task,)), cycle="once", autostart=False
    ) as controller:
        notes = {
            d.message.split()[0].lower(): d.notes
            for d in controller.diagnostics
            if d.code == "RG403"
        }
        assert notes == {name: (unsupported.reason(name),) for name in names}
        task = controller.task("T_ROB1")
        for number, name in enumerate(names):
            task.pp_to_routine(f"p{number}")
            controller.start_program()
            controller.run_for(0.1)
            assert task.fault is not None, name
            assert (task.fault.event, task.fault.arguments) == (
                194001,
                (unsupported.reason(name),),
            ), name
