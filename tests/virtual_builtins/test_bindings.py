"""Every built-in with a signature is bound, compiled, or left out with a reason that is said."""

import inspect

import pytest

from rapidgen.rapid import signatures
from rapidgen.system.model import ModuleFile, System, TaskSpec
from rapidgen.virtual import unsupported
from rapidgen.virtual.compiler.predefined import COMPILED
from rapidgen.virtual.controller import VirtualController
from rapidgen.virtual.registry import bound, bound_names


@pytest.mark.parametrize("name", bound_names())
def test_a_binding_takes_the_arguments_of_its_signature(name):
    signature, builtin = signatures.routine(name), bound(name)
    assert signature is not None
    assert builtin is not None
    inspect.signature(builtin.function).bind(None, *signature.parameters)


def test_what_is_left_out_on_purpose_has_a_signature_and_no_binding():
    for name in unsupported.names():
        assert signatures.routine(name) is not None, name
        assert bound(name) is None, name


def test_every_signature_is_bound_compiled_or_left_out():
    """New signatures need one of the three; what the compiler has may be bound as well."""
    known = unsupported.names() | COMPILED | {name.lower() for name in bound_names()}
    missing = [name for name in signatures.routine_names() if name.lower() not in known]
    assert missing == []


def test_what_is_left_out_is_said_at_load_and_stops_the_task_with_its_reason():
    routines = [signatures.routine(name) for name in sorted(unsupported.names())]
    lines = [
        f"PROC p{i}()\n{r.name};\nENDPROC"
        if r.kind == "PROC"
        else f"PROC p{i}()\nx := {r.name}();\nENDPROC"
        for i, r in enumerate(routines)
        if not r.checked or not [p for p in r.parameters if not p.optional]
    ]
    text = "\n".join(
        ["MODULE m", "VAR num x;", "PROC main()", "p0;", "ENDPROC", *lines, "ENDMODULE"]
    )
    module = ModuleFile("m", "m.mod", text.encode())
    task = TaskSpec("T_ROB1", motion=True, modules=(module,))
    with VirtualController(System("left out", (task,)), cycle="once") as controller:
        said = {d.message.split()[0]: d.notes for d in controller.diagnostics if d.code == "RG403"}
        assert len(said) == len(lines) > 50
        for name, notes in said.items():
            assert notes == (unsupported.reason(name),)
        controller.run(max_time=1)
        fault = controller.task("T_ROB1").fault
        assert fault is not None
        assert fault.event == 40001
        assert fault.arguments == (unsupported.reason(routines[0].name),)
