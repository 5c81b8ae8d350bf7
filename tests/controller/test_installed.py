"""Built-in and shared modules [K §13, 14]."""

from rapidgen.controller import VirtualController
from rapidgen.system.model import ModuleFile, System, TaskSpec

SHARED = """
  VAR num n := 1;
  VAR pos p;
  VAR num list{2};
  LOCAL VAR num hidden := 10;
  LOCAL PERS num kept := 20;
  TASK VAR num own := 30;
  TASK PERS num saved := 40;
  PERS bool open := FALSE;
  VAR iodev file;
  VAR clock watch;
  CONST num C := 4;
  PROC count()
    VAR num mine;
    mine := mine + 1;
    n := n + mine;
    p.x := p.x + 1;
    list{2} := list{2} + 1;
    hidden := hidden + 1;
    kept := kept + 1;
    own := own + 1;
    saved := saved + 1;
    raised n;
  ENDPROC
  PROC raised(INOUT num v)
    v := v + 0.5;
    IF IsPers(v) TPWrite "a persistent";
  ENDPROC
  FUNC string all()
    RETURN ValToStr(n) + " " + ValToStr(p.x) + " " + ValToStr(list{2}) + " "
      + ValToStr(hidden) + " " + ValToStr(kept) + " " + ValToStr(own) + " "
      + ValToStr(saved) + " " + ValToStr(ERRNO);
  ENDFUNC
"""


def module(name: str, text: str, **flags: bool) -> ModuleFile:
    return ModuleFile(name, f"{name}.sys", f"MODULE {name}\n{text}\nENDMODULE\n".encode(), **flags)


def boot(*mains: str, extra=(), shared=SHARED, **flags: bool):
    flags = flags or {"shared": True}
    tasks = tuple(
        TaskSpec(
            f"T{i}",
            modules=(module(f"main{i}", text), *extra, module("common", shared, **flags)),
        )
        for i, text in enumerate(mains, start=1)
    )
    printed: list[str] = []
    controller = VirtualController(System("s", tasks), autostart=False, cycle="once")
    controller.operator.subscribe(lambda task, text: printed.append(f"{task} {text}"))
    return controller, printed


def test_data_of_a_shared_module_are_common_to_all_tasks() -> None:
    """Except TASK data, ERRNO, and data of routines [K §2.18, 14.2]."""
    controller, printed = boot(
        "PROC main()\n count;\n WaitTime 1;\n TPWrite all();\nENDPROC",
        "PROC main()\n WaitTime 0.5;\n count;\n TPWrite all();\nENDPROC",
    )
    with controller:
        controller.start_program()
        controller.run_for(2)
        assert printed == ["T2 4 2 2 12 22 31 41 0", "T1 4 2 2 12 22 31 41 0"]
        assert controller.task("T1")["common:n"] == 4
        controller.task("T1")["n"] = 7
        assert controller.task("T2")["n"] == 7


def test_files_and_clocks_are_common() -> None:
    """This is the only way to share non-value data [K §14]."""
    controller, printed = boot(
        "PROC main()\n ClkStart watch;\n WaitTime 2;\nENDPROC",
        'PROC main()\n WaitTime 1;\n IF ClkRead(watch) > 0.9 TPWrite "runs";\nENDPROC',
    )
    with controller:
        controller.start_program()
        controller.run_for(2)
        assert printed == ["T2 runs"]


def test_pp_to_main_resets_task_data_only() -> None:
    """[K §13.2]"""
    controller, printed = boot("PROC main()\n count;\n TPWrite all();\nENDPROC")
    with controller:
        controller.start_program()
        controller.run_for(1)
        controller.pp_to_main()
        controller.start_program()
        controller.run_for(1)
        assert printed == ["T1 2.5 1 1 11 21 31 41 0", "T1 4 2 2 12 22 31 42 0"]


PROGRAM = """
  VAR num x := 1;
  PROC main()
    show;
    shadowed;
    TPWrite ValToStr(x) + ValToStr(y);
  ENDPROC
  PROC shadowed()
    TPWrite "the program's";
  ENDPROC
  PROC outside()
    TPWrite "late";
  ENDPROC
"""
TOOLS = """
  VAR num x := 5;
  VAR num y := 6;
  PROC show()
    shadowed;
    TPWrite ValToStr(x);
    %":outside"%;
    outside;
  ERROR
    TPWrite ValToStr(ERRNO = ERR_REFUNKPRC);
    TRYNEXT;
  ENDPROC
  PROC shadowed()
    TPWrite "the installed one";
  ENDPROC
"""


def test_the_program_hides_names_and_is_not_seen() -> None:
    """The built-in level is the outermost [K §13.1]."""
    controller, printed = boot(PROGRAM, shared=TOOLS, installed=True)
    with controller:
        assert [d.code for d in controller.diagnostics] == ["RG404"]
        controller.start_program()
        controller.run_for(1)
        assert printed == [
            "T1 the installed one",
            "T1 5",
            "T1 late",
            "T1 TRUE",
            "T1 the program's",
            "T1 16",
        ]


def test_a_module_may_carry_the_name_of_an_installed_type() -> None:
    controller, printed = boot(
        "RECORD pair\n num a;\n num b;\n num c;\nENDRECORD\n"
        "PROC main()\n VAR pair p := [1,2,3];\n TPWrite ValToStr(p);\n show;\nENDPROC",
        shared="RECORD pair\n num a;\nENDRECORD\nVAR pair q := [4];\n"
        "PROC show()\n TPWrite ValToStr(q);\nENDPROC",
    )
    with controller:
        controller.start_program()
        controller.run_for(1)
        assert printed == ["T1 [1,2,3]", "T1 [4]"]


def test_an_installed_module_cannot_use_data_of_the_program() -> None:
    controller, printed = boot(
        "CONST num z := 1;\nPROC main()\n TPWrite ValToStr(z);\n TPWrite ValToStr(a);\nENDPROC",
        shared="VAR num a := z;",
        installed=True,
    )
    with controller:
        controller.start_program()
        controller.run_for(1)
        assert printed == ["T1 1"]
        (fault,) = [task.fault for task in controller.tasks.values() if task.fault]
        assert fault.arguments == ("nothing declares z, which a needs",)


def test_installed_modules_stay() -> None:
    """EraseModule and Save reject them [manual]; no view of code [K §13]."""
    controller, printed = boot(
        'PROC main()\n EraseModule "common";\n Save "common" \\FilePath:="HOME:/x.mod";\n'
        " TPWrite all();\nERROR\n TPWrite ValToStr(ERRNO = ERR_MODULE);\n TRYNEXT;\nENDPROC"
    )
    with controller:
        controller.start_program()
        controller.run_for(1)
        assert [p[3:7] for p in printed] == ["TRUE", "TRUE", "1 0 "]
