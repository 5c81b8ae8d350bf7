! rule: arguments of ExecHandler
! source: [manual] 3HAC050917
MODULE Demo
    VAR handler_type r_handler_type;
    PROC main()
        r_handler_type := ExecHandler();
        r_handler_type := ExecHandler(1);  ! -> RG311
        r_handler_type := ExecHandler(\NoSuchArgument);  ! -> RG312
    ENDPROC
ENDMODULE
