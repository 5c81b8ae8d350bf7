! rule: arguments of IsStopStateEvent
! source: [manual] 3HAC050917
MODULE Demo
    VAR bool r_bool;
    PROC main()
        r_bool := IsStopStateEvent();
        r_bool := IsStopStateEvent(\PPMoved);
        r_bool := IsStopStateEvent(\PPToMain);
        r_bool := IsStopStateEvent(1);  ! -> RG311
        r_bool := IsStopStateEvent(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
