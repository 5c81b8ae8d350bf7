"""Message queue settings in SYS.cfg [mem].

RmqType, RmqMaxMsgSize, RmqMaxNoOfMsg.
"""

from rapidgen.controller.controller import VirtualController
from rapidgen.system import parse_cfg, sys_cfg
from rapidgen.system.cfg_reader import tasks_of
from rapidgen.system.model import ModuleFile, QueueSpec, System

CFG = """SYS:CFG_1.0:6:0::

#
CAB_TASKS:

      -Name "T_ROB1" -Type "NORMAL" -MotionTask

      -Name "T_SMALL" -Type "NORMAL" -RmqType "Internal" -RmqMaxMsgSize 10 -RmqMaxNoOfMsg 2

      -Name "T_SHUT" -Type "NORMAL" -RmqType "None"
"""
SENDER = b"""MODULE sender
    PROC main()
        VAR rmqslot slot;
        RMQFindSlot slot, "RMQ_T_SHUT";
        RMQFindSlot slot, "RMQ_T_SMALL";
        RMQSendMessage slot, "12345678901";
        RMQSendMessage slot, 1;
        RMQSendMessage slot, 2;
        RMQSendMessage slot, 3;
    ERROR
        IF ERRNO = ERR_RMQ_NAME TPWrite "name";
        IF ERRNO = ERR_RMQ_MSGSIZE TPWrite "size";
        IF ERRNO = ERR_RMQ_FULL TPWrite "full";
        TRYNEXT;
    ENDPROC
ENDMODULE
"""
IDLE = b"MODULE idle\n PROC main()\n ENDPROC\nENDMODULE\n"


def test_limits_and_closed_queues():
    specs = tasks_of(parse_cfg(CFG))
    modules = [ModuleFile("sender", "sender.mod", SENDER), *[ModuleFile("i", "i.mod", IDLE)] * 2]
    tasks = tuple(
        type(spec)(spec.name, "NORMAL", motion=spec.motion, modules=(file,), queue=spec.queue)
        for spec, file in zip(specs, modules, strict=True)
    )
    with VirtualController(System("queues", tasks), cycle="once", autostart=False) as controller:
        printed = []
        controller.operator.subscribe(lambda _, line: printed.append(line))
        controller.start_program()
        assert controller.run(max_time=5) == "finished"
    assert printed == ["name", "size", "full"]


def test_the_attributes_are_written_back():
    specs = tasks_of(parse_cfg(CFG))
    assert [spec.queue for spec in specs] == [
        QueueSpec(),
        QueueSpec(max_size=10, max_messages=2),
        QueueSpec(open=False),
    ]
    assert tasks_of(sys_cfg(System("queues", specs))) == specs
