"""Controllers from RAPID text."""

from dataclasses import replace

from rapidgen.controller import VirtualController
from rapidgen.system.model import ModuleFile, SignalSpec, System, TaskSpec


def system(tasks: dict[str, str], *, signals: tuple[SignalSpec, ...] = (), **specs) -> System:
    """Return a system with one task per text; `specs` by task name.

    Texts are the bodies between MODULE and ENDMODULE.
    """
    return System(
        "test",
        tuple(
            TaskSpec(
                name,
                modules=(
                    ModuleFile(
                        "m", f"{name}.mod", f"MODULE m\n{text}\nENDMODULE\n".encode("latin-1")
                    ),
                ),
                **specs.get(name, {}),
            )
            for name, text in tasks.items()
        ),
        signals,
    )


def boot(*texts: str, signals: tuple[SignalSpec, ...] = (), specs=None, cfg=None, **options):
    """A controller with tasks T1, T2, ... and the list that TPWrite fills."""
    tasks = {f"T{i}": text for i, text in enumerate(texts, start=1)}
    parts = replace(system(tasks, signals=signals, **(specs or {})), cfg=cfg)
    controller = VirtualController(parts, autostart=False, **options)
    printed: list[str] = []
    controller.operator.subscribe(lambda _task, text: printed.append(text))
    return controller, printed
