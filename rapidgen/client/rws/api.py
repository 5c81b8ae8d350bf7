"""Methods of both controller clients, each a flow with its docstring."""

from collections.abc import Callable
from operator import attrgetter
from pathlib import Path
from typing import Concatenate, Generic, ParamSpec, Protocol, TypeVar

from rapidgen.client.flow_methods import Method, method
from rapidgen.client.rws import flows, known_certificates
from rapidgen.client.rws.address import parse_address
from rapidgen.client.rws.core import Login, RwsCore
from rapidgen.client.rws.effects import Flow
from rapidgen.wire.rws.bodies import Generation

P = ParamSpec("P")
T = TypeVar("T")
RESTART_TIMEOUT = 180.0
"""s for which a subscription waits for a restarting controller."""


class RwsFlowRunner(Protocol):
    """A runner of flows for a core."""

    def __init__(self, core: RwsCore, timeout: float) -> None: ...


def _of_core(flow: Callable[Concatenate[RwsCore, P], Flow[T]]) -> Method[P, T]:
    def opened(core: RwsCore, *args: P.args, **options: P.kwargs) -> Flow[T]:
        yield from flows.connect.connect(core)
        return (yield from flow(core, *args, **options))

    opened.__wrapped__ = flow  # type: ignore[attr-defined]
    opened.__doc__, opened.__name__ = flow.__doc__, flow.__name__
    return method(opened, attrgetter("_core"))


C_co = TypeVar("C_co", bound=RwsFlowRunner, covariant=True)


class ControllerApi(Generic[C_co]):
    """Methods common to both clients."""

    _carrier_type: type[C_co]

    def __init__(
        self,
        address: str,
        *,
        user: str = "Default User",
        password: str = "",
        fingerprint: str = "",
        confirm: Callable[[str, str], bool] | None = None,
        pin_file: Path | None = None,
        timeout: float = 10.0,
    ) -> None:
        self._core = RwsCore(
            parse_address(address),
            Login(user, password),
            fingerprint,
            pin_file or known_certificates.default_file(),
            confirm,
        )
        self._carrier = self._carrier_type(self._core, timeout)

    @property
    def generation(self) -> Generation:
        """RWS 1.0, 2.0, or 2.0 of RobotWare 8; known after connecting."""
        return self._core.generation

    @property
    def where(self) -> str:
        """Host and port of the connection."""
        return self._core.where

    @property
    def requests(self) -> int:
        """Number of requests sent so far."""
        return self._core.requests

    identity = _of_core(flows.panel.identity)
    panel = _of_core(flows.panel.panel)
    execution = _of_core(flows.panel.execution)
    motors = _of_core(flows.panel.motors)
    set_speed = _of_core(flows.panel.set_speed)
    pp_to_main = _of_core(flows.panel.pp_to_main)
    start = _of_core(flows.panel.start)
    stop = _of_core(flows.panel.stop)
    take_mastership = _of_core(flows.mastership.take)
    give_mastership = _of_core(flows.mastership.give)
    holder = _of_core(flows.mastership.holder)
    grants = _of_core(flows.users.grants)
    ask_rmmp = _of_core(flows.users.ask_rmmp)
    cancel_rmmp = _of_core(flows.users.cancel_rmmp)
    tasks = _of_core(flows.rapid.tasks)
    select_task = _of_core(flows.rapid.select_task)
    modules = _of_core(flows.rapid.modules)
    module_text = _of_core(flows.rapid.module_text)
    load_module = _of_core(flows.rapid.load_module)
    unload_module = _of_core(flows.rapid.unload_module)
    save_module = _of_core(flows.rapid.save_module)
    build_errors = _of_core(flows.rapid.build_errors)
    pointer = _of_core(flows.rapid.pointer)
    set_pointer = _of_core(flows.rapid.set_pointer)
    symbol = _of_core(flows.rapid.symbol)
    symbol_text = _of_core(flows.rapid.symbol_text)
    set_symbol = _of_core(flows.rapid.set_symbol)
    symbols = _of_core(flows.rapid.symbols)
    mechanical_units = _of_core(flows.equipment.mechanical_units)
    joint_target = _of_core(flows.equipment.joint_target)
    rob_target = _of_core(flows.equipment.rob_target)
    signals = _of_core(flows.equipment.signals)
    signal = _of_core(flows.equipment.signal)
    set_signal = _of_core(flows.equipment.set_signal)
    dialog = _of_core(flows.dialogs.dialog)
    answer_dialog = _of_core(flows.dialogs.answer_dialog)
    queues = _of_core(flows.queues.queues)
    make_queue = _of_core(flows.queues.make_queue)
    delete_queue = _of_core(flows.queues.delete_queue)
    send_message = _of_core(flows.queues.send_message)
    receive_message = _of_core(flows.queues.receive_message)
    list_files = _of_core(flows.files.list_files)
    read_file = _of_core(flows.files.read_file)
    write_file = _of_core(flows.files.write_file)
    delete_file = _of_core(flows.files.delete_file)
    make_folder = _of_core(flows.files.make_folder)
    copy_file = _of_core(flows.files.copy_file)
    rename_file = _of_core(flows.files.rename_file)
    cfg_domains = _of_core(flows.cfg.cfg_domains)
    cfg_types = _of_core(flows.cfg.cfg_types)
    cfg_instances = _of_core(flows.cfg.cfg_instances)
    cfg_set = _of_core(flows.cfg.cfg_set)
    cfg_create = _of_core(flows.cfg.cfg_create)
    cfg_delete = _of_core(flows.cfg.cfg_delete)
    cfg_load = _of_core(flows.cfg.cfg_load)
    cfg_save = _of_core(flows.cfg.cfg_save)
    log = _of_core(flows.equipment.log)
    backup = _of_core(flows.jobs.backup)
    restore = _of_core(flows.jobs.restore)
    restart = _of_core(flows.jobs.restart)
    wait_ready = _of_core(flows.jobs.wait_ready)
