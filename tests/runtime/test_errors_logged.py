"""What the event log says about errors."""

from tests.runtime.booting import boot


def test_handled_errors_are_warnings_unless_skip_warn() -> None:
    """[K §7.5]"""
    text = """
  PROC main()
    fails 1;
    fails 2;
  ENDPROC
  PROC fails(num n)
    RAISE n;
  ERROR
    IF ERRNO = 2 SkipWarn;
    TRYNEXT;
  ENDPROC
"""
    controller, _ = boot(text, cycle="once")
    with controller:
        controller.start_program()
        controller.run_for(1)
        told = [e for e in controller.log if e.code == 40_199]
        assert [(e.type.name, e.texts[0], e.task) for e in told] == [("WARNING", "error 1", "T1")]
