! rule: arguments of EventType
! source: [manual] 3HAC050917
MODULE Demo
    VAR event_type r_event_type;
    PROC main()
        r_event_type := EventType();
        r_event_type := EventType(1);  ! -> RG311
        r_event_type := EventType(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
