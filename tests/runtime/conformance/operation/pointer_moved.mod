MODULE pointer_moved
    ! source: [S4 overview 4-24] what survives PP to a routine, PP to cursor, a service routine, a warm start
    ! case:
    ! Variables anew, persistents as they were, no interrupt, no open file.
    ! do: start, run 1, stop, run 0.1, routine routine, run 0.1
    ! state: ready
    ! do: start, run 9
    ! expect: routine 112
    ! expect: closed
    ! expect: written
    ! state: finished
    ! do: start, run 9
    ! expect: behind 1224
    ! expect: trap
    ! expect: written
    ! do: routine nobody
    ! refused: routine nobody
    ! case:
    ! do: start, run 1, stop, run 0.1, cursor -18
    ! refused: cursor -18
    ! do: cursor 1, run 0.1
    ! at: main TPWrite "behind " + show() + ValToStr(own);
    ! do: start, run 3
    ! expect: behind 1224
    ! expect: trap
    ! expect: written
    ! case:
    ! do: start, run 1, stop, run 0.1, service service, run 1
    ! expect: service 112220
    ! state: stopped
    ! do: start, run 9
    ! expect: behind 11224
    ! expect: trap
    ! expect: written
    ! do: service service, run 1
    ! expect: service 122220
    ! state: finished
    ! do: start, service service
    ! refused: service service
    ! case:
    ! do: start, run 1, stop, run 0.1, power-loss, run 1
    ! state: stopped
    ! do: motors-on, start, run 9
    ! expect: behind 1224
    ! expect: trap
    ! expect: closed
    ! expect: written
    CONST num c := 1;
    VAR num v := 1;
    PERS num p := 1;
    PERS num bell := 0;
    VAR intnum i;
    VAR iodev f;
    TRAP t
        TPWrite "trap";
    ENDTRAP
    PROC main()
        VAR num own := 3;
        CONNECT i WITH t;
        IPers bell, i;
        Open "HOME:/x.txt", f \Write;
        v := 2;
        p := 2;
        own := 4;
        WaitTime 5;
        TPWrite "behind " + show() + ValToStr(own);
        ring;
    ENDPROC
    PROC ring()
        bell := bell + 1;
        WaitTime 1;
        Write f, "x";
        TPWrite "written";
    ERROR
        TPWrite "closed";
        TRYNEXT;
    ENDPROC
    PROC routine()
        TPWrite "routine " + show();
        ring;
    ENDPROC
    PROC service()
        v := v + 10;
        TPWrite "service " + show() + ValToStr(ExecLevel()) + ValToStr(EventType());
    ENDPROC
    FUNC string show()
        RETURN ValToStr(c) + ValToStr(v) + ValToStr(p);
    ENDFUNC
ENDMODULE
